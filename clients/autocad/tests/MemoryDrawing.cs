using System.Collections.Generic;
using System.Linq;
using Wedm.Core;

namespace Wedm.Tests
{
    /// <summary>A drawing in memory that behaves as a CAD program's: it has undo, and new entities get handles of its own.</summary>
    internal sealed class MemoryDrawing : IDrawingHost
    {
        private readonly Stack<List<KeyValuePair<string, Entity>>> _undo = new Stack<List<KeyValuePair<string, Entity>>>();
        private List<KeyValuePair<string, Entity>> _entities;
        private int _lastHandle = 0x100;

        public MemoryDrawing(params Entity[] entities)
        {
            _entities = entities.Select(entity => new KeyValuePair<string, Entity>(entity.Handle, entity)).ToList();
        }

        /// <summary>Set while somebody listens to the changes, as a CAD program's events do.</summary>
        public LiveDrawing Watcher { get; set; }

        public string Units => "mm";

        public int StepsOfUndo => _undo.Count;

        public IEnumerable<Entity> ReadAll() => _entities.Select(entity => entity.Value);

        public Entity Read(string handle) => _entities.FirstOrDefault(entity => entity.Key == handle).Value;

        public string Draw(string layer, IReadOnlyList<Entity> entities, bool anew)
        {
            var old = _entities.Where(entity => anew && entity.Value.Layer == layer).Select(entity => new KeyValuePair<string, Entity>(entity.Key, null));
            var fresh = entities.Select((entity, index) => new KeyValuePair<string, Entity>("new" + index, entity));
            return Write(old.Concat(fresh).ToArray());
        }

        public string Write(IReadOnlyList<KeyValuePair<string, Entity>> entities)
        {
            var next = _entities.ToList();
            foreach (var entity in entities)
            {
                var index = next.FindIndex(one => one.Key == entity.Key);
                if (index < 0 && entity.Value != null)
                {
                    var json = entity.Value.ToJson();
                    json["handle"] = (++_lastHandle).ToString("X");
                    var added = Entity.FromJson(json);
                    next.Add(new KeyValuePair<string, Entity>(added.Handle, added));
                    Watcher?.Touch(added.Handle);
                }
                else if (entity.Value == null)
                {
                    next.RemoveAt(index);
                }
                else
                {
                    next[index] = entity;
                }
                Watcher?.Touch(entity.Key);
            }
            _undo.Push(_entities);
            _entities = next;
            return null;
        }

        /// <summary>Changes one entity, as a command of the user would.</summary>
        public void Edit(Entity entity)
        {
            Write(new[] { new KeyValuePair<string, Entity>(entity.Handle, entity) });
        }

        public void Undo()
        {
            var before = _undo.Pop();
            foreach (var handle in before.Concat(_entities).Select(entity => entity.Key).Distinct())
            {
                Watcher?.Touch(handle);
            }
            _entities = before;
        }
    }
}
