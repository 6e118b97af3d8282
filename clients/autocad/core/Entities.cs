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

    /// <summary>An entity as the protocol knows it: plane geometry in world coordinates, angles in degrees.</summary>
    public abstract class Entity
    {
        protected Entity(string handle, string layer)
        {
            Handle = handle;
            Layer = layer;
        }

        /// <summary>The CAD program's own handle, hexadecimal.</summary>
        public string Handle { get; }

        public string Layer { get; }

        public virtual JObject ToJson()
        {
            return new JObject { ["handle"] = Handle, ["layer"] = Layer };
        }

        /// <summary>True where both say the same; numbers are compared bit by bit.</summary>
        public bool IsSameAs(Entity other) => other != null && JToken.DeepEquals(ToJson(), other.ToJson());

        /// <exception cref="FormatException">A kind that the protocol does not have.</exception>
        public static Entity FromJson(JObject json)
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
                default:
                    throw new FormatException("found an entity of type \"" + json["type"] + "\", expected polyline, line, arc, circle or text");
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
}
