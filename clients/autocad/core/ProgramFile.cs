using System.IO;
using System.Text;

namespace Wedm.Core
{
    /// <summary>Writes a program beside its target and renames it, so that the target is never half a program.</summary>
    public static class ProgramFile
    {
        /// <exception cref="IOException">It cannot be written; the target is as it was.</exception>
        public static void Write(string path, string program)
        {
            var beside = path + ".wedm-new";
            try
            {
                File.WriteAllText(beside, program, new UTF8Encoding(false));
                if (File.Exists(path))
                {
                    File.Replace(beside, path, null);
                }
                else
                {
                    File.Move(beside, path);
                }
            }
            finally
            {
                File.Delete(beside);
            }
        }
    }
}
