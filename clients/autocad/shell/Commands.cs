using System;
using System.IO;
using Autodesk.AutoCAD.EditorInput;
using Autodesk.AutoCAD.Runtime;
using Wedm.Core;
using CadApplication = Autodesk.AutoCAD.ApplicationServices.Core.Application;

[assembly: CommandClass(typeof(Wedm.AutoCad.Commands))]

namespace Wedm.AutoCad
{
    /// <summary>The commands. Each asks the server and returns; the answer is dealt with when it arrives.</summary>
    public sealed class Commands
    {
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
            var watch = Plugin.Instance.Watch();
            Plugin.Instance.Session.Fix(watch.Drawing, null, Plugin.Say, Plugin.Say);
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
            Plugin.Instance.Session.DrawPath(watch.Drawing, Plugin.Say, Plugin.Say);
        }

        /// <summary>Asks for a point and marks it as the thread hole of the contour nearest to it.</summary>
        [CommandMethod("WEDMHOLE")]
        public static void PickHole()
        {
            var watch = Plugin.Instance.Watch();
            var answer = CadApplication.DocumentManager.MdiActiveDocument.Editor.GetPoint("\nThread hole");
            if (answer.Status == PromptStatus.OK)
            {
                Plugin.Say(Plugin.Instance.Session.MarkHole(watch.Drawing, answer.Value.X, answer.Value.Y) ?? "the thread hole is marked on the layer " + Toolpath.HoleLayer);
            }
        }

        /// <summary>Draws the start holes and writes the drill list to a file that the user chooses.</summary>
        [CommandMethod("WEDMHOLES")]
        public static void DrillList()
        {
            var document = CadApplication.DocumentManager.MdiActiveDocument;
            var watch = Plugin.Instance.Watch();
            Plugin.Instance.Session.DrawHoles(watch.Drawing, Plugin.Say, Plugin.Say);
            WithFile("drill list", ".csv", path => Plugin.Instance.Session.FindPath(
                watch.Drawing, found => Save(path, found.DrillList(Path.GetFileName(document.Name))), Plugin.Say));
        }

        /// <summary>Says whether punch and plate fit, and writes the picture to a file that the user chooses.</summary>
        [CommandMethod("WEDMFIT")]
        public static void CheckFit()
        {
            var watch = Plugin.Instance.Watch();
            WithFile("picture of the fit", ".svg", path => Plugin.Instance.Session.CheckFit(
                watch.Drawing,
                found =>
                {
                    Plugin.Say(found.InWords());
                    Save(path, found.Svg);
                },
                Plugin.Say));
        }

        /// <summary>Says how long the drawing takes on the machine, and the other figures that are known.</summary>
        [CommandMethod("WEDMWORK")]
        public static void SayFigures()
        {
            var watch = Plugin.Instance.Watch();
            Plugin.Instance.Session.FindPath(watch.Drawing, found => Plugin.Say(found.Figures()), Plugin.Say);
        }

        private static void Generate(string format)
        {
            var watch = Plugin.Instance.Watch();
            WithFile(Session.NameOf(format) + " program", Session.EndingOf(format), path => Plugin.Instance.Session.Generate(
                watch.Drawing, format, program => Save(path, program), Plugin.Say));
        }

        /// <summary>Asks for a file beside the drawing.</summary>
        private static void WithFile(string what, string ending, System.Action<string> chosen)
        {
            var document = CadApplication.DocumentManager.MdiActiveDocument;
            var options = new PromptSaveFileOptions("\nSave the " + what + " as")
            {
                Filter = what + " (*" + ending + ")|*" + ending,
                InitialFileName = Path.ChangeExtension(document.Name, ending),
            };
            var answer = document.Editor.GetFileNameForSave(options);
            if (answer.Status == PromptStatus.OK)
            {
                chosen(answer.StringResult);
            }
        }

        private static void Save(string path, string program)
        {
            try
            {
                ProgramFile.Write(path, program);
                Plugin.Say("written " + path);
            }
            catch (System.Exception fault) when (fault is IOException || fault is UnauthorizedAccessException)
            {
                Plugin.Say(path + " cannot be written: " + fault.Message);
            }
        }
    }
}
