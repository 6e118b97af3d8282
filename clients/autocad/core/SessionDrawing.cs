using System;
using System.Collections.Generic;

namespace Wedm.Core
{
    /// <summary>What the server works out is drawn into the drawing, on layers of the plugin's own.</summary>
    public sealed partial class Session
    {
        /// <summary>Draws the wire's path on the layer <see cref="Toolpath.PathLayer"/>, in place of what lies there, as one step of undo.</summary>
        public void DrawPath(LiveDrawing drawing, Action<string> done, Action<string> refused)
        {
            Draw(drawing, Toolpath.PathLayer, path => path.Pieces, path => "the wire's path is on the layer " + Toolpath.PathLayer + ", " + path.Figures().Split('\n')[0], done, refused);
        }

        /// <summary>
        /// Draws the start holes with their marks on the layer <see cref="Toolpath.HoleLayer"/>, in place of what lies there. A mark that is moved there moves the hole.
        /// </summary>
        public void DrawHoles(LiveDrawing drawing, Action<string> done, Action<string> refused)
        {
            Draw(drawing, Toolpath.HoleLayer, path => path.DrawnHoles(), path => path.Holes.Count + " start holes are on the layer " + Toolpath.HoleLayer, done, refused);
        }

        /// <summary>Marks a thread hole: the mark counts for the contour nearest to it. Returns null, or why it was refused.</summary>
        public string MarkHole(LiveDrawing drawing, double x, double y)
        {
            return drawing.Draw(Toolpath.HoleLayer, new Entity[] { new TextEntity(null, Toolpath.HoleLayer, new[] { x, y }, Toolpath.Mark) }, false);
        }

        private void Draw(LiveDrawing drawing, string layer, Func<Toolpath, IReadOnlyList<Entity>> entities, Func<Toolpath, string> words,
            Action<string> done, Action<string> refused)
        {
            drawing.AfterRepairs(() =>
            {
                drawing.Flush();
                var version = drawing.Version;
                FindPath(drawing, path =>
                {
                    if (drawing.Version != version || drawing.HasUnsentChanges)
                    {
                        refused("the drawing has changed since the path was made for it; nothing was drawn");
                        return;
                    }
                    var refusal = drawing.Draw(layer, entities(path), true);
                    if (refusal == null)
                    {
                        done(words(path));
                    }
                    else
                    {
                        refused(refusal);
                    }
                }, refused);
            });
        }
    }
}
