using System.IO;
using NUnit.Framework;
using Wedm.Core;

namespace Wedm.Tests
{
    [TestFixture]
    public class ServerLocatorTests
    {
        private string _root;

        [SetUp]
        public void MakeFolders()
        {
            _root = Path.Combine(Path.GetTempPath(), Path.GetRandomFileName());
            foreach (var folder in new[] { "beside", "path", "empty" })
            {
                Directory.CreateDirectory(Path.Combine(_root, folder));
            }
            File.WriteAllText(In("beside"), "");
            File.WriteAllText(In("path"), "");
        }

        [TearDown]
        public void RemoveFolders()
        {
            Directory.Delete(_root, true);
        }

        private string In(string folder) => Path.Combine(_root, folder, ServerLocator.ProgramName);

        [Test]
        public void The_setting_wins_then_the_plugins_folder_then_the_path_then_where_cargo_installs()
        {
            var home = Path.Combine(_root, "home");
            var installed = Path.Combine(home, ".cargo", "bin", ServerLocator.ProgramName);
            Directory.CreateDirectory(Path.GetDirectoryName(installed));
            File.WriteAllText(installed, "");
            var path = Path.Combine(_root, "empty") + Path.PathSeparator + Path.Combine(_root, "path");
            Assert.AreEqual(In("path"), ServerLocator.Find(In("path"), Path.Combine(_root, "beside"), path, home));
            Assert.AreEqual(In("beside"), ServerLocator.Find("", Path.Combine(_root, "beside"), path, home));
            Assert.AreEqual(In("path"), ServerLocator.Find(null, Path.Combine(_root, "empty"), path, home));
            Assert.AreEqual(installed, ServerLocator.Find(null, Path.Combine(_root, "empty"), Path.Combine(_root, "empty"), home));
        }

        [Test]
        public void A_relative_folder_of_the_path_is_passed_over()
        {
            var before = Directory.GetCurrentDirectory();
            Directory.SetCurrentDirectory(_root);
            try
            {
                foreach (var relative in new[] { "path", ".", "./path", " path ", "\"path\"", "../" + Path.GetFileName(_root) + "/path" })
                {
                    Assert.Throws<ServerMissingException>(() => ServerLocator.Find(null, "", relative + Path.PathSeparator, ""), relative);
                    Assert.AreEqual(In("beside"), ServerLocator.Find(null, "", relative + Path.PathSeparator + Path.Combine(_root, "beside"), ""));
                }
                Assert.Throws<ServerMissingException>(() => ServerLocator.Find(Path.Combine("path", ServerLocator.ProgramName), "", "", ""));
            }
            finally
            {
                Directory.SetCurrentDirectory(before);
            }
        }

        [Test]
        public void A_missing_server_is_said_with_the_way_to_get_it()
        {
            var fault = Assert.Throws<ServerMissingException>(() => ServerLocator.Find(null, Path.Combine(_root, "empty"), "", _root));
            StringAssert.Contains("cargo install", fault.Message);
            StringAssert.Contains(Path.Combine(_root, "empty"), fault.Message);
            fault = Assert.Throws<ServerMissingException>(() => ServerLocator.Find("/no/such/wedm", Path.Combine(_root, "beside"), "", _root));
            StringAssert.Contains("\"/no/such/wedm\"", fault.Message);
        }
    }
}
