using System;
using System.Globalization;
using System.IO;
using System.Text;

namespace Wedm.Core
{
    /// <summary>The base protocol of LSP: a header with the length in bytes, an empty line, the body.</summary>
    internal static class Frames
    {
        /// <summary>Longest header line that is accepted; a server sends none of a hundredth of that.</summary>
        private const int LongestHeaderLine = 4096;

        public static void Write(Stream stream, byte[] body)
        {
            var header = Encoding.ASCII.GetBytes("Content-Length: " + body.Length.ToString(CultureInfo.InvariantCulture) + "\r\n\r\n");
            stream.Write(header, 0, header.Length);
            stream.Write(body, 0, body.Length);
            stream.Flush();
        }

        /// <summary>The next body, or null where the stream ends between two messages.</summary>
        /// <exception cref="InvalidDataException">What was read is no frame, or ends within one.</exception>
        public static byte[] Read(Stream stream)
        {
            var length = -1;
            for (var line = ReadLine(stream, true); line.Length > 0; line = ReadLine(stream, false))
            {
                if (line == EndOfStream)
                {
                    return null;
                }
                const string name = "Content-Length:";
                if (line.StartsWith(name, StringComparison.OrdinalIgnoreCase)
                    && !int.TryParse(line.Substring(name.Length).Trim(), NumberStyles.None, CultureInfo.InvariantCulture, out length))
                {
                    throw new InvalidDataException("found the header \"" + line + "\", expected a length in bytes");
                }
            }
            if (length < 0)
            {
                throw new InvalidDataException("a message without Content-Length");
            }
            var body = new byte[length];
            for (var done = 0; done < length;)
            {
                var count = stream.Read(body, done, length - done);
                if (count == 0)
                {
                    throw new InvalidDataException("the stream ends within a message");
                }
                done += count;
            }
            return body;
        }

        private const string EndOfStream = "\0";

        private static string ReadLine(Stream stream, bool mayEnd)
        {
            var line = new StringBuilder();
            while (line.Length < LongestHeaderLine)
            {
                var next = stream.ReadByte();
                if (next < 0)
                {
                    if (mayEnd && line.Length == 0)
                    {
                        return EndOfStream;
                    }
                    throw new InvalidDataException("the stream ends within a header");
                }
                if (next == '\n')
                {
                    return line.ToString().TrimEnd('\r');
                }
                line.Append((char)next);
            }
            throw new InvalidDataException("a header line is longer than " + LongestHeaderLine + " bytes");
        }
    }
}
