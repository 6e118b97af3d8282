using System;
using Autodesk.AutoCAD.ApplicationServices;
using Autodesk.AutoCAD.DatabaseServices;
using Wedm.Core;
using CadApplication = Autodesk.AutoCAD.ApplicationServices.Core.Application;

namespace Wedm.AutoCad
{
    /// <summary>
    /// Follows one document: events of its database mark what they touched; the end of each command sends it, and so does the next idle moment
    /// outside of commands, as after an edit in the properties palette. Nothing is read within an event of the database, where objects may be
    /// open for writing.
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
            // Undo takes away what a command has drawn, and redo brings it back: neither erases or appends anything.
            document.Database.ObjectUnappended += Touched;
            document.Database.ObjectReappended += Touched;
            document.CommandEnded += CommandEnded;
            document.CommandCancelled += CommandEnded;
            document.CommandFailed += CommandEnded;
            document.LispEnded += LispEnded;
            document.LispCancelled += LispEnded;
            CadApplication.Idle += Idle;
        }

        public Document Document => _document;

        public AutoCadDrawing Host { get; }

        public LiveDrawing Drawing { get; }

        /// <summary>A command has ended and what it changed has been sent.</summary>
        public event Action Changed;

        public void Dispose()
        {
            _document.Database.ObjectAppended -= Touched;
            _document.Database.ObjectModified -= Touched;
            _document.Database.ObjectErased -= Erased;
            _document.Database.ObjectUnappended -= Touched;
            _document.Database.ObjectReappended -= Touched;
            _document.CommandEnded -= CommandEnded;
            _document.CommandCancelled -= CommandEnded;
            _document.CommandFailed -= CommandEnded;
            _document.LispEnded -= LispEnded;
            _document.LispCancelled -= LispEnded;
            CadApplication.Idle -= Idle;
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
            if (touched is Vertex2d)
            {
                // A heavy polyline changes with its vertices.
                Drawing.Touch(touched.OwnerId.Handle.ToString());
            }
            else if (touched is Autodesk.AutoCAD.DatabaseServices.Entity)
            {
                Drawing.Touch(touched.Handle.ToString());
            }
            else if (touched is LayerTableRecord)
            {
                // Frozen, switched off, another linetype, another name.
                Drawing.TouchAll();
            }
        }

        /// <summary>Says something on the command line of this document, whichever is in front.</summary>
        public void Say(string sentence)
        {
            _document.Editor.WriteMessage("\nwedm: " + sentence + "\n");
        }

        private void Idle(object sender, EventArgs nothing)
        {
            if (Drawing.HasUnsentChanges && string.IsNullOrEmpty(_document.CommandInProgress))
            {
                Send();
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
