// Signatures of the part of AutoCAD's .NET interface that the shell uses, written from its public reference, so that the shell can be
// compiled where there is no AutoCAD. Nothing here runs, and nothing here ships.
#pragma warning disable 67, 169, 649, 660, 661

namespace Autodesk.AutoCAD.Runtime
{
    using System;

    public interface IExtensionApplication
    {
        void Initialize();
        void Terminate();
    }

    [AttributeUsage(AttributeTargets.Assembly)]
    public sealed class ExtensionApplicationAttribute : Attribute
    {
        public ExtensionApplicationAttribute(Type type) => throw null;
    }

    [AttributeUsage(AttributeTargets.Assembly)]
    public sealed class CommandClassAttribute : Attribute
    {
        public CommandClassAttribute(Type type) => throw null;
    }

    [AttributeUsage(AttributeTargets.Method)]
    public sealed class CommandMethodAttribute : Attribute
    {
        public CommandMethodAttribute(string globalName) => throw null;
    }

    public enum ErrorStatus
    {
        OK,
    }

    public class Exception : System.Exception
    {
        public ErrorStatus ErrorStatus => throw null;
    }

    public class RXClass
    {
        public string DxfName => throw null;
    }

    public abstract class DisposableWrapper : IDisposable
    {
        public void Dispose() => throw null;
    }
}

namespace Autodesk.AutoCAD.Geometry
{
    public struct Point2d
    {
        public Point2d(double x, double y) => throw null;
        public double X => throw null;
        public double Y => throw null;
    }

    public struct Matrix3d
    {
        public static Matrix3d Displacement(Vector3d vector) => throw null;
        public static Matrix3d PlaneToWorld(Vector3d normal) => throw null;
        public static Matrix3d Rotation(double angle, Vector3d axis, Point3d center) => throw null;
        public Matrix3d Inverse() => throw null;
        public static Matrix3d operator *(Matrix3d left, Matrix3d right) => throw null;
    }

    public struct Point3d
    {
        public static Point3d Origin => throw null;
        public Point3d(double x, double y, double z) => throw null;
        public Point3d TransformBy(Matrix3d matrix) => throw null;
        public static Vector3d operator -(Point3d left, Point3d right) => throw null;
        public double X => throw null;
        public double Y => throw null;
        public double Z => throw null;
    }

    public struct Vector3d
    {
        public static Vector3d ZAxis => throw null;
        public double X => throw null;
        public double Y => throw null;
        public double Z => throw null;
    }

    public class IntegerCollection
    {
    }
}

namespace Autodesk.AutoCAD.Colors
{
    public enum ColorMethod
    {
        None,
        ByColor,
        ByLayer,
        ByBlock,
        ByAci,
    }

    public class Color
    {
        public ColorMethod ColorMethod => throw null;
        public short ColorIndex => throw null;
        public byte Red => throw null;
        public byte Green => throw null;
        public byte Blue => throw null;
    }
}

namespace Autodesk.AutoCAD.GraphicsInterface
{
    using Autodesk.AutoCAD.Geometry;
    using Autodesk.AutoCAD.Runtime;

    public abstract class Drawable : DisposableWrapper
    {
    }

    public enum TransientDrawingMode
    {
        Main,
        Sprite,
        DirectShortTerm,
        Highlight,
        DirectTopmost,
        Contrast,
    }

    public class TransientManager
    {
        public static TransientManager CurrentTransientManager => throw null;
        public bool AddTransient(Drawable drawable, TransientDrawingMode mode, int subDrawingMode, IntegerCollection viewportNumbers) => throw null;
        public bool EraseTransient(Drawable drawable, IntegerCollection viewportNumbers) => throw null;
    }
}

namespace Autodesk.AutoCAD.DatabaseServices
{
    using System;
    using System.Collections;
    using Autodesk.AutoCAD.Geometry;
    using Autodesk.AutoCAD.GraphicsInterface;
    using Autodesk.AutoCAD.Runtime;

    public enum OpenMode
    {
        ForRead,
        ForWrite,
    }

    public enum UnitsValue
    {
        Undefined,
        Inches,
        Millimeters = 4,
    }

    public struct Handle
    {
        public Handle(long value) => throw null;
    }

    public struct ObjectId
    {
        public static ObjectId Null => throw null;
        public bool IsErased => throw null;
        public Handle Handle => throw null;
        public static bool operator ==(ObjectId one, ObjectId other) => throw null;
        public static bool operator !=(ObjectId one, ObjectId other) => throw null;
    }

    public abstract class DBObject : Drawable
    {
        public Handle Handle => throw null;
        public ObjectId OwnerId => throw null;
        public bool IsErased => throw null;
        public void Erase() => throw null;
        public RXClass GetRXClass() => throw null;
        public ResultBuffer GetXDataForApplication(string name) => throw null;
    }

    public struct TypedValue
    {
        public short TypeCode => throw null;
        public object Value => throw null;
    }

    public class ResultBuffer : DisposableWrapper
    {
        public TypedValue[] AsArray() => throw null;
    }

    public abstract class Entity : DBObject
    {
        public string Layer { get => throw null; set => throw null; }
        public ObjectId LayerId { get => throw null; set => throw null; }
        public string Linetype { get => throw null; set => throw null; }
        public Autodesk.AutoCAD.Colors.Color Color { get => throw null; set => throw null; }
        public bool Visible { get => throw null; set => throw null; }
        public int ColorIndex { get => throw null; set => throw null; }
        public void SetDatabaseDefaults(Database database) => throw null;
        public void SetPropertiesFrom(Entity entity) => throw null;
    }

    public abstract class Curve : Entity
    {
    }

    public class Polyline : Curve
    {
        public Vector3d Normal => throw null;
        public bool Closed { get => throw null; set => throw null; }
        public int NumberOfVertices => throw null;
        public Point2d GetPoint2dAt(int index) => throw null;
        public double GetBulgeAt(int index) => throw null;
        public void SetPointAt(int index, Point2d point) => throw null;
        public void SetBulgeAt(int index, double bulge) => throw null;
        public void AddVertexAt(int index, Point2d point, double bulge, double startWidth, double endWidth) => throw null;
        public void RemoveVertexAt(int index) => throw null;
    }

    public enum Vertex2dType
    {
        SimpleVertex,
        CurveFitVertex,
        SplineFitVertex,
        SplineControlVertex,
    }

    public abstract class Vertex : Entity
    {
    }

    public class Vertex2d : Vertex
    {
        public double Bulge { get => throw null; set => throw null; }
        public Vertex2dType VertexType => throw null;
    }

    public class Polyline2d : Curve, IEnumerable
    {
        public Vector3d Normal => throw null;
        public bool Closed { get => throw null; set => throw null; }
        public IEnumerator GetEnumerator() => throw null;
        public Point3d VertexPosition(Vertex2d vertex) => throw null;
    }

    public class DBPoint : Entity
    {
        public Point3d Position { get => throw null; set => throw null; }
    }

    public class Line : Curve
    {
        public Point3d StartPoint { get => throw null; set => throw null; }
        public Point3d EndPoint { get => throw null; set => throw null; }
    }

    public class Arc : Curve
    {
        public Vector3d Normal => throw null;
        public Point3d Center { get => throw null; set => throw null; }
        public double Radius { get => throw null; set => throw null; }
        public double StartAngle { get => throw null; set => throw null; }
        public double EndAngle { get => throw null; set => throw null; }
    }

    public class Circle : Curve
    {
        public Circle() => throw null;
        public Circle(Point3d center, Vector3d normal, double radius) => throw null;
        public Vector3d Normal => throw null;
        public Point3d Center { get => throw null; set => throw null; }
        public double Radius { get => throw null; set => throw null; }
    }

    public enum TextHorizontalMode
    {
        TextLeft,
        TextCenter,
        TextRight,
        TextAlign,
        TextMid,
        TextFit,
    }

    public enum TextVerticalMode
    {
        TextBase,
        TextBottom,
        TextVerticalMid,
        TextTop,
    }

    public class DBText : Entity
    {
        public TextHorizontalMode HorizontalMode { get => throw null; set => throw null; }
        public TextVerticalMode VerticalMode { get => throw null; set => throw null; }
        public Point3d AlignmentPoint { get => throw null; set => throw null; }
        public Point3d Position { get => throw null; set => throw null; }
        public string TextString { get => throw null; set => throw null; }
        public double Height { get => throw null; set => throw null; }
    }

    public class MText : Entity
    {
        public Point3d Location => throw null;
        public string Text => throw null;
    }

    public class BlockTableRecord : DBObject, IEnumerable
    {
        public IEnumerator GetEnumerator() => throw null;
        public ObjectId AppendEntity(Entity entity) => throw null;
    }

    public abstract class SymbolTableRecord : DBObject
    {
        public string Name { get => throw null; set => throw null; }
    }

    public class LayerTableRecord : SymbolTableRecord
    {
        public bool IsFrozen { get => throw null; set => throw null; }
        public bool IsOff { get => throw null; set => throw null; }
        public ObjectId LinetypeObjectId { get => throw null; set => throw null; }
        public Autodesk.AutoCAD.Colors.Color Color { get => throw null; set => throw null; }
    }

    public class LinetypeTableRecord : SymbolTableRecord
    {
    }

    public class LayerTable : DBObject
    {
        public bool Has(string key) => throw null;
        public ObjectId Add(SymbolTableRecord record) => throw null;
    }

    public static class SymbolUtilityServices
    {
        public static ObjectId GetBlockModelSpaceId(Database database) => throw null;
    }

    public class Transaction : DisposableWrapper
    {
        public DBObject GetObject(ObjectId id, OpenMode mode) => throw null;
        public DBObject GetObject(ObjectId id, OpenMode mode, bool openErased) => throw null;
        public void AddNewlyCreatedDBObject(DBObject added, bool add) => throw null;
        public void Commit() => throw null;
    }

    public class OpenCloseTransaction : Transaction
    {
    }

    public class TransactionManager : DisposableWrapper
    {
        public Transaction StartTransaction() => throw null;
        public OpenCloseTransaction StartOpenCloseTransaction() => throw null;
    }

    public class ObjectEventArgs : EventArgs
    {
        public DBObject DBObject => throw null;
    }

    public class ObjectErasedEventArgs : ObjectEventArgs
    {
        public bool Erased => throw null;
    }

    public delegate void ObjectEventHandler(object sender, ObjectEventArgs change);

    public delegate void ObjectErasedEventHandler(object sender, ObjectErasedEventArgs change);

    public class Database : DisposableWrapper
    {
        public UnitsValue Insunits => throw null;
        public ObjectId LayerTableId => throw null;
        public TransactionManager TransactionManager => throw null;
        public bool TryGetObjectId(Handle handle, out ObjectId id) => throw null;
        public event ObjectEventHandler ObjectAppended;
        public event ObjectEventHandler ObjectModified;
        public event ObjectErasedEventHandler ObjectErased;
        public event ObjectEventHandler ObjectUnappended;
        public event ObjectEventHandler ObjectReappended;
    }

    public class ViewTableRecord : DBObject
    {
        public Point2d CenterPoint { get => throw null; set => throw null; }
        public Point3d Target { get => throw null; set => throw null; }
        public Vector3d ViewDirection { get => throw null; set => throw null; }
        public double ViewTwist { get => throw null; set => throw null; }
        public double Height { get => throw null; set => throw null; }
        public double Width { get => throw null; set => throw null; }
    }
}

namespace Autodesk.AutoCAD.EditorInput
{
    using Autodesk.AutoCAD.DatabaseServices;

    public enum PromptStatus
    {
        OK = 5100,
        Cancel = -5002,
    }

    public class PromptSaveFileOptions
    {
        public PromptSaveFileOptions(string message) => throw null;
        public string Filter { get => throw null; set => throw null; }
        public string InitialFileName { get => throw null; set => throw null; }
    }

    public class PromptFileNameResult
    {
        public PromptStatus Status => throw null;
        public string StringResult => throw null;
    }

    public class PromptPointResult
    {
        public PromptStatus Status => throw null;
        public Autodesk.AutoCAD.Geometry.Point3d Value => throw null;
    }

    public class Editor
    {
        public Autodesk.AutoCAD.Geometry.Matrix3d CurrentUserCoordinateSystem { get => throw null; set => throw null; }
        public PromptPointResult GetPoint(string message) => throw null;
        public void WriteMessage(string message) => throw null;
        public PromptFileNameResult GetFileNameForSave(PromptSaveFileOptions options) => throw null;
        public ViewTableRecord GetCurrentView() => throw null;
        public void SetCurrentView(ViewTableRecord view) => throw null;
        public void SetImpliedSelection(ObjectId[] ids) => throw null;
    }
}

namespace Autodesk.AutoCAD.Windows
{
    using System;
    using System.Windows.Forms;

    public class PaletteSet : IDisposable
    {
        public PaletteSet(string name, Guid id) => throw null;
        public bool Visible { get => throw null; set => throw null; }
        public void Add(string name, Control control) => throw null;
        public void Dispose() => throw null;
    }
}

namespace Autodesk.AutoCAD.ApplicationServices
{
    using System;
    using Autodesk.AutoCAD.DatabaseServices;
    using Autodesk.AutoCAD.EditorInput;
    using Autodesk.AutoCAD.Runtime;

    public class DocumentLock : DisposableWrapper
    {
    }

    public class CommandEventArgs : EventArgs
    {
        public string GlobalCommandName => throw null;
    }

    public delegate void CommandEventHandler(object sender, CommandEventArgs command);

    public class Document
    {
        public string Name => throw null;
        public string CommandInProgress => throw null;
        public Database Database => throw null;
        public Editor Editor => throw null;
        public DocumentLock LockDocument() => throw null;
        public event CommandEventHandler CommandEnded;
        public event CommandEventHandler CommandCancelled;
        public event CommandEventHandler CommandFailed;
        public event EventHandler LispEnded;
        public event EventHandler LispCancelled;
    }

    public class DocumentCollectionEventArgs : EventArgs
    {
        public Document Document => throw null;
    }

    public delegate void DocumentCollectionEventHandler(object sender, DocumentCollectionEventArgs change);

    public class DocumentCollection
    {
        public Document MdiActiveDocument { get => throw null; set => throw null; }
        public event DocumentCollectionEventHandler DocumentActivated;
        public event DocumentCollectionEventHandler DocumentToBeDeactivated;
        public event DocumentCollectionEventHandler DocumentToBeDestroyed;
    }
}

namespace Autodesk.AutoCAD.ApplicationServices.Core
{
    public static class Application
    {
        public static DocumentCollection DocumentManager => throw null;
        public static object GetSystemVariable(string name) => throw null;
        public static event System.EventHandler Idle;
    }
}
