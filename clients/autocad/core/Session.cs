using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Linq;
using System.Threading;
using Newtonsoft.Json.Linq;

namespace Wedm.Core
{
    /// <summary>The state of a session with the server.</summary>
    public enum SessionState
    {
        Stopped,
        Starting,
        Running,

        /// <summary>The server has died; it is started again after a while.</summary>
        WaitingToRestart,

        /// <summary>
        /// It is not tried again before <see cref="Session.Start"/>: the server is missing, of another protocol, or has ended too often.
        /// </summary>
        Failed,
    }

    /// <summary>
    /// A session with the server: found, started, greeted, restarted when it dies, with all drawings opened again.
    /// All members belong to one thread, that of the CAD program; none of them waits. Whatever comes from the server is handed
    /// over within <see cref="Pump"/>, which that thread calls a few times a second.
    /// </summary>
    public sealed partial class Session : IDisposable
    {
        /// <summary>The version of the name space wedm/ that this client speaks.</summary>
        public const int ProtocolVersion = 1;

        private static readonly TimeSpan HandshakeLimit = TimeSpan.FromSeconds(20);
        private readonly Func<string> _locate;
        private readonly Dictionary<string, LiveDrawing> _drawings = new Dictionary<string, LiveDrawing>();
        private readonly List<Deferred> _deferred = new List<Deferred>();
        private readonly Restarts _restarts = new Restarts();
        private readonly Stopwatch _clock = Stopwatch.StartNew();
        private ServerProcess _server;
        private TimeSpan _startedAt;
        private TimeSpan? _readyAt;
        private TimeSpan _restartAt;
        private int _unanswered;

        /// <summary>A question from before the greeting was over: it is sent once its drawings have been opened.</summary>
        private sealed class Deferred
        {
            public string Method;
            public JToken Parameters;
            public Action<JToken> Result;
            public Action<ServerError> Error;
        }

        /// <param name="locate">Gives the path of the server's program, or throws <see cref="ServerMissingException"/>.</param>
        public Session(Func<string> locate)
        {
            _locate = locate;
        }

        public SessionState State { get; private set; } = SessionState.Stopped;

        /// <summary>Settings of the section wedm that the server asks for; null keeps its defaults and wedm.toml.</summary>
        public JObject Settings { get; set; }

        /// <summary>Process number of the running server, null where there is none.</summary>
        public int? ServerId => _server?.Id;

        /// <summary>What the user should read: the state has changed, or the server says something.</summary>
        public event Action<string> Message;

        public event Action<SessionState> StateChanged;

        public void Start()
        {
            if (State == SessionState.Starting || State == SessionState.Running)
            {
                return;
            }
            _restarts.Reset();
            Launch();
        }

        private void Launch()
        {
            string path;
            try
            {
                path = _locate();
                _server = new ServerProcess(path);
            }
            catch (ServerMissingException fault)
            {
                Fail(fault.Message);
                return;
            }
            _startedAt = _clock.Elapsed;
            _readyAt = null;
            Become(SessionState.Starting);
            _server.Connection.OnNotification = Notified;
            _server.Connection.OnRequest = Asked;
            var greeting = JObject.Parse(@"{
                ""capabilities"": {
                    ""general"": { ""positionEncodings"": [""utf-16""] },
                    ""workspace"": { ""configuration"": true },
                    ""experimental"": { ""wedm"": { ""applyDrawingEdit"": true, ""resendDrawing"": true } } },
                ""rootUri"": null }");
            greeting["locale"] = System.Globalization.CultureInfo.CurrentUICulture.Name;
            greeting["processId"] = Process.GetCurrentProcess().Id;
            greeting["clientInfo"] = new JObject { ["name"] = "wedm for AutoCAD" };
            _server.Connection.Request("initialize", greeting, Greeted, error =>
            {
                // A connection that broke is dealt with where it was seen.
                if (error.Code != ServerError.ConnectionLost)
                {
                    Fail("the server refused to start: " + error);
                }
            });
        }

        /// <summary>Hands over what has arrived, sees whether the server lives, and starts it again when it is time.</summary>
        public void Pump()
        {
            var server = _server;
            server?.Connection.Pump();
            if (_server != null && _server == server && server.Connection.End != null)
            {
                Died(server.Connection.End);
            }
            else if (State == SessionState.Starting && _clock.Elapsed - _startedAt > HandshakeLimit)
            {
                Fail("the server does not answer: there was nothing within " + HandshakeLimit.TotalSeconds + " s");
            }
            else if (State == SessionState.WaitingToRestart && _clock.Elapsed >= _restartAt)
            {
                Launch();
            }
        }

        /// <summary>Opens a drawing, at once or as soon as the server runs.</summary>
        public LiveDrawing Open(string uri, IDrawingHost host)
        {
            var drawing = new LiveDrawing(this, uri, host);
            _drawings[uri] = drawing;
            if (State == SessionState.Running)
            {
                drawing.Open();
            }
            return drawing;
        }

        public void Close(LiveDrawing drawing)
        {
            if (_drawings.Remove(drawing.Uri))
            {
                Notify("wedm/didCloseDrawing", new JObject { ["drawing"] = new JObject { ["uri"] = drawing.Uri } });
            }
        }

        /// <summary>Asks for the list of all radii.</summary>
        public void ListRadii(LiveDrawing drawing, Action<IReadOnlyList<RadiusRow>> rows, Action<string> refused)
        {
            Ask(drawing, "wedm/inspect", new JObject(), result => rows(RadiusRow.Of(result)), error => refused(error.Message));
        }

        /// <summary>Asks about the drawing as it is now or, where a repair of it is on its way, as that leaves it.</summary>
        private void Ask(LiveDrawing drawing, string method, JObject question, Action<JToken> result, Action<ServerError> error)
        {
            question["uri"] = drawing.Uri;
            drawing.AfterRepairs(() =>
            {
                drawing.Flush();
                Request(method, question, result, error);
            });
        }

        /// <summary>
        /// Waits until everything that was asked for is answered, for scripts, whose next command comes at once. False where that takes longer
        /// than <paramref name="patience"/>.
        /// </summary>
        public bool Finish(TimeSpan patience)
        {
            var begin = _clock.Elapsed;
            while (_unanswered > 0 && _clock.Elapsed - begin < patience)
            {
                Pump();
                Thread.Sleep(5);
            }
            return _unanswered == 0;
        }

        /// <summary>
        /// Asks for the fix of one finding (null: of all that can be fixed safely) and makes it. <paramref name="done"/> hears what was
        /// done, <paramref name="refused"/> why nothing was.
        /// </summary>
        public void Fix(LiveDrawing drawing, Finding finding, Action<string> done, Action<string> refused)
        {
            drawing.AfterRepairs(() => FixNow(drawing, finding, done, refused));
        }

        private void FixNow(LiveDrawing drawing, Finding finding, Action<string> done, Action<string> refused)
        {
            drawing.Flush();
            drawing.Repairing();
            var line = finding == null ? 0 : (int?)finding.Diagnostic["range"]?["start"]?["line"] ?? 0;
            var place = new JObject { ["line"] = line, ["character"] = 0 };
            var context = new JObject
            {
                ["diagnostics"] = finding == null ? new JArray() : new JArray(finding.Diagnostic),
                ["only"] = new JArray(finding == null ? "source.fixAll.wedm" : "quickfix"),
            };
            var question = new JObject
            {
                ["textDocument"] = new JObject { ["uri"] = drawing.Uri },
                ["range"] = new JObject { ["start"] = place, ["end"] = place },
                ["context"] = context,
            };
            Request(
                "textDocument/codeAction", question,
                actions =>
                {
                    Make(drawing, actions, done, refused);
                    drawing.Repaired();
                },
                error =>
                {
                    refused(error.Message);
                    drawing.Repaired();
                });
        }

        /// <summary>What a format ("3b", "4b", "iso", "milling") is called where people read it.</summary>
        public static string NameOf(string format) => format == "milling" ? format : format.ToUpperInvariant();

        /// <summary>The ending of its files: what an electrode mills by is ISO with heights.</summary>
        public static string EndingOf(string format) => format == "milling" ? ".iso" : "." + format;

        /// <summary>Asks for a program ("3b", "4b", "iso", "milling"). Where errors in the drawing prevent it, they are passed on in full.</summary>
        public void Generate(LiveDrawing drawing, string format, Action<string> program, Action<string> refused)
        {
            Ask(drawing, "wedm/generate", new JObject { ["format"] = format }, result => program((string)result["program"]), error => refused(InFull(error)));
        }

        /// <summary>Asks for the path of the wire, with its start holes and its figures (time, weight, cost).</summary>
        public void FindPath(LiveDrawing drawing, Action<Toolpath> found, Action<string> refused)
        {
            Ask(drawing, "wedm/toolpath", new JObject(), result => found(new Toolpath(result)), error => refused(InFull(error)));
        }

        /// <summary>Asks whether punch and plate fit.</summary>
        public void CheckFit(LiveDrawing drawing, Action<Fit> found, Action<string> refused)
        {
            Ask(drawing, "wedm/fit", new JObject(), result => found(new Fit(result)), error => refused(InFull(error)));
        }

        public void Dispose()
        {
            var server = _server;
            _server = null;
            if (server != null)
            {
                server.Connection.Request("shutdown", null, null, null);
                server.Connection.Notify("exit", null);
                server.Dispose();
            }
            Become(SessionState.Stopped);
        }

        internal void Notify(string method, JToken parameters)
        {
            // Before the greeting is over nothing may be sent; each drawing is opened whole when it is.
            if (State == SessionState.Running)
            {
                _server.Connection.Notify(method, parameters);
            }
        }

        private void Request(string method, JToken parameters, Action<JToken> answered, Action<ServerError> failed)
        {
            _unanswered++;
            Action<JToken> result = answer =>
            {
                _unanswered--;
                answered(answer);
            };
            Action<ServerError> error = fault =>
            {
                _unanswered--;
                failed(fault);
            };
            Send(method, parameters, result, error);
        }

        private void Send(string method, JToken parameters, Action<JToken> result, Action<ServerError> error)
        {
            if (State == SessionState.Running)
            {
                _server.Connection.Request(method, parameters, result, error);
            }
            else if (State == SessionState.Starting)
            {
                _deferred.Add(new Deferred { Method = method, Parameters = parameters, Result = result, Error = error });
            }
            else
            {
                error(new ServerError(ServerError.ConnectionLost, "the server is not running (" + State + ")", null));
            }
        }

        private void Greeted(JToken answer)
        {
            var version = (int?)answer.SelectToken("capabilities.experimental.wedm.protocol");
            if (version != ProtocolVersion)
            {
                var name = (string)answer.SelectToken("serverInfo.name") ?? "the program";
                var release = (string)answer.SelectToken("serverInfo.version");
                var found = version == null ? "no protocol of wedm" : "protocol " + version;
                Fail(name + (release == null ? "" : " " + release) + " speaks " + found + ", this plugin needs protocol "
                    + ProtocolVersion + ": install plugin and server of the same release");
                return;
            }
            _readyAt = _clock.Elapsed;
            Become(SessionState.Running);
            Notify("initialized", new JObject());
            foreach (var drawing in _drawings.Values.ToArray())
            {
                drawing.Open();
            }
            foreach (var question in TakeDeferred())
            {
                Send(question.Method, question.Parameters, question.Result, question.Error);
            }
        }

        private Deferred[] TakeDeferred()
        {
            var questions = _deferred.ToArray();
            _deferred.Clear();
            return questions;
        }

        /// <summary>Answers all requests that wait for a server that is gone.</summary>
        private void Abandon(ServerProcess server, string reason)
        {
            server.Connection.Abandon(reason);
            foreach (var question in TakeDeferred())
            {
                question.Error(new ServerError(ServerError.ConnectionLost, reason, null));
            }
        }

        private void Died(string reason)
        {
            var server = _server;
            var log = server.LastLogLine == null ? "" : ": " + server.LastLogLine;
            var how = " (" + reason + log + ")";
            var pause = _restarts.AfterLifeOf(_readyAt == null ? TimeSpan.Zero : _clock.Elapsed - _readyAt.Value);
            if (pause == null)
            {
                Fail("the server has ended " + Restarts.MostEnds + " times in a row" + how + " and is not started again before the next command");
                return;
            }
            _server = null;
            _restartAt = _clock.Elapsed + pause.Value;
            server.Kill();
            Become(SessionState.WaitingToRestart);
            Abandon(server, reason);
            server.Dispose();
            var when = pause.Value == TimeSpan.Zero ? "" : " in " + pause.Value.TotalSeconds + " s";
            Message?.Invoke("the server has ended" + how + "; it is started again" + when);
        }

        private void Fail(string reason)
        {
            var server = _server;
            _server = null;
            Become(SessionState.Failed);
            if (server != null)
            {
                Abandon(server, reason);
                server.Kill();
                server.Dispose();
            }
            Message?.Invoke(reason);
        }

        private void Become(SessionState state)
        {
            if (State != state)
            {
                State = state;
                StateChanged?.Invoke(state);
            }
        }

        private void Notified(string method, JToken parameters)
        {
            switch (method)
            {
                case "textDocument/publishDiagnostics":
                    if (_drawings.TryGetValue((string)parameters["uri"] ?? "", out var drawing))
                    {
                        drawing.Receive((JObject)parameters);
                    }
                    break;
                case "window/showMessage":
                    Message?.Invoke((string)parameters["message"]);
                    break;
            }
        }

        private JToken Asked(string method, JToken parameters)
        {
            switch (method)
            {
                case "workspace/configuration":
                    return new JArray(parameters["items"].Select(item => (JToken)Settings ?? JValue.CreateNull()));
                case "wedm/resendDrawing":
                    return _drawings.TryGetValue((string)parameters["uri"] ?? "", out var drawing)
                        ? new JObject { ["drawing"] = drawing.Whole() }
                        : null;
                case "wedm/applyDrawingEdit":
                    var refusal = ApplyEdit((JObject)parameters["edit"]);
                    return refusal == null
                        ? new JObject { ["applied"] = true }
                        : new JObject { ["applied"] = false, ["failureReason"] = refusal };
                case "client/registerCapability":
                case "client/unregisterCapability":
                case "window/workDoneProgress/create":
                    return JValue.CreateNull();
                default:
                    return null;
            }
        }

        private string ApplyEdit(JObject edit)
        {
            return _drawings.TryGetValue((string)edit["uri"] ?? "", out var drawing) ? drawing.Apply(edit) : "the drawing is not open";
        }

        private void Make(LiveDrawing drawing, JToken actions, Action<string> done, Action<string> refused)
        {
            var offered = (actions as JArray ?? new JArray()).Cast<JObject>().ToArray();
            var action = offered.FirstOrDefault(one => (bool?)one["isPreferred"] == true) ?? offered.FirstOrDefault();
            var edit = action?.SelectToken("command.arguments[0]") as JObject;
            if (edit == null)
            {
                refused("nothing here can be fixed safely");
                return;
            }
            var refusal = drawing.Apply(edit);
            if (refusal == null)
            {
                done((string)action["title"]);
            }
            else
            {
                refused(refusal);
            }
        }

        private static string InFull(ServerError error)
        {
            var findings = error.Data?["diagnostics"] as JArray;
            var sentences = findings == null ? new string[0] : findings.Select(finding => (string)finding["message"]).ToArray();
            return sentences.Length == 0 ? error.Message : error.Message + ":\n" + string.Join("\n", sentences);
        }
    }
}
