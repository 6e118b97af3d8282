using System;
using System.Globalization;
using System.IO;
using Autodesk.AutoCAD.EditorInput;
using Autodesk.AutoCAD.Runtime;
using Wedm.Core;
using CadApplication = Autodesk.AutoCAD.ApplicationServices.Core.Application;

[assembly: CommandClass(typeof(Wedm.AutoCad.Commands))]

namespace Wedm.AutoCad
{
    /// <summary>The commands. Each asks the server and returns; the answer is dealt with when it arrives, but in scripts before the next command.</summary>
    public sealed class Commands
    {
        /// <summary>Bits of the system variable CMDACTIVE.</summary>
        private const int ScriptActive = 4;

        private const int LispActive = 32;

        /// <summary>How long a script waits for one answer.</summary>
        private static readonly TimeSpan Patience = TimeSpan.FromMinutes(2);

        private static Palette _palette;

        /// <summary>Shows the radius list and rings round what is too tight; both follow the drawing from then on.</summary>
        [CommandMethod("RMIN")]
        public static void RadiusList()
        {
            var watch = Plugin.Instance.Watch();
            _palette = _palette ?? new Palette();
            _palette.Show(watch);
        }

        /// <summary>Repairs all that can be repaired safely, as one step of undo.</summary>
        [CommandMethod("RMINFIX")]
        public static void FixAll()
        {
            Fix(Plugin.Instance.Watch());
        }

        internal static void Fix(DocumentWatch watch)
        {
            Plugin.Instance.Session.Fix(watch.Drawing, null, watch.Say, watch.Say);
            Finish(watch);
        }

        /// <summary>Writes the 3B program of the drawing to a file that the user chooses.</summary>
        [CommandMethod("WEDM3B")]
        public static void Generate3B() => Generate("3b");

        [CommandMethod("WEDM4B")]
        public static void Generate4B() => Generate("4b");

        [CommandMethod("WEDMISO")]
        public static void GenerateIso() => Generate("iso");

        /// <summary>Writes the program of an electrode that mills, with the table [milling] of the wedm.toml.</summary>
        [CommandMethod("WEDMMILL")]
        public static void GenerateMilling() => Generate("milling");

        /// <summary>Draws the wire's path on its layer.</summary>
        [CommandMethod("WEDMPATH")]
        public static void DrawPath()
        {
            var watch = Plugin.Instance.Watch();
            Plugin.Instance.Session.DrawPath(watch.Drawing, watch.Say, watch.Say);
            Finish(watch);
        }

        /// <summary>Asks for a point and marks it as the thread hole of the contour nearest to it.</summary>
        [CommandMethod("WEDMHOLE")]
        public static void PickHole()
        {
            var watch = Plugin.Instance.Watch();
            var editor = watch.Document.Editor;
            var answer = editor.GetPoint("\nThread hole");
            if (answer.Status == PromptStatus.OK)
            {
                // The point is one of the user's coordinate system.
                var at = answer.Value.TransformBy(editor.CurrentUserCoordinateSystem);
                watch.Say(Plugin.Instance.Session.MarkHole(watch.Drawing, at.X, at.Y) ?? "the thread hole is marked on the layer " + Toolpath.HoleLayer);
            }
        }

        /// <summary>Draws the start holes and writes the drill list to a file that the user chooses.</summary>
        [CommandMethod("WEDMHOLES")]
        public static void DrillList()
        {
            var watch = Plugin.Instance.Watch();
            Plugin.Instance.Session.DrawHoles(watch.Drawing, watch.Say, watch.Say);
            WithFile(watch, "drill list", ".csv", path => Plugin.Instance.Session.FindPath(
                watch.Drawing, found => Save(watch, path, found.DrillList(Path.GetFileName(watch.Document.Name))), watch.Say));
        }

        /// <summary>Says whether punch and plate fit, and writes the picture to a file that the user chooses.</summary>
        [CommandMethod("WEDMFIT")]
        public static void CheckFit()
        {
            var watch = Plugin.Instance.Watch();
            WithFile(watch, "picture of the fit", ".svg", path => Plugin.Instance.Session.CheckFit(
                watch.Drawing,
                found =>
                {
                    watch.Say(found.InWords());
                    Save(watch, path, found.Svg);
                },
                watch.Say));
        }

        /// <summary>Says how long the drawing takes on the machine, and the other figures that are known.</summary>
        [CommandMethod("WEDMWORK")]
        public static void SayFigures()
        {
            var watch = Plugin.Instance.Watch();
            Plugin.Instance.Session.FindPath(watch.Drawing, found => watch.Say(found.Figures()), watch.Say);
            Finish(watch);
        }

        private static void Generate(string format)
        {
            var watch = Plugin.Instance.Watch();
            WithFile(watch, Session.NameOf(format) + " program", Session.EndingOf(format), path => Plugin.Instance.Session.Generate(
                watch.Drawing, format, program => Save(watch, path, program), watch.Say));
            if (watch.Drawing.LeftOut != null)
            {
                watch.Say("not checked and not in the program: " + watch.Drawing.LeftOut + " (explode them, or check the saved DXF with wedm)");
            }
        }

        /// <summary>Asks for a file beside the drawing.</summary>
        private static void WithFile(DocumentWatch watch, string what, string ending, System.Action<string> chosen)
        {
            var options = new PromptSaveFileOptions("\nSave the " + what + " as")
            {
                Filter = what + " (*" + ending + ")|*" + ending,
                InitialFileName = Path.ChangeExtension(watch.Document.Name, ending),
            };
            var answer = watch.Document.Editor.GetFileNameForSave(options);
            if (answer.Status == PromptStatus.OK)
            {
                chosen(answer.StringResult);
                Finish(watch);
            }
        }

        /// <summary>
        /// Where a script or a Lisp program calls the commands, the next one comes at once, and may close the drawing: the answer is waited for.
        /// </summary>
        private static void Finish(DocumentWatch watch)
        {
            var active = Convert.ToInt32(CadApplication.GetSystemVariable("CMDACTIVE"), CultureInfo.InvariantCulture);
            if ((active & (ScriptActive | LispActive)) != 0 && !Plugin.Instance.Session.Finish(Patience))
            {
                watch.Say("the server has not answered within " + Patience.TotalSeconds + " s");
            }
        }

        private static void Save(DocumentWatch watch, string path, string program)
        {
            try
            {
                ProgramFile.Write(path, program);
                watch.Say("written " + path);
            }
            catch (System.Exception fault) when (fault is IOException || fault is UnauthorizedAccessException)
            {
                watch.Say(path + " cannot be written: " + fault.Message);
            }
        }
    }
}
