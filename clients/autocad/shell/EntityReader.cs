using System;
using System.Collections.Generic;
using System.Linq;
using Autodesk.AutoCAD.Colors;
using Autodesk.AutoCAD.DatabaseServices;
using Autodesk.AutoCAD.Geometry;
using Newtonsoft.Json.Linq;
using Wedm.Core;
using CadEntity = Autodesk.AutoCAD.DatabaseServices.Entity;
using Entity = Wedm.Core.Entity;
using Vertex = Wedm.Core.Vertex;

namespace Wedm.AutoCad
{
    /// <summary>
    /// Reads entities of the modelspace within one transaction. Plane entities whose extrusion is +Z or −Z are known, in world coordinates;
    /// all others are named by their kind. Layers are read once.
    /// </summary>
    internal sealed class EntityReader
    {
        private const double DegreesPerRadian = 180.0 / Math.PI;

        /// <summary>The application whose extended data (XDATA) suppresses findings, and the code of its strings.</summary>
        private const string XDataApplication = "WEDM";

        private const short XDataString = 1000;

        private readonly Transaction _transaction;
        private readonly ObjectId _modelspace;
        private readonly Dictionary<ObjectId, LayerLook> _layers = new Dictionary<ObjectId, LayerLook>();

        /// <summary>What entities take from their layer.</summary>
        private sealed class LayerLook
        {
            public string Linetype;
            public JValue Color;

            /// <summary>True, "off" or "frozen".</summary>
            public JValue Visible;
        }

        public EntityReader(Database database, Transaction transaction)
        {
            _transaction = transaction;
            _modelspace = SymbolUtilityServices.GetBlockModelSpaceId(database);
        }

        /// <summary>Null for what is gone, is no entity, or lies in a block or a layout.</summary>
        public Entity Read(DBObject found)
        {
            var entity = found as CadEntity;
            if (entity == null || entity.IsErased || entity.OwnerId != _modelspace)
            {
                return null;
            }
            var handle = entity.Handle.ToString();
            var read = Known(entity, handle) ?? new OtherEntity(handle, entity.Layer, entity.GetRXClass().DxfName);
            read.Look = LookOf(entity);
            return read;
        }

        private Entity Known(CadEntity entity, string handle)
        {
            if (entity is Polyline polyline && IsPlane(polyline.Normal) && polyline.NumberOfVertices > 0)
            {
                var vertices = Enumerable.Range(0, polyline.NumberOfVertices).Select(index => AutoCadDrawing.VertexAt(polyline, index)).ToArray();
                return new PolylineEntity(handle, polyline.Layer, polyline.Closed, vertices);
            }
            if (entity is Polyline2d old && IsPlane(old.Normal))
            {
                return new PolylineEntity(handle, old.Layer, old.Closed, VerticesOf(old));
            }
            if (entity is Line line)
            {
                // One that rises is cut as it looks from above, as in the file.
                return new LineEntity(handle, line.Layer, Flat(line.StartPoint), Flat(line.EndPoint));
            }
            if (entity is Arc arc && IsPlane(arc.Normal))
            {
                var start = arc.StartAngle * DegreesPerRadian;
                var end = arc.EndAngle * DegreesPerRadian;
                return arc.Normal.Z > 0
                    ? new ArcEntity(handle, arc.Layer, Flat(arc.Center), arc.Radius, start, end)
                    : new ArcEntity(handle, arc.Layer, Flat(arc.Center), arc.Radius, 180 - end, 180 - start);
            }
            if (entity is Circle circle && IsPlane(circle.Normal))
            {
                return new CircleEntity(handle, circle.Layer, Flat(circle.Center), circle.Radius);
            }
            if (entity is DBText text)
            {
                return new TextEntity(handle, text.Layer, Flat(PlaceOf(text)), text.TextString);
            }
            if (entity is MText paragraph)
            {
                return new TextEntity(handle, paragraph.Layer, Flat(paragraph.Location), paragraph.Text);
            }
            if (entity is DBPoint point)
            {
                return new PointEntity(handle, point.Layer, Flat(point.Position));
            }
            return null;
        }

        /// <summary>The point that the user has set: of a text that is aligned right, middle or above a line that is not its corner.</summary>
        private static Point3d PlaceOf(DBText text)
        {
            var isSet = text.VerticalMode != TextVerticalMode.TextBase || text.HorizontalMode == TextHorizontalMode.TextCenter
                || text.HorizontalMode == TextHorizontalMode.TextRight || text.HorizontalMode == TextHorizontalMode.TextMid;
            return isSet ? text.AlignmentPoint : text.Position;
        }

        /// <summary>The vertices of a heavy polyline that are drawn: not the frame of a spline.</summary>
        private Vertex[] VerticesOf(Polyline2d polyline)
        {
            var mirror = polyline.Normal.Z < 0 ? -1 : 1;
            var vertices = polyline.Cast<ObjectId>().Select(id => (Vertex2d)_transaction.GetObject(id, OpenMode.ForRead));
            return vertices
                .Where(vertex => vertex.VertexType != Vertex2dType.SplineControlVertex)
                .Select(vertex =>
                {
                    var at = polyline.VertexPosition(vertex);
                    return new Vertex(at.X, at.Y, (vertex.Bulge * mirror) + 0.0);
                })
                .ToArray();
        }

        private Look LookOf(CadEntity entity)
        {
            if (!_layers.TryGetValue(entity.LayerId, out var layer))
            {
                layer = LookOf((LayerTableRecord)_transaction.GetObject(entity.LayerId, OpenMode.ForRead));
                _layers[entity.LayerId] = layer;
            }
            var isByLayer = string.Equals(entity.Linetype, "ByLayer", StringComparison.OrdinalIgnoreCase);
            // In the modelspace there is no block to take it from: the line is continuous.
            var isByBlock = string.Equals(entity.Linetype, "ByBlock", StringComparison.OrdinalIgnoreCase);
            var linetype = isByLayer ? layer.Linetype : isByBlock ? null : entity.Linetype;
            return Look.Of(linetype, isByLayer, ColorOf(entity.Color) ?? layer.Color, entity.Visible ? layer.Visible : new JValue(false), WordsOf(entity));
        }

        private LayerLook LookOf(LayerTableRecord layer)
        {
            return new LayerLook
            {
                Linetype = ((LinetypeTableRecord)_transaction.GetObject(layer.LinetypeObjectId, OpenMode.ForRead)).Name,
                Color = ColorOf(layer.Color),
                Visible = layer.IsFrozen ? new JValue("frozen") : layer.IsOff ? new JValue("off") : new JValue(true),
            };
        }

        /// <summary>Null for a colour that is another's: the layer's or the block's.</summary>
        private static JValue ColorOf(Color color)
        {
            switch (color.ColorMethod)
            {
                case ColorMethod.ByAci:
                    return color.ColorIndex >= 1 && color.ColorIndex <= 255 ? new JValue((int)color.ColorIndex) : null;
                case ColorMethod.ByColor:
                    return new JValue("#" + color.Red.ToString("x2") + color.Green.ToString("x2") + color.Blue.ToString("x2"));
                default:
                    return null;
            }
        }

        private static IEnumerable<string> WordsOf(CadEntity entity)
        {
            using (var data = entity.GetXDataForApplication(XDataApplication))
            {
                return data == null
                    ? new string[0]
                    : data.AsArray().Where(value => value.TypeCode == XDataString).Select(value => (string)value.Value).ToArray();
            }
        }

        private static bool IsPlane(Vector3d normal) => normal.X == 0 && normal.Y == 0;

        private static double[] Flat(Point3d point) => new[] { point.X, point.Y };
    }
}
