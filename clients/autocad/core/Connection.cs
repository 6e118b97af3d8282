using System;
using System.Collections.Concurrent;
using System.Collections.Generic;
using System.IO;
using System.Text;
using System.Threading;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Wedm.Core
{
    /// <summary>An error that the server answered a request with.</summary>
    public sealed class ServerError
    {
        public ServerError(int code, string message, JToken data)
        {
            Code = code;
            Message = message;
            Data = data;
        }

        public int Code { get; }
        public string Message { get; }
        public JToken Data { get; }

        /// <summary>The drawing has changed since the request was made.</summary>
        public const int DocumentMovedOn = -32801;

        /// <summary>The server is gone: no answer will come.</summary>
        public const int ConnectionLost = -32000;

        public override string ToString() => Message;
    }

    /// <summary>
    /// JSON-RPC over two streams. One thread reads, one writes; whoever uses it never waits for the server.
    /// What arrives lies in an inbox until <see cref="Pump"/> hands it over, on the thread that calls it.
    /// </summary>
    internal sealed class Connection : IDisposable
    {
        private readonly Stream _toServer;
        private readonly BlockingCollection<byte[]> _outbox = new BlockingCollection<byte[]>();
        private readonly ConcurrentQueue<JObject> _inbox = new ConcurrentQueue<JObject>();
        private readonly Dictionary<long, Waiting> _waiting = new Dictionary<long, Waiting>();
        private volatile string _end;
        private long _lastId;

        private sealed class Waiting
        {
            public Action<JToken> Result;
            public Action<ServerError> Error;
        }

        public Connection(Stream fromServer, Stream toServer)
        {
            _toServer = toServer;
            StartThread("wedm reader", () => ReadAll(fromServer));
            StartThread("wedm writer", WriteAll);
        }

        /// <summary>A notification of the server: method and params.</summary>
        public Action<string, JToken> OnNotification { get; set; }

        /// <summary>A request of the server. What it returns is the answer; with null the answer is that the method is not known.</summary>
        public Func<string, JToken, JToken> OnRequest { get; set; }

        /// <summary>Why the connection has ended; null while it is up, or while messages are still waiting.</summary>
        public string End => _inbox.IsEmpty ? _end : null;

        public void Notify(string method, JToken parameters)
        {
            Send(Message(method, parameters));
        }

        public void Request(string method, JToken parameters, Action<JToken> result, Action<ServerError> error)
        {
            var id = ++_lastId;
            _waiting[id] = new Waiting { Result = result, Error = error };
            var message = Message(method, parameters);
            message["id"] = id;
            Send(message);
        }

        /// <summary>Hands over what has arrived. Returns how many messages there were.</summary>
        public int Pump()
        {
            var count = 0;
            while (_inbox.TryDequeue(out var message))
            {
                count++;
                HandOver(message);
            }
            return count;
        }

        /// <summary>Answers everything that still waits with <see cref="ServerError.ConnectionLost"/>.</summary>
        public void Abandon(string reason)
        {
            var waiting = new List<Waiting>(_waiting.Values);
            _waiting.Clear();
            foreach (var one in waiting)
            {
                one.Error?.Invoke(new ServerError(ServerError.ConnectionLost, reason, null));
            }
        }

        public void Dispose()
        {
            _outbox.CompleteAdding();
        }

        private void HandOver(JObject message)
        {
            var method = (string)message["method"];
            var id = message["id"];
            if (method != null && id != null)
            {
                var answer = new JObject { ["jsonrpc"] = "2.0", ["id"] = id };
                var result = OnRequest?.Invoke(method, message["params"]);
                if (result == null)
                {
                    answer["error"] = new JObject { ["code"] = -32601, ["message"] = "there is no method " + method };
                }
                else
                {
                    answer["result"] = result;
                }
                Send(answer);
            }
            else if (method != null)
            {
                OnNotification?.Invoke(method, message["params"]);
            }
            else if (id != null && id.Type == JTokenType.Integer && _waiting.TryGetValue((long)id, out var waiting))
            {
                _waiting.Remove((long)id);
                if (message["error"] is JObject error)
                {
                    waiting.Error?.Invoke(new ServerError((int?)error["code"] ?? 0, (string)error["message"] ?? "an error without a message", error["data"]));
                }
                else
                {
                    waiting.Result?.Invoke(message["result"]);
                }
            }
        }

        private static JObject Message(string method, JToken parameters)
        {
            var message = new JObject { ["jsonrpc"] = "2.0", ["method"] = method };
            if (parameters != null)
            {
                message["params"] = parameters;
            }
            return message;
        }

        private void Send(JObject message)
        {
            if (!_outbox.IsAddingCompleted)
            {
                _outbox.Add(Encoding.UTF8.GetBytes(message.ToString(Formatting.None)));
            }
        }

        private void ReadAll(Stream stream)
        {
            try
            {
                for (var body = Frames.Read(stream); body != null; body = Frames.Read(stream))
                {
                    _inbox.Enqueue(JObject.Parse(Encoding.UTF8.GetString(body)));
                }
                _end = "the server has ended";
            }
            catch (Exception fault) when (fault is IOException || fault is InvalidDataException || fault is ObjectDisposedException || fault is JsonException)
            {
                _end = "the connection to the server broke: " + fault.Message;
            }
        }

        private void WriteAll()
        {
            try
            {
                foreach (var body in _outbox.GetConsumingEnumerable())
                {
                    Frames.Write(_toServer, body);
                }
                _toServer.Dispose();
            }
            catch (Exception fault) when (fault is IOException || fault is ObjectDisposedException)
            {
                // The reader sees the end as well, and says so.
                _outbox.CompleteAdding();
            }
        }

        private static void StartThread(string name, ThreadStart work)
        {
            new Thread(work) { IsBackground = true, Name = name }.Start();
        }
    }
}
