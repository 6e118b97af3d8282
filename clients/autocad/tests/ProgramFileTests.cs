using System.IO;
using NUnit.Framework;
using Wedm.Core;

namespace Wedm.Tests
{
    [TestFixture]
    public class ProgramFileTests
    {
        [Test]
        public void A_file_is_made_or_replaced_and_nothing_is_left_beside_it()
        {
            var folder = Directory.CreateDirectory(Path.Combine(Path.GetTempPath(), Path.GetRandomFileName())).FullName;
            var path = Path.Combine(folder, "plate.3b");
            try
            {
                foreach (var program in new[] { "B1B0B1GXL1\nDD\n", "DD\n" })
                {
                    ProgramFile.Write(path, program);
                    Assert.AreEqual(program, File.ReadAllText(path));
                    CollectionAssert.AreEqual(new[] { path }, Directory.GetFiles(folder));
                }
                Assert.Catch<IOException>(() => ProgramFile.Write(Path.Combine(folder, "no", "plate.3b"), "DD\n"));
            }
            finally
            {
                Directory.Delete(folder, true);
            }
        }
    }
}
