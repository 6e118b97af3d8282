using System;
using System.Collections.Generic;
using Autodesk.AutoCAD.DatabaseServices;
using Autodesk.AutoCAD.Geometry;
using Autodesk.AutoCAD.GraphicsInterface;
using Wedm.Core;

namespace Wedm.AutoCad
{
    /// <summary>Rings round the faults, drawn over the drawing and never part of it.</summary>
    internal sealed class Highlights : IDisposable
    {
        private const short Red = 1;
        private const short Yellow = 2;

        /// <summary>The radius of a ring as a multiple of the radius that it marks, so that both can be seen.</summary>
        private const double RingPerRadius = 3;

        private readonly List<Circle> _rings = new List<Circle>();

        public void Show(IEnumerable<Finding> findings)
        {
            Clear();
            foreach (var finding in findings)
            {
                var at = finding.Center ?? finding.Start;
                if (at == null || finding.Severity > Severity.Warning)
                {
                    continue;
                }
                var radius = Math.Max(finding.Radius ?? 0, 0.1) * RingPerRadius;
                var ring = new Circle(new Point3d(at[0], at[1], 0), Vector3d.ZAxis, radius) { ColorIndex = finding.Severity == Severity.Error ? Red : Yellow };
                _rings.Add(ring);
                TransientManager.CurrentTransientManager.AddTransient(ring, TransientDrawingMode.DirectTopmost, 128, new IntegerCollection());
            }
        }

        public void Clear()
        {
            foreach (var ring in _rings)
            {
                TransientManager.CurrentTransientManager.EraseTransient(ring, new IntegerCollection());
                ring.Dispose();
            }
            _rings.Clear();
        }

        public void Dispose()
        {
            Clear();
        }
    }
}
