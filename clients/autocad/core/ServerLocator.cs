using System;
using System.Collections.Generic;
using System.IO;

namespace Wedm.Core
{
    /// <summary>The server's program was not found; the message says where it was looked for and how to get it.</summary>
    public sealed class ServerMissingException : Exception
    {
        public ServerMissingException(string message) : base(message)
        {
        }
    }

    /// <summary>Finds the program <c>wedm</c>: by the setting, beside this assembly, on the path, where cargo installs it.</summary>
    public static class ServerLocator
    {
        private static readonly bool IsWindows = Path.DirectorySeparatorChar == '\\';

        public static readonly string ProgramName = IsWindows ? "wedm.exe" : "wedm";

        /// <param name="setting">Full path that the user has set; null or empty where none is set.</param>
        /// <param name="besides">Folder of the plugin.</param>
        /// <param name="searchPath">Value of the environment variable PATH.</param>
        /// <param name="home">The user's own folder: under it cargo installs programs, and CAD programs may not have that on their PATH.</param>
        /// <exception cref="ServerMissingException">It is in none of these places.</exception>
        public static string Find(string setting, string besides, string searchPath, string home)
        {
            if (!string.IsNullOrWhiteSpace(setting))
            {
                return File.Exists(setting)
                    ? setting
                    : throw new ServerMissingException("the setting WEDM_SERVER names \"" + setting + "\", and there is no such file");
            }
            foreach (var folder in Folders(besides, searchPath, home))
            {
                string candidate;
                try
                {
                    candidate = Path.Combine(folder, ProgramName);
                }
                catch (ArgumentException)
                {
                    continue;
                }
                if (File.Exists(candidate))
                {
                    return candidate;
                }
            }
            throw new ServerMissingException(
                ProgramName + " was not found beside the plugin (" + besides + "), on the PATH or in .cargo/bin: install it with \"cargo install --path .\" "
                + "in a checkout of wedm, or copy " + ProgramName + " into that folder, or set WEDM_SERVER to its full path");
        }

        private static IEnumerable<string> Folders(string besides, string searchPath, string home)
        {
            if (!string.IsNullOrEmpty(besides))
            {
                yield return besides;
            }
            foreach (var folder in (searchPath ?? "").Split(Path.PathSeparator))
            {
                var trimmed = folder.Trim().Trim('"');
                if (trimmed.Length > 0)
                {
                    yield return trimmed;
                }
            }
            if (!string.IsNullOrEmpty(home))
            {
                yield return Path.Combine(home, ".cargo", "bin");
            }
        }
    }
}
