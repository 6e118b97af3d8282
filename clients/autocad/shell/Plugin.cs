using System;
using System.Collections.Generic;
using System.IO;
using System.Reflection;
using System.Windows.Forms;
using Autodesk.AutoCAD.ApplicationServices;
using Autodesk.AutoCAD.Runtime;
using Wedm.Core;
using CadApplication = Autodesk.AutoCAD.ApplicationServices.Core.Application;

[assembly: ExtensionApplication(typeof(Wedm.AutoCad.Plugin))]

namespace Wedm.AutoCad
{
    /// <summary>What lives as long as AutoCAD: one session with the server, one watch for each document.</summary>
    public sealed class Plugin : IExtensionApplication
    {
        /// <summary>The interval at which the server's messages are handed over, ms.</summary>
        private const int PumpInterval = 100;

        private readonly Dictionary<Document, DocumentWatch> _watches = new Dictionary<Document, DocumentWatch>();
        private Session _session;
        private Timer _timer;

        internal static Plugin Instance { get; private set; }

        internal Session Session => _session;

        public void Initialize()
        {
            Instance = this;
            var folder = Path.GetDirectoryName(Assembly.GetExecutingAssembly().Location);
            _session = new Session(() => ServerLocator.Find(
                Environment.GetEnvironmentVariable("WEDM_SERVER"), folder, Environment.GetEnvironmentVariable("PATH"),
                Environment.GetFolderPath(Environment.SpecialFolder.UserProfile)));
            _session.Message += Say;
            // The timer's ticks come on AutoCAD's own thread, also while it waits for input.
            _timer = new Timer { Interval = PumpInterval };
            _timer.Tick += (sender, nothing) => _session.Pump();
            _timer.Start();
            CadApplication.DocumentManager.DocumentToBeDestroyed += Closing;
        }

        public void Terminate()
        {
            _timer.Dispose();
            CadApplication.DocumentManager.DocumentToBeDestroyed -= Closing;
            foreach (var watch in _watches.Values)
            {
                watch.Dispose();
            }
            _session.Dispose();
        }

        /// <summary>The watch of the document in front; starts server and watch when they do not run yet.</summary>
        internal DocumentWatch Watch()
        {
            var document = CadApplication.DocumentManager.MdiActiveDocument;
            if (_session.State == SessionState.Stopped || _session.State == SessionState.Failed)
            {
                _session.Start();
            }
            if (!_watches.TryGetValue(document, out var watch))
            {
                watch = new DocumentWatch(document, _session);
                _watches[document] = watch;
            }
            return watch;
        }

        internal static void Say(string sentence)
        {
            CadApplication.DocumentManager.MdiActiveDocument?.Editor.WriteMessage("\nwedm: " + sentence + "\n");
        }

        private void Closing(object sender, DocumentCollectionEventArgs closing)
        {
            if (_watches.TryGetValue(closing.Document, out var watch))
            {
                _watches.Remove(closing.Document);
                watch.Dispose();
            }
        }
    }
}
