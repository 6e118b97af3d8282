using Newtonsoft.Json.Linq;

namespace Wedm.Core
{
    public enum Severity
    {
        Error = 1,
        Warning = 2,
        Information = 3,
        Hint = 4,
    }

    /// <summary>One diagnostic of a drawing.</summary>
    public sealed class Finding
    {
        internal Finding(JObject diagnostic)
        {
            Diagnostic = diagnostic;
            Rule = (string)diagnostic["code"];
            Severity = (Severity)((int?)diagnostic["severity"] ?? 1);
            Message = (string)diagnostic["message"];
            var data = diagnostic["data"] as JObject;
            Handle = (string)data?["handle"];
            Segment = (int?)data?["segment"];
            Radius = (double?)data?["radius"];
            Center = Point(data?["center"]);
            Start = Point(data?["start"]);
            End = Point(data?["end"]);
        }

        public string Rule { get; }
        public Severity Severity { get; }
        public string Message { get; }

        /// <summary>Entity and segment; null where the finding is about the drawing.</summary>
        public string Handle { get; }

        public int? Segment { get; }

        /// <summary>Drawing units.</summary>
        public double? Radius { get; }

        /// <summary>Drawing units, [x, y], null where the finding has none.</summary>
        public double[] Center { get; }

        public double[] Start { get; }
        public double[] End { get; }

        /// <summary>As the server sent it, for the context of a code action.</summary>
        internal JObject Diagnostic { get; }

        private static double[] Point(JToken json) => json is JArray ? new[] { (double)json[0], (double)json[1] } : null;
    }
}
