using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Text;
using Newtonsoft.Json.Linq;

namespace Wedm.Core
{
    /// <summary>Where the wire is threaded for a contour; the point in drawing units.</summary>
    public sealed class StartHole
    {
        internal StartHole(JToken json)
        {
            Contour = (string)json["contour"];
            At = new[] { (double)json["at"][0], (double)json["at"][1] };
            DiameterMm = (double?)json["diameter"];
            IsGiven = (bool)json["given"];
        }

        /// <summary>Handle of the contour's first entity.</summary>
        public string Contour { get; }

        public double[] At { get; }

        /// <summary>Null where the settings do not state it.</summary>
        public double? DiameterMm { get; }

        /// <summary>True where the settings or a mark in the drawing give it; else a place was searched for.</summary>
        public bool IsGiven { get; }
    }

    /// <summary>The path of the wire's centre, where the wire is threaded, and the time, weight and cost on the machine.</summary>
    public sealed class Toolpath
    {
        /// <summary>What lies on these layers is drawn by the plugin: the server sets them aside, too.</summary>
        public const string PathLayer = "WEDM_PATH";

        public const string HoleLayer = "START-HOLES";

        /// <summary>The mark of a thread hole.</summary>
        public const string Mark = "O";

        private readonly double _unitMm;
        private readonly JToken _work;

        internal Toolpath(JToken result)
        {
            _unitMm = (double)result["unitsToMm"];
            _work = result["work"] ?? new JObject();
            Holes = (result["holes"] ?? new JArray()).Select(hole => new StartHole(hole)).ToArray();
            // A lead from a hole that lies on the path has no length.
            Pieces = result["paths"].SelectMany(path => path["segments"]).Where(piece => (double)piece["length"] > 0).Select(PieceOf).ToArray();
        }

        /// <summary>Lines, arcs and circles on <see cref="PathLayer"/>, all contours and passes, leads included.</summary>
        public IReadOnlyList<Entity> Pieces { get; }

        /// <summary>In the order of the cuts.</summary>
        public IReadOnlyList<StartHole> Holes { get; }

        /// <summary>Holes as circles, where their diameter is set, and the marks that keep them where they are, on <see cref="HoleLayer"/>.</summary>
        public IReadOnlyList<Entity> DrawnHoles()
        {
            var drawn = new List<Entity>();
            foreach (var hole in Holes)
            {
                if (hole.DiameterMm != null)
                {
                    drawn.Add(new CircleEntity(null, HoleLayer, hole.At, hole.DiameterMm.Value / 2 / _unitMm));
                }
                drawn.Add(new TextEntity(null, HoleLayer, hole.At, Mark));
            }
            return drawn;
        }

        /// <summary>The drill list as CSV, in the columns of <c>wedm holes</c>: mm.</summary>
        public string DrillList(string drawing)
        {
            var csv = new StringBuilder("drawing,x_mm,y_mm,diameter_mm,contour,hole\n");
            foreach (var hole in Holes)
            {
                var diameter = hole.DiameterMm == null ? "" : hole.DiameterMm.Value.ToString(CultureInfo.InvariantCulture);
                csv.Append(string.Join(",", Cell(drawing), Millimetres(hole.At[0]), Millimetres(hole.At[1]), diameter, Cell(hole.Contour), hole.IsGiven ? "given" : "found"));
                csv.Append('\n');
            }
            return csv.ToString();
        }

        /// <summary>The figures for the machine, one a line where they are known, and the keys of the settings that the others need.</summary>
        public string Figures()
        {
            var lines = new List<string> { "cut " + Number("length", "0.000") + " mm, jumps " + Number("jumps", "0.000") + " mm" };
            if (_work["minutes"]?.Type == JTokenType.Float || _work["minutes"]?.Type == JTokenType.Integer)
            {
                lines.Add(Number("minutes", "0.0") + " minutes on the machine" + (_work["cost"] == null ? "" : ", cost " + Number("cost", "0.00")));
            }
            foreach (var slug in _work["slugs"] ?? new JArray())
            {
                lines.Add("what drops out of contour " + (string)slug["contour"] + ": " + ((double)slug["mass"]).ToString("0.0", CultureInfo.InvariantCulture) + " g");
            }
            if (_work["largestWire"] is JObject wire)
            {
                var limit = wire["facing"] is JObject ? " mm, for the narrow place at entity " : " mm, for the arc at entity ";
                lines.Add("largest wire: " + ((double)wire["diameter"]).ToString("0.000", CultureInfo.InvariantCulture) + limit
                    + (string)wire["handle"] + " segment " + (int)wire["segment"]);
            }
            var missing = (_work["missing"] ?? new JArray()).Select(key => (string)key).ToArray();
            if (missing.Length > 0)
            {
                lines.Add("not known without these keys of wedm.toml: " + string.Join(", ", missing));
            }
            return string.Join("\n", lines);
        }

        private string Number(string key, string format) => ((double?)_work[key] ?? 0).ToString(format, CultureInfo.InvariantCulture);

        /// <summary>A coordinate that rounds to zero has no sign.</summary>
        private string Millimetres(double along) => (Math.Round(along * _unitMm * 1e4) / 1e4 + 0.0).ToString("0.0000", CultureInfo.InvariantCulture);

        private static string Cell(string text) => text.IndexOfAny(new[] { ',', '"', '\n', '\r' }) < 0 ? text : "\"" + text.Replace("\"", "\"\"") + "\"";

        private static Entity PieceOf(JToken piece)
        {
            var start = PointOf(piece["start"]);
            var end = PointOf(piece["end"]);
            if (!(piece["center"] is JArray))
            {
                return new LineEntity(null, PathLayer, start, end);
            }
            var center = PointOf(piece["center"]);
            var radius = (double)piece["radius"];
            if ((string)piece["kind"] == "circle")
            {
                return new CircleEntity(null, PathLayer, center, radius);
            }
            var isClockwise = (double)piece["sweep"] < 0;
            return new ArcEntity(null, PathLayer, center, radius, Angle(center, isClockwise ? end : start), Angle(center, isClockwise ? start : end));
        }

        private static double[] PointOf(JToken json) => new[] { (double)json[0], (double)json[1] };

        private static double Angle(double[] center, double[] point) => Math.Atan2(point[1] - center[1], point[0] - center[0]) * 180 / Math.PI;
    }

    /// <summary>Whether punch and plate fit, as the wire leaves them.</summary>
    public sealed class Fit
    {
        /// <summary>The number of places that are named.</summary>
        private const int Named = 5;

        private readonly JToken _result;

        internal Fit(JToken result)
        {
            _result = result;
        }

        public bool Fits => (bool)_result["fits"];

        /// <summary>The least clearance that is left anywhere, mm a side; below 0 where the parts bind.</summary>
        public double LeastMm => (double)_result["least"];

        /// <summary>One outline in the other, the places marked.</summary>
        public string Svg => (string)_result["svg"];

        public string InWords()
        {
            var invariant = CultureInfo.InvariantCulture;
            var words = (Fits ? "the parts fit" : "the parts bind") + ": the least clearance is " + LeastMm.ToString("0.0000", invariant) + " mm a side, "
                + ((double)_result["clearance"]).ToString("0.0000", invariant) + " mm is asked for";
            foreach (var place in _result["places"].Take(Named))
            {
                words += "\n  " + ((double)place["clearance"]).ToString("0.0000", invariant) + " mm at " + ((double)place["at"][0]).ToString("0.000", invariant) + ", "
                    + ((double)place["at"][1]).ToString("0.000", invariant) + " (entity " + (string)place["handle"] + " segment " + (int)place["segment"] + ", the " + (string)place["of"] + ")";
            }
            var more = _result["places"].Count() - Named;
            return more > 0 ? words + "\n  and " + more + " more" : words;
        }
    }
}
