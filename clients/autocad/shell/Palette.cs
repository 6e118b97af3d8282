using System;
using Autodesk.AutoCAD.DatabaseServices;
using Autodesk.AutoCAD.EditorInput;
using Autodesk.AutoCAD.Geometry;
using Autodesk.AutoCAD.Windows;
using Wedm.Core;
using CadApplication = Autodesk.AutoCAD.ApplicationServices.Core.Application;

namespace Wedm.AutoCad
{
    /// <summary>The palette of RMIN: the radius list of the document in front, kept up to date, and rings round the faults.</summary>
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
            _panel.FixWanted += Commands.FixAll;
            _panel.RowActivated += Zoom;
        }

        public void Show(DocumentWatch watch)
        {
            if (_watch != watch)
            {
                if (_watch != null)
                {
                    _watch.Drawing.FindingsChanged -= Refresh;
                }
                _watch = watch;
                _watch.Drawing.FindingsChanged += Refresh;
            }
            _set.Visible = true;
            if (_watch.Drawing.FindingsVersion > 0)
            {
                Refresh(_watch.Drawing);
            }
        }

        private void Refresh(LiveDrawing drawing)
        {
            _highlights.Show(drawing.Findings);
            List();
        }

        private void List()
        {
            if (_watch != null)
            {
                Plugin.Instance.Session.ListRadii(_watch.Drawing, _panel.Show, _panel.Say);
            }
        }

        private void Zoom(RadiusRow row)
        {
            var editor = CadApplication.DocumentManager.MdiActiveDocument.Editor;
            using (var view = editor.GetCurrentView())
            {
                view.CenterPoint = new Point2d(row.X, row.Y);
                view.Height = ((row.Radius ?? 0) * 2) + ViewMargin;
                view.Width = view.Height;
                editor.SetCurrentView(view);
            }
            if (_watch.Host.TryFind(row.Handle, out var id))
            {
                editor.SetImpliedSelection(new[] { id });
            }
        }
    }
}
