using System;
using System.Collections.Generic;
using Autodesk.AutoCAD.ApplicationServices;
using Autodesk.AutoCAD.Geometry;
using Autodesk.AutoCAD.Windows;
using Wedm.Core;
using CadApplication = Autodesk.AutoCAD.ApplicationServices.Core.Application;

namespace Wedm.AutoCad
{
    /// <summary>
    /// The palette of RMIN: the radius list of the document that was in front when it was called, kept up to date, and rings round the faults.
    /// </summary>
    internal sealed class Palette
    {
        /// <summary>The margin that is shown round a chosen segment, drawing units.</summary>
        private const double ViewMargin = 5;

        private readonly PaletteSet _set;
        private readonly RadiusPanel _panel = new RadiusPanel();
        private readonly Highlights _highlights = new Highlights();
        private DocumentWatch _watch;

        public Palette()
        {
            _set = new PaletteSet("wedm: R minimum", new Guid("6a1f7a8e-5a0b-4d0e-9a4d-0d3f5c1b7e21"));
            _set.Add("Radii", _panel);
            _panel.CheckWanted += List;
            _panel.FixWanted += Fix;
            _panel.RowActivated += Zoom;
            CadApplication.DocumentManager.DocumentToBeDeactivated += Leaving;
            CadApplication.DocumentManager.DocumentActivated += Entering;
            CadApplication.DocumentManager.DocumentToBeDestroyed += Closing;
        }

        public void Show(DocumentWatch watch)
        {
            if (_watch != watch)
            {
                Forget();
                _watch = watch;
                _watch.Drawing.FindingsChanged += Refresh;
            }
            _set.Visible = true;
            if (_watch.Drawing.FindingsVersion > 0)
            {
                Refresh(_watch.Drawing);
            }
        }

        /// <summary>True while the document of the list is in front.</summary>
        private bool IsInFront => _watch != null && CadApplication.DocumentManager.MdiActiveDocument == _watch.Document;

        private void Forget()
        {
            if (_watch != null)
            {
                _watch.Drawing.FindingsChanged -= Refresh;
                _watch = null;
            }
            _highlights.Clear();
        }

        /// <summary>Rings are drawn over the document in front: they go before another one comes there.</summary>
        private void Leaving(object sender, DocumentCollectionEventArgs change)
        {
            _highlights.Clear();
        }

        private void Entering(object sender, DocumentCollectionEventArgs change)
        {
            if (IsInFront)
            {
                _highlights.Show(_watch.Drawing.Findings);
            }
        }

        private void Closing(object sender, DocumentCollectionEventArgs closing)
        {
            if (_watch != null && closing.Document == _watch.Document)
            {
                Forget();
                _panel.Show(new RadiusRow[0]);
            }
        }

        private void Refresh(LiveDrawing drawing)
        {
            if (IsInFront)
            {
                _highlights.Show(drawing.Findings);
            }
            List();
        }

        private void List()
        {
            var watch = _watch;
            if (watch != null)
            {
                Plugin.Instance.Session.ListRadii(watch.Drawing, rows => Show(watch, rows), _panel.Say);
            }
        }

        /// <summary>The answer for a document that is no longer the list's is dropped.</summary>
        private void Show(DocumentWatch watch, IReadOnlyList<RadiusRow> rows)
        {
            if (watch == _watch)
            {
                _panel.LeftOut = watch.Drawing.LeftOut;
                _panel.Show(rows);
            }
        }

        private void Fix()
        {
            if (_watch != null)
            {
                Commands.Fix(_watch);
            }
        }

        /// <summary>Goes to a row in the document that it belongs to, whichever is in front.</summary>
        private void Zoom(RadiusRow row)
        {
            if (_watch == null || !_watch.Host.TryFind(row.Handle, out var id))
            {
                return;
            }
            var document = _watch.Document;
            if (!IsInFront)
            {
                CadApplication.DocumentManager.MdiActiveDocument = document;
            }
            using (document.LockDocument())
            using (var view = document.Editor.GetCurrentView())
            {
                // The centre of a view is in display coordinates.
                var toDisplay = (Matrix3d.Rotation(-view.ViewTwist, view.ViewDirection, view.Target)
                    * Matrix3d.Displacement(view.Target - Point3d.Origin)
                    * Matrix3d.PlaneToWorld(view.ViewDirection)).Inverse();
                var at = new Point3d(row.X, row.Y, 0).TransformBy(toDisplay);
                view.CenterPoint = new Point2d(at.X, at.Y);
                view.Height = ((row.Radius ?? 0) * 2) + ViewMargin;
                view.Width = view.Height;
                document.Editor.SetCurrentView(view);
            }
            document.Editor.SetImpliedSelection(new[] { id });
        }
    }
}
