using System;
using System.Collections.Generic;
using System.Linq;
using Newtonsoft.Json.Linq;

namespace Wedm.Core
{
    /// <summary>The CAD program's side of a drawing: what is in it now, and how it is changed.</summary>
    public interface IDrawingHost
    {
        /// <summary>"mm", "inch", or null where the drawing does not say.</summary>
        string Units { get; }

        /// <summary>Everything in the modelspace in the order of the drawing; what the protocol does not know as <see cref="OtherEntity"/>.</summary>
        IEnumerable<Entity> ReadAll();

        /// <summary>The entity of a handle as it is now; null where it is gone.</summary>
        Entity Read(string handle);

        /// <summary>
        /// Writes entities (null: delete) as one step of undo. Returns null, or why nothing was written.
        /// </summary>
        string Write(IReadOnlyList<KeyValuePair<string, Entity>> entities);

        /// <summary>
        /// Draws entities without handles on a layer, which is made where it is not there, as one step of undo; with
        /// <paramref name="anew"/> in place of all that lies there. Returns null, or why nothing was drawn.
        /// </summary>
        string Draw(string layer, IReadOnlyList<Entity> entities, bool anew);
    }

    /// <summary>
    /// A drawing that is held open at the server. The CAD program's events only mark what they touched; <see cref="Flush"/> reads
    /// that again, when the command has ended, and sends what differs from what the server has.
    /// </summary>
    public sealed class LiveDrawing
    {
        private readonly Session _session;
        private readonly IDrawingHost _host;
        private readonly Dictionary<string, Entity> _sent = new Dictionary<string, Entity>();
        private readonly List<string> _dirtyInOrder = new List<string>();
        private readonly HashSet<string> _dirty = new HashSet<string>();

        /// <summary>What is in the drawing and not sent, its kind by its handle.</summary>
        private readonly Dictionary<string, string> _others = new Dictionary<string, string>();

        /// <summary>Questions that wait until a repair has been made: they are about the drawing that it leaves.</summary>
        private readonly Queue<Action> _waiting = new Queue<Action>();

        private bool _isRepairing;

        internal LiveDrawing(Session session, string uri, IDrawingHost host)
        {
            _session = session;
            _host = host;
            Uri = uri;
        }

        public string Uri { get; }

        /// <summary>The version that the server was sent last.</summary>
        public int Version { get; private set; }

        /// <summary>Findings of <see cref="FindingsVersion"/>.</summary>
        public IReadOnlyList<Finding> Findings { get; private set; } = new Finding[0];

        /// <summary>The version that <see cref="Findings"/> belongs to; 0 before the first.</summary>
        public int FindingsVersion { get; private set; }

        /// <summary>True while something has been touched that the server does not know of yet.</summary>
        public bool HasUnsentChanges => _dirty.Count > 0;

        /// <summary>New findings have arrived.</summary>
        public event Action<LiveDrawing> FindingsChanged;

        /// <summary>Notes that an entity was added, changed or erased. Costs nothing; may be called within any event.</summary>
        public void Touch(string handle)
        {
            if (_dirty.Add(handle))
            {
                _dirtyInOrder.Add(handle);
            }
        }

        /// <summary>Notes that anything may look otherwise, as when a layer has been frozen.</summary>
        public void TouchAll()
        {
            foreach (var handle in _sent.Keys)
            {
                Touch(handle);
            }
        }

        /// <summary>
        /// What is in the drawing and can neither be checked nor cut, by kind, as "2 SPLINE, 1 INSERT"; null where there is nothing.
        /// </summary>
        public string LeftOut
        {
            get
            {
                var kinds = _others.Values.GroupBy(kind => kind).OrderBy(kind => kind.Key, StringComparer.Ordinal);
                return _others.Count == 0 ? null : string.Join(", ", kinds.Select(kind => kind.Count() + " " + kind.Key));
            }
        }

        /// <summary>Asks now, or, where a repair is on its way, as soon as it has been made or refused.</summary>
        internal void AfterRepairs(Action ask)
        {
            if (_isRepairing)
            {
                _waiting.Enqueue(ask);
            }
            else
            {
                ask();
            }
        }

        /// <summary>A repair is on its way until <see cref="Repaired"/>.</summary>
        internal void Repairing()
        {
            _isRepairing = true;
        }

        internal void Repaired()
        {
            _isRepairing = false;
            while (!_isRepairing && _waiting.Count > 0)
            {
                _waiting.Dequeue()();
            }
        }

        /// <summary>Reads what was touched and sends the differences. Returns how many entities differ.</summary>
        public int Flush()
        {
            var changes = new JArray();
            foreach (var handle in _dirtyInOrder)
            {
                _sent.TryGetValue(handle, out var before);
                var after = Cut(handle, _host.Read(handle));
                var change = Changes.Between(handle, before, after);
                if (change == null)
                {
                    continue;
                }
                changes.Add(change);
                if (after == null)
                {
                    _sent.Remove(handle);
                }
                else
                {
                    _sent[handle] = after;
                }
            }
            _dirtyInOrder.Clear();
            _dirty.Clear();
            if (changes.Count > 0)
            {
                Version++;
                var drawing = new JObject { ["uri"] = Uri, ["version"] = Version };
                _session.Notify("wedm/didChangeDrawing", new JObject { ["drawing"] = drawing, ["changes"] = changes });
            }
            return changes.Count;
        }

        /// <summary>Draws on one of the plugin's own layers, which are not cut. Returns null, or why nothing was drawn.</summary>
        internal string Draw(string layer, IReadOnlyList<Entity> entities, bool anew)
        {
            var refusal = _host.Draw(layer, entities, anew);
            Flush();
            return refusal;
        }

        /// <summary>
        /// Null for what is not sent: the wire's path that the plugin has drawn, which is no part of the drawing, and kinds that the protocol
        /// does not know, which are kept by name.
        /// </summary>
        private Entity Cut(string handle, Entity entity)
        {
            _others.Remove(handle);
            if (entity == null || string.Equals(entity.Layer, Toolpath.PathLayer, StringComparison.OrdinalIgnoreCase))
            {
                return null;
            }
            if (entity is OtherEntity other)
            {
                _others[handle] = other.Kind;
                return null;
            }
            return entity;
        }

        /// <summary>Reads the drawing again and sends it whole.</summary>
        internal void Open()
        {
            _session.Notify("wedm/didOpenDrawing", new JObject { ["drawing"] = Whole() });
        }

        /// <summary>The drawing as it is now, with a new version.</summary>
        internal JObject Whole()
        {
            _sent.Clear();
            _others.Clear();
            _dirty.Clear();
            _dirtyInOrder.Clear();
            var entities = new JArray();
            foreach (var entity in _host.ReadAll().Where(entity => Cut(entity.Handle, entity) != null))
            {
                _sent[entity.Handle] = entity;
                entities.Add(entity.ToJson());
            }
            Version++;
            var drawing = new JObject { ["uri"] = Uri, ["version"] = Version, ["entities"] = entities };
            if (_host.Units != null)
            {
                drawing["units"] = _host.Units;
            }
            return drawing;
        }

        internal void Receive(JObject publish)
        {
            var version = (int?)publish["version"];
            if (version != Version)
            {
                // The answer to an older version: the next one is on its way.
                return;
            }
            Findings = publish["diagnostics"].Cast<JObject>().Select(diagnostic => new Finding(diagnostic)).ToArray();
            FindingsVersion = version.Value;
            FindingsChanged?.Invoke(this);
        }

        /// <summary>
        /// Makes an edit of the server's. Returns null, or why it was refused: then nothing has changed.
        /// </summary>
        internal string Apply(JObject edit)
        {
            if ((int?)edit["version"] != Version || HasUnsentChanges)
            {
                return "the drawing has changed since the fix was made for it";
            }
            IReadOnlyList<KeyValuePair<string, Entity>> entities;
            try
            {
                entities = Changes.Apply((JArray)edit["changes"], handle => _sent.TryGetValue(handle, out var entity) ? entity : null);
            }
            catch (Exception fault) when (fault is FormatException || fault is InvalidCastException || fault is ArgumentException)
            {
                return "the fix does not fit the drawing: " + fault.Message;
            }
            // An undo may have come without an event: the drawing itself is compared, not what is remembered of it.
            foreach (var entity in entities)
            {
                _sent.TryGetValue(entity.Key, out var known);
                if (Changes.Between(entity.Key, known, _host.Read(entity.Key)) != null)
                {
                    Touch(entity.Key);
                    return "the drawing has changed since the fix was made for it";
                }
            }
            var refusal = _host.Write(entities);
            if (refusal == null)
            {
                foreach (var entity in entities)
                {
                    Touch(entity.Key);
                }
                Flush();
            }
            return refusal;
        }
    }
}
