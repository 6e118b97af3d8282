using System.IO;
using System.Text;
using NUnit.Framework;
using Wedm.Core;

namespace Wedm.Tests
{
    [TestFixture]
    public class FramesTests
    {
        private static byte[] Read(string bytes) => Frames.Read(new MemoryStream(Encoding.UTF8.GetBytes(bytes)));

        [TestCase("Content-Length: 2\r\n\r\n{}", "{}")]
        [TestCase("content-length:2\r\nContent-Type: application/vscode-jsonrpc; charset=utf-8\r\n\r\n{}rest", "{}")]
        [TestCase("Content-Length: 4\n\n\"ä\"", "\"ä\"")]
        [TestCase("Content-Length: 0\r\n\r\n", "")]
        public void A_frame_is_read(string bytes, string body)
        {
            Assert.AreEqual(body, Encoding.UTF8.GetString(Read(bytes)));
        }

        [Test]
        public void The_end_between_two_frames_is_no_fault()
        {
            Assert.IsNull(Read(""));
        }

        [TestCase("Content-Length: 3\r\n\r\n{}", "the stream ends within a message")]
        [TestCase("Content-Length: -3\r\n\r\n{}", "found the header \"Content-Length: -3\", expected a length in bytes")]
        [TestCase("Content-Type: x\r\n\r\n{}", "a message without Content-Length")]
        [TestCase("Content-Le", "the stream ends within a header")]
        public void A_broken_frame_is_named(string bytes, string reason)
        {
            Assert.AreEqual(reason, Assert.Throws<InvalidDataException>(() => Read(bytes)).Message);
        }

        [Test]
        public void What_is_written_is_read_again()
        {
            var stream = new MemoryStream();
            Frames.Write(stream, Encoding.UTF8.GetBytes("[\"µm\"]"));
            stream.Position = 0;
            Assert.AreEqual("[\"µm\"]", Encoding.UTF8.GetString(Frames.Read(stream)));
        }
    }
}
