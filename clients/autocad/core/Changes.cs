using System;
using System.Collections.Generic;
using System.Linq;
using Newtonsoft.Json.Linq;

namespace Wedm.Core
{
    /// <summary>What <c>wedm/didChangeDrawing</c> and fixes are made of: splices of polylines, entities added, replaced, deleted.</summary>
    public static class Changes
    {
        /// <summary>
        /// The change that makes <paramref name="after"/> out of <paramref name="before"/> (null: not there), or null where both say
        /// the same. A polyline of which only vertices differ is spliced, so that the cost is that of the edit, not of the polyline.
        /// </summary>
        public static JObject Between(string handle, Entity before, Entity after)
        {
            if (before == null && after == null)
            {
                return null;
            }
            if (after == null)
            {
                return new JObject { ["handle"] = handle, ["entity"] = null };
            }
            if (before is PolylineEntity old && after is PolylineEntity fresh && old.Closed == fresh.Closed && old.Layer == fresh.Layer
                && old.Look.IsSameAs(fresh.Look))
            {
                return Splice(handle, old.Vertices, fresh.Vertices);
            }
            return after.IsSameAs(before) ? null : new JObject { ["handle"] = handle, ["entity"] = after.ToJson() };
        }

        private static JObject Splice(string handle, IReadOnlyList<Vertex> before, IReadOnlyList<Vertex> after)
        {
            var shorter = Math.Min(before.Count, after.Count);
            var head = 0;
            while (head < shorter && before[head].Equals(after[head]))
            {
                head++;
            }
            var tail = 0;
            while (tail < shorter - head && before[before.Count - 1 - tail].Equals(after[after.Count - 1 - tail]))
            {
                tail++;
            }
            var inserted = new JArray();
            for (var index = head; index < after.Count - tail; index++)
            {
                inserted.Add(after[index].ToJson());
            }
            var removed = before.Count - tail - head;
            if (removed == 0 && inserted.Count == 0)
            {
                return null;
            }
            var splice = new JObject { ["start"] = head, ["deleteCount"] = removed, ["insert"] = inserted };
            return new JObject { ["handle"] = handle, ["vertices"] = splice };
        }

        /// <summary>The entities that a list of changes touches, as they are after it (null: deleted), in the order of their first change.</summary>
        /// <param name="now">The entity of a handle as it is; null where there is none.</param>
        /// <exception cref="FormatException">A change does not fit what is there; nothing may be written then.</exception>
        public static IReadOnlyList<KeyValuePair<string, Entity>> Apply(JArray changes, Func<string, Entity> now)
        {
            var order = new List<string>();
            var result = new Dictionary<string, Entity>();
            foreach (var change in changes.Cast<JObject>())
            {
                var handle = (string)change["handle"];
                if (!result.TryGetValue(handle, out var entity))
                {
                    entity = now(handle);
                    order.Add(handle);
                }
                result[handle] = change["vertices"] is JObject splice ? Spliced(handle, entity, splice)
                    : change["entity"] is JObject replacement ? Entity.FromJson(replacement)
                    : null;
            }
            return order.Select(handle => new KeyValuePair<string, Entity>(handle, result[handle])).ToList();
        }

        private static Entity Spliced(string handle, Entity entity, JObject splice)
        {
            if (!(entity is PolylineEntity polyline))
            {
                throw new FormatException(handle + " is no polyline, its vertices cannot be changed");
            }
            var start = (int)splice["start"];
            var count = (int)splice["deleteCount"];
            if (start < 0 || count < 0 || start + (long)count > polyline.Vertices.Count)
            {
                throw new FormatException(handle + " has " + polyline.Vertices.Count + " vertices, the change takes " + count + " from " + start);
            }
            var vertices = polyline.Vertices.Take(start)
                .Concat(splice["insert"].Select(Vertex.FromJson))
                .Concat(polyline.Vertices.Skip(start + count));
            return new PolylineEntity(handle, polyline.Layer, polyline.Closed, vertices.ToArray()) { Look = polyline.Look };
        }
    }
}
