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
                if (!IsFull(setting.Trim()))
                {
                    throw new ServerMissingException("the setting WEDM_SERVER is \"" + setting + "\", expected a full path");
                }
                return File.Exists(setting.Trim())
                    ? setting.Trim()
                    : throw new ServerMissingException("the setting WEDM_SERVER names \"" + setting + "\", and there is no such file");
            }
            foreach (var folder in Folders(besides, searchPath, home))
            {
                if (!IsFull(folder))
                {
                    continue;
                }
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

        /// <summary>
        /// Whether a path means the same file whatever the current folder is. A relative one leads into the folder of the drawing, and one with
        /// only a drive or a slash, on Windows, depends on the current one: anybody may have put a program there.
        /// </summary>
        private static bool IsFull(string path)
        {
            if (!IsWindows)
            {
                return path.Length > 0 && path[0] == '/';
            }
            var hasDrive = path.Length > 2 && char.IsLetter(path[0]) && path[1] == ':' && IsSeparator(path[2]);
            return hasDrive || (path.Length > 2 && IsSeparator(path[0]) && IsSeparator(path[1]));
        }

        private static bool IsSeparator(char character)
        {
            return character == '\\' || character == '/';
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
