using System;
using System.Collections.Generic;
using System.Linq;
using Newtonsoft.Json.Linq;

namespace Wedm.Core
{
    /// <summary>A vertex of a polyline in drawing units; the bulge is tan(sweep / 4) of the segment that starts here.</summary>
    public struct Vertex : IEquatable<Vertex>
    {
        public Vertex(double x, double y, double bulge)
        {
            X = x;
            Y = y;
            Bulge = bulge;
        }

        public double X { get; }
        public double Y { get; }
        public double Bulge { get; }

        public bool Equals(Vertex other) => X.Equals(other.X) && Y.Equals(other.Y) && Bulge.Equals(other.Bulge);

        public override bool Equals(object other) => other is Vertex vertex && Equals(vertex);

        public override int GetHashCode() => X.GetHashCode() ^ (Y.GetHashCode() * 31) ^ (Bulge.GetHashCode() * 961);

        public JArray ToJson() => new JArray(X, Y, Bulge);

        public static Vertex FromJson(JToken json) => new Vertex((double)json[0], (double)json[1], json.Count() > 2 ? (double)json[2] : 0.0);
    }

    /// <summary>
    /// How the CAD program shows an entity, which decides whether it is cut. What it takes from its layer or its block is theirs.
    /// </summary>
    public sealed class Look
    {
        private static readonly string[] Keys = { "linetype", "linetypeByLayer", "color", "visible", "xdata" };

        private readonly JObject _json;

        private Look(JObject json)
        {
            _json = json;
        }

        /// <summary>A continuous line that is shown, of no colour that is known.</summary>
        public static Look Plain { get; } = new Look(new JObject());

        /// <param name="linetype">Its name; null for a continuous one.</param>
        /// <param name="linetypeByLayer">It is that of the layer: a role of the layer then counts for it all the same.</param>
        /// <param name="color">1 to 255, or "#rrggbb"; null where it is not known.</param>
        /// <param name="visible">True, false, or of a layer that is not shown "off" or "frozen".</param>
        /// <param name="xdata">Strings of the extended data of the application WEDM.</param>
        public static Look Of(string linetype, bool linetypeByLayer, JValue color, JValue visible, IEnumerable<string> xdata)
        {
            var json = new JObject();
            if (!string.IsNullOrEmpty(linetype) && !string.Equals(linetype, "Continuous", StringComparison.OrdinalIgnoreCase))
            {
                json["linetype"] = linetype;
                if (linetypeByLayer)
                {
                    json["linetypeByLayer"] = true;
                }
            }
            if (color != null)
            {
                json["color"] = color;
            }
            if (visible.Type != JTokenType.Boolean || !(bool)visible)
            {
                json["visible"] = visible;
            }
            var words = new JArray(xdata.ToArray<object>());
            if (words.Count > 0)
            {
                json["xdata"] = words;
            }
            return new Look(json);
        }

        /// <summary>The keys of an entity that say how it is shown.</summary>
        public static Look FromJson(JObject entity)
        {
            return new Look(new JObject(entity.Properties().Where(key => Keys.Contains(key.Name) && key.Value.Type != JTokenType.Null)));
        }

        public bool IsSameAs(Look other) => JToken.DeepEquals(_json, other._json);

        internal void WriteTo(JObject entity)
        {
            foreach (var key in _json.Properties())
            {
                entity[key.Name] = key.Value.DeepClone();
            }
        }
    }

    /// <summary>An entity as the protocol knows it: plane geometry in world coordinates, angles in degrees.</summary>
    public abstract class Entity
    {
        protected Entity(string handle, string layer)
        {
            Handle = handle;
            Layer = layer;
        }

        /// <summary>Set once, where the entity is made.</summary>
        public Look Look { get; set; } = Look.Plain;

        /// <summary>The CAD program's own handle, hexadecimal.</summary>
        public string Handle { get; }

        public string Layer { get; }

        public virtual JObject ToJson()
        {
            var json = new JObject { ["handle"] = Handle, ["layer"] = Layer };
            Look.WriteTo(json);
            return json;
        }

        /// <summary>True where both say the same; numbers are compared bit by bit.</summary>
        public bool IsSameAs(Entity other) => other != null && JToken.DeepEquals(ToJson(), other.ToJson());

        /// <exception cref="FormatException">A kind that the protocol does not have.</exception>
        public static Entity FromJson(JObject json)
        {
            var entity = OfType(json);
            entity.Look = Look.FromJson(json);
            return entity;
        }

        private static Entity OfType(JObject json)
        {
            var handle = (string)json["handle"];
            var layer = (string)json["layer"] ?? "0";
            switch ((string)json["type"])
            {
                case "polyline":
                    return new PolylineEntity(handle, layer, (bool)json["closed"], json["vertices"].Select(Vertex.FromJson).ToArray());
                case "line":
                    return new LineEntity(handle, layer, PointOf(json["start"]), PointOf(json["end"]));
                case "arc":
                    return new ArcEntity(handle, layer, PointOf(json["center"]), (double)json["radius"], (double)json["startAngle"], (double)json["endAngle"]);
                case "circle":
                    return new CircleEntity(handle, layer, PointOf(json["center"]), (double)json["radius"]);
                case "text":
                    return new TextEntity(handle, layer, PointOf(json["at"]), (string)json["text"]);
                case "point":
                    return new PointEntity(handle, layer, PointOf(json["at"]));
                default:
                    throw new FormatException("found an entity of type \"" + json["type"] + "\", expected polyline, line, arc, circle, text or point");
            }
        }

        private static double[] PointOf(JToken json) => new[] { (double)json[0], (double)json[1] };
    }

    public sealed class PolylineEntity : Entity
    {
        public PolylineEntity(string handle, string layer, bool closed, IReadOnlyList<Vertex> vertices) : base(handle, layer)
        {
            Closed = closed;
            Vertices = vertices;
        }

        public bool Closed { get; }
        public IReadOnlyList<Vertex> Vertices { get; }

        public override JObject ToJson()
        {
            var json = base.ToJson();
            json["type"] = "polyline";
            json["closed"] = Closed;
            json["vertices"] = new JArray(Vertices.Select(vertex => vertex.ToJson()));
            return json;
        }
    }

    public sealed class LineEntity : Entity
    {
        public LineEntity(string handle, string layer, double[] start, double[] end) : base(handle, layer)
        {
            Start = start;
            End = end;
        }

        public double[] Start { get; }
        public double[] End { get; }

        public override JObject ToJson()
        {
            var json = base.ToJson();
            json["type"] = "line";
            json["start"] = new JArray(Start[0], Start[1]);
            json["end"] = new JArray(End[0], End[1]);
            return json;
        }
    }

    /// <summary>An arc that runs counter-clockwise from its start angle to its end angle, degrees.</summary>
    public sealed class ArcEntity : Entity
    {
        public ArcEntity(string handle, string layer, double[] center, double radius, double startAngleDeg, double endAngleDeg) : base(handle, layer)
        {
            Center = center;
            Radius = radius;
            StartAngleDeg = startAngleDeg;
            EndAngleDeg = endAngleDeg;
        }

        public double[] Center { get; }
        public double Radius { get; }
        public double StartAngleDeg { get; }
        public double EndAngleDeg { get; }

        public override JObject ToJson()
        {
            var json = base.ToJson();
            json["type"] = "arc";
            json["center"] = new JArray(Center[0], Center[1]);
            json["radius"] = Radius;
            json["startAngle"] = StartAngleDeg;
            json["endAngle"] = EndAngleDeg;
            return json;
        }
    }

    public sealed class CircleEntity : Entity
    {
        public CircleEntity(string handle, string layer, double[] center, double radius) : base(handle, layer)
        {
            Center = center;
            Radius = radius;
        }

        public double[] Center { get; }
        public double Radius { get; }

        public override JObject ToJson()
        {
            var json = base.ToJson();
            json["type"] = "circle";
            json["center"] = new JArray(Center[0], Center[1]);
            json["radius"] = Radius;
            return json;
        }
    }

    /// <summary>A text; "O" marks a thread hole.</summary>
    public sealed class TextEntity : Entity
    {
        public TextEntity(string handle, string layer, double[] at, string text) : base(handle, layer)
        {
            At = at;
            Text = text;
        }

        public double[] At { get; }
        public string Text { get; }

        public override JObject ToJson()
        {
            var json = base.ToJson();
            json["type"] = "text";
            json["at"] = new JArray(At[0], At[1]);
            json["text"] = Text;
            return json;
        }
    }

    /// <summary>A POINT: it may mark a thread hole, as the text "O" does.</summary>
    public sealed class PointEntity : Entity
    {
        public PointEntity(string handle, string layer, double[] at) : base(handle, layer)
        {
            At = at;
        }

        public double[] At { get; }

        public override JObject ToJson()
        {
            var json = base.ToJson();
            json["type"] = "point";
            json["at"] = new JArray(At[0], At[1]);
            return json;
        }
    }

    /// <summary>An entity of a kind that the protocol does not know: it is named and never sent.</summary>
    public sealed class OtherEntity : Entity
    {
        public OtherEntity(string handle, string layer, string kind) : base(handle, layer)
        {
            Kind = kind;
        }

        /// <summary>Its name in DXF, such as SPLINE.</summary>
        public string Kind { get; }
    }
}
