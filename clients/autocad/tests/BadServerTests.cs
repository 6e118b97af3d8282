using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.IO;
using System.Linq;
using NUnit.Framework;
using Wedm.Core;

namespace Wedm.Tests
{
    /// <summary>Servers that are not what they should be.</summary>
    [TestFixture]
    public class BadServerTests
    {
        private static string Failure(Func<string> locate)
        {
            string message = null;
            using (var session = new Session(locate))
            {
                session.Message += text => message = text;
                session.Start();
                session.Until(() => session.State == SessionState.Failed, "failure");
                session.Start();
                session.Until(() => session.State == SessionState.Failed, "failure once more, after the user has tried again");
            }
            return message;
        }

        private static string Script(string text)
        {
            var path = Path.Combine(Path.GetTempPath(), Path.GetRandomFileName());
            File.WriteAllText(path, text);
            Process.Start("chmod", "+x " + path).WaitForExit();
            return path;
        }

        private const string Answer = @"#!/usr/bin/env python3
import json, sys
length = int(sys.stdin.buffer.readline().split(b':')[1]); sys.stdin.buffer.readline()
request = json.loads(sys.stdin.buffer.read(length))
body = json.dumps({'jsonrpc': '2.0', 'id': request['id'], 'result': RESULT}).encode()
sys.stdout.buffer.write(b'Content-Length: %d\r\n\r\n' % len(body) + body); sys.stdout.flush()
sys.stdin.buffer.read()
";

        [TestCase("{'capabilities': {'experimental': {'wedm': {'protocol': 2}}}, 'serverInfo': {'name': 'wedm', 'version': '9.0.0'}}",
            "wedm 9.0.0 speaks protocol 2, this plugin needs protocol 1: install plugin and server of the same release")]
        [TestCase("{'capabilities': {}, 'serverInfo': {'name': 'other'}}",
            "other speaks no protocol of wedm, this plugin needs protocol 1: install plugin and server of the same release")]
        public void Another_protocol_is_refused_with_both_versions(string result, string expected)
        {
            var path = Script(Answer.Replace("RESULT", result));
            try
            {
                Assert.AreEqual(expected, Failure(() => path));
            }
            finally
            {
                File.Delete(path);
            }
        }

        [Test]
        public void A_missing_server_is_said()
        {
            StringAssert.Contains("there is no such file", Failure(() => ServerLocator.Find("/no/such/wedm", "", "", "")));
        }

        [Test]
        public void A_program_that_cannot_run_is_said()
        {
            var path = Path.GetTempFileName();
            try
            {
                StringAssert.Contains("cannot be started", Failure(() => path));
            }
            finally
            {
                File.Delete(path);
            }
        }

        [Test]
        public void A_server_that_dies_at_every_start_is_given_up_and_tried_again_when_the_user_wants_it()
        {
            var path = Script("#!/bin/sh\necho 'disk on fire' >&2\nexit 3\n");
            var messages = new List<string>();
            try
            {
                using (var session = new Session(() => path))
                {
                    session.Message += messages.Add;
                    session.Start();
                    session.Until(() => session.State == SessionState.Failed, "the last death");
                    CollectionAssert.AreEqual(
                        new[] { "started again", "started again in 0.5 s", "started again in 1 s", "started again in 2 s", "started again in 4 s" },
                        messages.Take(5).Select(message => message.Substring(message.IndexOf("it is ") + 6)));
                    StringAssert.Contains("has ended 6 times in a row", messages.Last());
                    StringAssert.Contains("disk on fire", messages.Last());
                    session.Start();
                    session.Until(() => messages.Count == 7, "another try");
                    StringAssert.EndsWith("started again", messages.Last());
                }
            }
            finally
            {
                File.Delete(path);
            }
        }

        [TestCase("the cutter is warm\\r\\n\\r\\n")]
        [TestCase("Content-Length: 7\\r\\n\\r\\nno json")]
        [TestCase("Content-Length: 2\\r\\n\\r\\n42")]
        public void A_server_that_writes_what_is_no_message_is_killed_and_started_again(string babble)
        {
            var path = Script(Answer.Replace("RESULT", "{'capabilities': {'experimental': {'wedm': {'protocol': 1}}}}")
                .Replace("sys.stdin.buffer.read()", "sys.stdin.buffer.readline(); print('" + babble + "', end='', flush=True); sys.stdin.buffer.read()"));
            var messages = new List<string>();
            try
            {
                using (var session = new Session(() => path))
                {
                    session.Message += messages.Add;
                    session.Start();
                    session.Until(() => session.State == SessionState.Running, "the greeting");
                    var first = Process.GetProcessById(session.ServerId.Value);
                    session.Until(() => messages.Count == 2, "the second end");
                    StringAssert.Contains("the connection to the server broke", messages[0]);
                    StringAssert.EndsWith("started again in 0.5 s", messages[1]);
                    session.Until(() => first.HasExited, "the end of the first one");
                }
            }
            finally
            {
                File.Delete(path);
            }
        }

        [Test]
        public void A_server_that_does_not_read_does_not_hold_up_the_host()
        {
            var path = Script(Answer.Replace("RESULT", "{'capabilities': {'experimental': {'wedm': {'protocol': 1}}}}").Replace("sys.stdin.buffer.read()", "import time; time.sleep(60)"));
            try
            {
                using (var session = new Session(() => path))
                {
                    session.Start();
                    session.Until(() => session.State == SessionState.Running, "the greeting");
                    var vertices = Enumerable.Range(0, 100000).Select(index => new Vertex(index, 0.123456789, 0)).ToArray();
                    var drawing = session.Open("cad:big", new MemoryDrawing(new PolylineEntity("1", "0", false, vertices)));
                    Assert.AreEqual(1, drawing.Version, "it is on its way, megabytes more than a pipe holds");
                    // This server never reads: whoever waited for the pipe would wait until it has ended.
                    session.Pump();
                    Assert.AreEqual(SessionState.Running, session.State);
                    Assert.IsFalse(Process.GetProcessById(session.ServerId.Value).HasExited, "the host waited for the server");
                }
            }
            finally
            {
                File.Delete(path);
            }
        }
    }
}
