using System;
using Autodesk.AutoCAD.ApplicationServices;
using Autodesk.AutoCAD.DatabaseServices;
using Wedm.Core;

namespace Wedm.AutoCad
{
    /// <summary>
    /// Follows one document: events of its database mark what they touched, and the end of each command sends it. Nothing is read
    /// within an event of the database, where objects may be open for writing.
    /// </summary>
    internal sealed class DocumentWatch : IDisposable
    {
        private readonly Document _document;
        private readonly Session _session;

        public DocumentWatch(Document document, Session session)
        {
            _document = document;
            _session = session;
            Host = new AutoCadDrawing(document);
            Drawing = session.Open(DrawingUri.Of(document.Name), Host);
            document.Database.ObjectAppended += Touched;
            document.Database.ObjectModified += Touched;
            document.Database.ObjectErased += Erased;
            document.CommandEnded += CommandEnded;
            document.CommandCancelled += CommandEnded;
            document.LispEnded += LispEnded;
        }

        public AutoCadDrawing Host { get; }

        public LiveDrawing Drawing { get; }

        /// <summary>A command has ended and what it changed has been sent.</summary>
        public event Action Changed;

        public void Dispose()
        {
            _document.Database.ObjectAppended -= Touched;
            _document.Database.ObjectModified -= Touched;
            _document.Database.ObjectErased -= Erased;
            _document.CommandEnded -= CommandEnded;
            _document.CommandCancelled -= CommandEnded;
            _document.LispEnded -= LispEnded;
            _session.Close(Drawing);
        }

        private void Touched(object sender, ObjectEventArgs change)
        {
            Touch(change.DBObject);
        }

        /// <summary>Erased, or brought back by undo.</summary>
        private void Erased(object sender, ObjectErasedEventArgs change)
        {
            Touch(change.DBObject);
        }

        private void Touch(DBObject touched)
        {
            if (touched is Autodesk.AutoCAD.DatabaseServices.Entity)
            {
                Drawing.Touch(touched.Handle.ToString());
            }
        }

        private void CommandEnded(object sender, CommandEventArgs command)
        {
            Send();
        }

        private void LispEnded(object sender, EventArgs nothing)
        {
            Send();
        }

        private void Send()
        {
            if (Drawing.Flush() > 0)
            {
                Changed?.Invoke();
            }
        }
    }
}
