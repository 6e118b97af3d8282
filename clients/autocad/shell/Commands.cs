using System;
using System.IO;
using Autodesk.AutoCAD.EditorInput;
using Autodesk.AutoCAD.Runtime;
using Wedm.Core;
using CadApplication = Autodesk.AutoCAD.ApplicationServices.Core.Application;

[assembly: CommandClass(typeof(Wedm.AutoCad.Commands))]

namespace Wedm.AutoCad
{
    /// <summary>RMIN, RMINFIX, WEDM3B. Each asks the server and returns; what it answers is dealt with when it arrives.</summary>
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
        public static void Generate()
        {
            var document = CadApplication.DocumentManager.MdiActiveDocument;
            var watch = Plugin.Instance.Watch();
            var options = new PromptSaveFileOptions("\nSave the 3B program as")
            {
                Filter = "3B program (*.3b)|*.3b",
                InitialFileName = Path.ChangeExtension(document.Name, ".3b"),
            };
            var answer = document.Editor.GetFileNameForSave(options);
            if (answer.Status == PromptStatus.OK)
            {
                Plugin.Instance.Session.Generate(watch.Drawing, "3b", program => Save(answer.StringResult, program), Plugin.Say);
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
