using System.Collections.Generic;
using System.Linq;
using Newtonsoft.Json.Linq;

namespace Wedm.Core
{
    /// <summary>A row of the radius list: a segment with the vertex it starts in.</summary>
    public sealed class RadiusRow
    {
        private RadiusRow(string handle, JObject segment)
        {
            Handle = handle;
            Vertex = (int)segment["index"];
            X = (double)segment["start"][0];
            Y = (double)segment["start"][1];
            Radius = (double?)segment["radius"];
            Verdict = (string)segment["verdict"];
        }

        public string Handle { get; }
        public int Vertex { get; }

        /// <summary>Start of the segment, drawing units.</summary>
        public double X { get; }

        public double Y { get; }

        /// <summary>Drawing units; null for a line.</summary>
        public double? Radius { get; }

        /// <summary>"ok", or the names of the rules at fault.</summary>
        public string Verdict { get; }

        public bool IsAtFault => Verdict != "ok";

        internal static IReadOnlyList<RadiusRow> Of(JToken inspection)
        {
            var entities = inspection["entities"].Cast<JObject>();
            return entities.SelectMany(entity => entity["segments"].Cast<JObject>().Select(segment => new RadiusRow((string)entity["handle"], segment))).ToArray();
        }
    }
}
