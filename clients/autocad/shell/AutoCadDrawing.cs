using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using Autodesk.AutoCAD.ApplicationServices;
using Autodesk.AutoCAD.DatabaseServices;
using Autodesk.AutoCAD.Geometry;
using Wedm.Core;
using CadEntity = Autodesk.AutoCAD.DatabaseServices.Entity;
using Entity = Wedm.Core.Entity;
using Vertex = Wedm.Core.Vertex;

namespace Wedm.AutoCad
{
    /// <summary>
    /// A document's modelspace as the core sees it, and the way of a repair back into it. How an entity is read is said in
    /// <see cref="EntityReader"/>.
    /// </summary>
    internal sealed class AutoCadDrawing : IDrawingHost
    {
        private const double DegreesPerRadian = 180.0 / Math.PI;

        /// <summary>Height of the mark of a thread hole, drawing units.</summary>
        private const double MarkHeight = 1;

        private readonly Document _document;

        public AutoCadDrawing(Document document)
        {
            _document = document;
        }

        private Database Database => _document.Database;

        public string Units
        {
            get
            {
                switch (Database.Insunits)
                {
                    case UnitsValue.Millimeters:
                        return "mm";
                    case UnitsValue.Inches:
                        return "inch";
                    default:
                        return null;
                }
            }
        }

        public IEnumerable<Entity> ReadAll()
        {
            using (var transaction = Database.TransactionManager.StartOpenCloseTransaction())
            {
                var modelspace = (BlockTableRecord)transaction.GetObject(SymbolUtilityServices.GetBlockModelSpaceId(Database), OpenMode.ForRead);
                var reader = new EntityReader(Database, transaction);
                return modelspace.Cast<ObjectId>().Select(id => reader.Read(transaction.GetObject(id, OpenMode.ForRead))).Where(entity => entity != null).ToArray();
            }
        }

        public Entity Read(string handle)
        {
            using (var transaction = Database.TransactionManager.StartOpenCloseTransaction())
            {
                return TryFind(handle, out var id) ? new EntityReader(Database, transaction).Read(transaction.GetObject(id, OpenMode.ForRead, true)) : null;
            }
        }

        /// <summary>The object of a handle; false where it is gone.</summary>
        public bool TryFind(string handle, out ObjectId id)
        {
            id = ObjectId.Null;
            return long.TryParse(handle, NumberStyles.AllowHexSpecifier, CultureInfo.InvariantCulture, out var number)
                && Database.TryGetObjectId(new Handle(number), out id)
                && !id.IsErased;
        }

        public string Draw(string layer, IReadOnlyList<Entity> entities, bool anew)
        {
            return Change(transaction =>
            {
                MakeLayer(transaction, layer);
                var modelspace = (BlockTableRecord)transaction.GetObject(SymbolUtilityServices.GetBlockModelSpaceId(Database), OpenMode.ForRead);
                foreach (var id in anew ? modelspace.Cast<ObjectId>().ToArray() : new ObjectId[0])
                {
                    var there = transaction.GetObject(id, OpenMode.ForRead) as CadEntity;
                    if (there != null && string.Equals(there.Layer, layer, StringComparison.OrdinalIgnoreCase))
                    {
                        ((CadEntity)transaction.GetObject(id, OpenMode.ForWrite)).Erase();
                    }
                }
                foreach (var entity in entities)
                {
                    Append(transaction, entity);
                }
            });
        }

        private void MakeLayer(Transaction transaction, string name)
        {
            var layers = (LayerTable)transaction.GetObject(Database.LayerTableId, OpenMode.ForRead);
            if (!layers.Has(name))
            {
                var fresh = new LayerTableRecord { Name = name };
                ((LayerTable)transaction.GetObject(Database.LayerTableId, OpenMode.ForWrite)).Add(fresh);
                transaction.AddNewlyCreatedDBObject(fresh, true);
            }
        }

        public string Write(IReadOnlyList<KeyValuePair<string, Entity>> entities)
        {
            return Change(transaction =>
            {
                foreach (var entity in entities)
                {
                    Write(transaction, entity.Key, entity.Value);
                }
            });
        }

        private string Change(Action<Transaction> change)
        {
            try
            {
                // One transaction under one lock is one step of undo.
                using (_document.LockDocument())
                using (var transaction = Database.TransactionManager.StartTransaction())
                {
                    change(transaction);
                    transaction.Commit();
                    return null;
                }
            }
            catch (Autodesk.AutoCAD.Runtime.Exception fault)
            {
                return "AutoCAD refused the change: " + fault.ErrorStatus;
            }
        }

        private void Write(Transaction transaction, string handle, Entity entity)
        {
            if (!TryFind(handle, out var id))
            {
                if (entity != null)
                {
                    Append(transaction, entity);
                }
                return;
            }
            var there = (CadEntity)transaction.GetObject(id, OpenMode.ForWrite);
            if (entity == null)
            {
                there.Erase();
            }
            else if (!Set(there, entity))
            {
                // An entity of another kind replaces it, and takes over layer, colour and linetype.
                var fresh = Append(transaction, entity);
                fresh.SetPropertiesFrom(there);
                there.Erase();
            }
        }

        private CadEntity Append(Transaction transaction, Entity entity)
        {
            var modelspace = (BlockTableRecord)transaction.GetObject(SymbolUtilityServices.GetBlockModelSpaceId(Database), OpenMode.ForWrite);
            var fresh = Blank(entity);
            fresh.SetDatabaseDefaults(Database);
            fresh.Layer = entity.Layer;
            Set(fresh, entity);
            modelspace.AppendEntity(fresh);
            transaction.AddNewlyCreatedDBObject(fresh, true);
            return fresh;
        }

        private static CadEntity Blank(Entity entity)
        {
            if (entity is PolylineEntity)
            {
                return new Polyline();
            }
            if (entity is LineEntity)
            {
                return new Line();
            }
            if (entity is ArcEntity)
            {
                return new Arc();
            }
            if (entity is CircleEntity)
            {
                return new Circle();
            }
            if (entity is PointEntity)
            {
                return new DBPoint();
            }
            return new DBText { Height = MarkHeight };
        }

        /// <summary>Gives an object of AutoCAD's the geometry of an entity; false where it is of another kind.</summary>
        private static bool Set(CadEntity there, Entity entity)
        {
            if (there is Polyline polyline && entity is PolylineEntity wanted)
            {
                SetVertices(polyline, wanted);
            }
            else if (there is Line line && entity is LineEntity wantedLine)
            {
                line.StartPoint = At(wantedLine.Start, line.StartPoint.Z);
                line.EndPoint = At(wantedLine.End, line.EndPoint.Z);
            }
            else if (there is Arc arc && entity is ArcEntity wantedArc)
            {
                var mirrored = arc.Normal.Z < 0;
                arc.Center = At(wantedArc.Center, arc.Center.Z);
                arc.Radius = wantedArc.Radius;
                arc.StartAngle = (mirrored ? 180 - wantedArc.EndAngleDeg : wantedArc.StartAngleDeg) / DegreesPerRadian;
                arc.EndAngle = (mirrored ? 180 - wantedArc.StartAngleDeg : wantedArc.EndAngleDeg) / DegreesPerRadian;
            }
            else if (there is Circle circle && entity is CircleEntity wantedCircle)
            {
                circle.Center = At(wantedCircle.Center, circle.Center.Z);
                circle.Radius = wantedCircle.Radius;
            }
            else if (there is DBText text && entity is TextEntity wantedText)
            {
                text.Position = At(wantedText.At, text.Position.Z);
                text.TextString = wantedText.Text;
            }
            else if (there is DBPoint point && entity is PointEntity wantedPoint)
            {
                point.Position = At(wantedPoint.At, point.Position.Z);
            }
            else
            {
                return false;
            }
            return true;
        }

        /// <summary>Only vertices that differ are written, so that the others keep their widths.</summary>
        private static void SetVertices(Polyline polyline, PolylineEntity wanted)
        {
            var mirror = Mirror(polyline.Normal);
            for (var index = 0; index < wanted.Vertices.Count; index++)
            {
                var vertex = wanted.Vertices[index];
                var point = new Point2d(vertex.X * mirror, vertex.Y);
                if (index >= polyline.NumberOfVertices)
                {
                    polyline.AddVertexAt(index, point, vertex.Bulge * mirror, 0, 0);
                }
                else if (!vertex.Equals(VertexAt(polyline, index)))
                {
                    polyline.SetPointAt(index, point);
                    polyline.SetBulgeAt(index, vertex.Bulge * mirror);
                }
            }
            for (var index = polyline.NumberOfVertices - 1; index >= wanted.Vertices.Count; index--)
            {
                polyline.RemoveVertexAt(index);
            }
            polyline.Closed = wanted.Closed;
        }

        /// <summary>In world coordinates: where the extrusion is −Z, AutoCAD's own x and bulge have the other sign.</summary>
        internal static Vertex VertexAt(Polyline polyline, int index)
        {
            var mirror = Mirror(polyline.Normal);
            var point = polyline.GetPoint2dAt(index);
            // Adding zero makes a plain zero out of a negative one.
            return new Vertex((point.X * mirror) + 0.0, point.Y, (polyline.GetBulgeAt(index) * mirror) + 0.0);
        }

        private static double Mirror(Vector3d normal) => normal.Z < 0 ? -1 : 1;

        private static Point3d At(double[] point, double z) => new Point3d(point[0], point[1], z);
    }
}
