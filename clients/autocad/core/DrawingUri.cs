using System;
using System.IO;

namespace Wedm.Core
{
    /// <summary>The name by which the server knows a drawing.</summary>
    public static class DrawingUri
    {
        /// <summary>
        /// A saved drawing is known by its file, so that the server finds the <c>wedm.toml</c> of its folder; one that has no file yet
        /// by its title.
        /// </summary>
        public static string Of(string nameOrPath)
        {
            return Path.IsPathRooted(nameOrPath) ? new Uri(nameOrPath).AbsoluteUri : "autocad:" + Uri.EscapeDataString(nameOrPath);
        }
    }
}
