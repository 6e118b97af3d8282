using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.IO;
using System.Linq;
using Newtonsoft.Json.Linq;
using NUnit.Framework;
using Wedm.Core;

namespace Wedm.Tests
{
    /// <summary>The core against the real server.</summary>
    [TestFixture]
    public class SessionTests
    {
        /// <summary>Small sessions, whose messages are recorded for the protocol suite.</summary>
        private const string Recorded = "Session";

        private readonly List<string> _messages = new List<string>();
        private Session _session;

        [SetUp]
        public void Start()
        {
            _messages.Clear();
            _session = new Session(Plates.Server);
            _session.Message += _messages.Add;
            _session.Start();
        }

        [TearDown]
        public void Stop()
        {
            _session.Dispose();
        }

        private LiveDrawing Open(MemoryDrawing host, string uri = "cad:plate")
        {
            var drawing = _session.Open(uri, host);
            host.Watcher = drawing;
            _session.UntilChecked(drawing);
            return drawing;
        }

        private string Outcome(Action<Action<string>, Action<string>> ask)
        {
            string outcome = null;
            ask(done => outcome = "done: " + done, refused => outcome = "refused: " + refused);
            _session.Until(() => outcome != null, "an answer");
            return outcome;
        }

        private string Fix(LiveDrawing drawing, Finding finding = null) => Outcome((done, refused) => _session.Fix(drawing, finding, done, refused));

        private static string[] Rules(LiveDrawing drawing) => drawing.Findings.Where(finding => finding.Severity == Severity.Error).Select(finding => finding.Rule).ToArray();

        [Test, Category(Recorded)]
        public void A_tight_arc_is_found_fixed_in_one_step_of_undo_and_comes_back_with_it()
        {
            var host = new MemoryDrawing(Plates.WithFillet(0.05));
            var drawing = Open(host);
            CollectionAssert.AreEqual(new[] { "small-radius" }, Rules(drawing));
            var finding = drawing.Findings.First(one => one.Rule == "small-radius");
            Assert.AreEqual("2A", finding.Handle);
            Assert.AreEqual(1, finding.Segment);
            Assert.AreEqual(0.05, finding.Radius.Value, 1e-9);
            StringAssert.StartsWith("done: Replace the arc by one of R 0.101 mm", Fix(drawing, finding));
            _session.UntilChecked(drawing);
            CollectionAssert.IsEmpty(Rules(drawing));
            Assert.AreEqual(1, host.StepsOfUndo);
            host.Undo();
            Assert.AreEqual(1, drawing.Flush());
            _session.UntilChecked(drawing);
            CollectionAssert.AreEqual(new[] { "small-radius" }, Rules(drawing));
        }

        [Test]
        public void All_that_is_safe_is_fixed_at_once()
        {
            var host = new MemoryDrawing(Plates.WithFillet(0.05), new LineEntity("3", "0", new[] { 50.0, 0 }, new[] { 60.0, 0 }));
            var drawing = Open(host);
            StringAssert.StartsWith("done: Fix all", Fix(drawing));
            _session.UntilChecked(drawing);
            CollectionAssert.DoesNotContain(Rules(drawing), "small-radius");
            Assert.AreEqual(1, host.StepsOfUndo);
            StringAssert.StartsWith("refused: nothing here can be fixed", Fix(drawing));
        }

        [Test, Category(Recorded)]
        public void An_edit_is_sent_as_a_splice_and_its_findings_arrive()
        {
            var host = new MemoryDrawing(Plates.WithFillet(2), Plates.WithFillet(3, "2B"));
            var drawing = Open(host);
            CollectionAssert.IsEmpty(Rules(drawing));
            host.Edit(Plates.WithFillet(0.08, "2B"));
            Assert.IsTrue(drawing.HasUnsentChanges);
            Assert.AreEqual(1, drawing.Flush());
            _session.UntilChecked(drawing);
            Assert.AreEqual("2B", drawing.Findings.Single(finding => finding.Severity == Severity.Error).Handle);
            Assert.AreEqual(0, drawing.Flush(), "nothing is sent twice");
        }

        [Test, Category(Recorded)]
        public void The_radius_list_names_each_vertex_with_its_radius_and_verdict()
        {
            var drawing = Open(new MemoryDrawing(Plates.WithFillet(0.05)));
            IReadOnlyList<RadiusRow> rows = null;
            _session.ListRadii(drawing, list => rows = list, Assert.Fail);
            _session.Until(() => rows != null, "the list");
            Assert.AreEqual(5, rows.Count);
            var row = rows.Single(one => one.IsAtFault);
            Assert.AreEqual(1, row.Vertex);
            Assert.AreEqual(0.05, row.Radius.Value, 1e-9);
            Assert.AreEqual(19.95, row.X, 1e-9);
            Assert.AreEqual("small-radius", row.Verdict);
        }

        [Test]
        public void The_settings_file_in_the_folder_of_the_drawing_holds()
        {
            var folder = Directory.CreateDirectory(Path.Combine(Path.GetTempPath(), Path.GetRandomFileName())).FullName;
            try
            {
                File.WriteAllText(Path.Combine(folder, "wedm.toml"), "correction = 0.2\n");
                var drawing = Open(new MemoryDrawing(Plates.WithFillet(0.15)), DrawingUri.Of(Path.Combine(folder, "plate 1.dwg")));
                CollectionAssert.AreEqual(new[] { "small-radius" }, Rules(drawing));
            }
            finally
            {
                Directory.Delete(folder, true);
            }
        }

        [Test]
        public void A_drawing_without_a_file_is_known_by_its_title()
        {
            Assert.AreEqual("autocad:Drawing%201.dwg", DrawingUri.Of("Drawing 1.dwg"));
        }

        [Test, Category(Recorded)]
        public void A_program_is_written_when_the_drawing_is_clean_and_refused_with_its_errors_before()
        {
            _session.Settings = JObject.Parse(@"{ ""side"": ""opening"" }");
            var host = new MemoryDrawing(Plates.WithFillet(0.05));
            var drawing = Open(host);
            Func<string> generate = () => Outcome((done, refused) => _session.Generate(drawing, "3b", done, refused));
            var refusal = generate();
            StringAssert.StartsWith("refused: the drawing has an error", refusal);
            StringAssert.Contains("arc R 0.050 mm is below the correction 0.100 mm", refusal);
            host.Edit(Plates.WithFillet(2));
            var program = generate();
            StringAssert.StartsWith("done: B", program);
            StringAssert.EndsWith("DD\n", program);
        }

        [TestCase("iso", "G92", "ISO", ".iso")]
        [TestCase("4b", "B", "4B", ".4b")]
        [TestCase("milling", "G01 Z-0.0", "milling", ".iso")]
        public void Programs_are_made_in_other_formats(string format, string holds, string name, string ending)
        {
            Assert.AreEqual(name, Session.NameOf(format));
            Assert.AreEqual(ending, Session.EndingOf(format));
            _session.Settings = JObject.Parse(@"{ ""side"": ""opening"", ""correction"": 0.1,
                ""milling"": { ""toolDiameter"": 1, ""gap"": 0.05, ""layer"": 0.05, ""depth"": 0.2, ""wear"": 0.0001 } }");
            var drawing = Open(new MemoryDrawing(Plates.WithFillet(2)));
            var program = Outcome((done, refused) => _session.Generate(drawing, format, done, refused));
            StringAssert.StartsWith("done: ", program);
            StringAssert.Contains(holds, program);
        }

        [Test]
        public void What_is_missing_of_an_electrode_is_said()
        {
            var drawing = Open(new MemoryDrawing(Plates.WithFillet(2)));
            StringAssert.Contains("expected milling.tool-diameter", Outcome((done, refused) => _session.Generate(drawing, "milling", done, refused)));
        }

        [Test]
        public void The_path_is_drawn_on_a_layer_of_its_own_that_is_no_part_of_the_drawing()
        {
            _session.Settings = JObject.Parse(@"{ ""side"": ""opening"" }");
            var host = new MemoryDrawing(Plates.WithFillet(2));
            var drawing = Open(host);
            Func<string> draw = () => Outcome((done, refused) => _session.DrawPath(drawing, done, refused));
            StringAssert.StartsWith("done: the wire's path is on the layer WEDM_PATH, cut ", draw());
            Assert.AreEqual(1, host.StepsOfUndo);
            Func<Entity[]> path = () => host.ReadAll().Where(entity => entity.Layer == "WEDM_PATH").ToArray();
            var fillet = path().OfType<ArcEntity>().Single();
            Assert.AreEqual(1.9, fillet.Radius, 1e-9);
            Assert.AreEqual(18, fillet.Center[0], 1e-9);
            Assert.AreEqual(90, Math.IEEERemainder(fillet.EndAngleDeg - fillet.StartAngleDeg, 360), 1e-6);
            Assert.GreaterOrEqual(path().OfType<LineEntity>().Count(), 6);
            // Nothing of it goes to the server, at once or with the whole drawing.
            Assert.AreEqual(1, drawing.Version);
            Assert.AreEqual(1, ((JArray)drawing.Whole()["entities"]).Count);
            var before = path().Length;
            _session.Settings = null;
            StringAssert.StartsWith("done: ", draw());
            Assert.AreEqual(before, path().Length, "it takes the place of the old one");
        }

        [Test]
        public void Without_a_side_there_is_no_path_and_it_is_said_why()
        {
            var host = new MemoryDrawing(Plates.WithFillet(2));
            var drawing = Open(host);
            StringAssert.StartsWith("refused: side of contour", Outcome((done, refused) => _session.DrawPath(drawing, done, refused)));
            Assert.AreEqual(0, host.StepsOfUndo);
        }

        [Test]
        public void A_thread_hole_that_is_marked_is_where_the_wire_is_threaded()
        {
            _session.Settings = JObject.Parse(@"{ ""side"": ""opening"", ""program"": { ""startHole"": 2 } }");
            var host = new MemoryDrawing(Plates.WithFillet(2));
            var drawing = Open(host);
            Assert.IsNull(_session.MarkHole(drawing, 8, 5));
            Toolpath path = null;
            _session.FindPath(drawing, found => path = found, Assert.Fail);
            _session.Until(() => path != null, "the path");
            var hole = path.Holes.Single();
            CollectionAssert.AreEqual(new[] { 8.0, 5.0 }, hole.At);
            Assert.IsTrue(hole.IsGiven);
            Assert.AreEqual("drawing,x_mm,y_mm,diameter_mm,contour,hole\n\"a, b.dwg\",8.0000,5.0000,2,2A,given\n", path.DrillList("a, b.dwg"));
            StringAssert.StartsWith("done: 1 start holes are on the layer START-HOLES", Outcome((done, refused) => _session.DrawHoles(drawing, done, refused)));
            Assert.AreEqual(1.0, host.ReadAll().OfType<CircleEntity>().Single().Radius, 1e-9);
            Assert.AreEqual(1, host.ReadAll().OfType<TextEntity>().Count(), "the mark takes the place of the one before");
            _session.UntilChecked(drawing);
            CollectionAssert.IsEmpty(Rules(drawing), "holes are drilled, not cut");
        }

        [TestCase(@"{ ""side"": ""opening"" }", "not known without these keys of wedm.toml: job.thickness, passes.rates, job.machine-rate, gap")]
        [TestCase(@"{ ""side"": ""opening"", ""gap"": 0.01, ""job"": { ""thickness"": 40, ""machineRate"": 60 }, ""passes"": { ""rates"": [60] } }",
            "minutes on the machine, cost ", "what drops out of contour 2A: ", "largest wire: ")]
        public void What_it_comes_to_on_the_machine_is_said_with_the_keys_that_are_missing(string settings, params string[] holds)
        {
            _session.Settings = JObject.Parse(settings);
            var drawing = Open(new MemoryDrawing(Plates.WithFillet(2)));
            var figures = Outcome((done, refused) => _session.FindPath(drawing, path => done(path.Figures()), refused));
            StringAssert.StartsWith("done: cut ", figures);
            foreach (var words in holds)
            {
                StringAssert.Contains(words, figures);
            }
        }

        [TestCase(@"{ ""wireDiameter"": 0.18, ""gap"": 0.01, ""pair"": { ""drawnAs"": ""punch"", ""clearance"": 0.005 } }", "done: the parts bind: ",
            "0.0050 mm is asked for", "(entity 2A segment 3, the plate)")]
        [TestCase("{}", "refused: ")]
        public void Whether_punch_and_plate_fit_is_said_with_the_places_where_they_bind(string settings, string starts, params string[] holds)
        {
            _session.Settings = JObject.Parse(settings);
            var drawing = Open(new MemoryDrawing(Plates.WithFillet(2)));
            Fit fit = null;
            var said = Outcome((done, refused) => _session.CheckFit(drawing, found => done((fit = found).InWords()), refused));
            StringAssert.StartsWith(starts, said);
            foreach (var words in holds)
            {
                StringAssert.Contains(words, said);
            }
            Assert.AreEqual(holds.Length > 0, fit != null && fit.Svg.StartsWith("<svg"));
        }

        [Test]
        public void What_is_asked_before_the_server_has_greeted_is_answered_when_it_has()
        {
            // As the first command of a day: nothing has been pumped since the start.
            Assert.AreEqual(SessionState.Starting, _session.State);
            var host = new MemoryDrawing(Plates.WithFillet(0.05));
            var drawing = _session.Open("cad:plate", host);
            host.Watcher = drawing;
            StringAssert.StartsWith("done: Fix all", Fix(drawing));
            _session.UntilChecked(drawing);
            CollectionAssert.IsEmpty(Rules(drawing));
        }

        /// <param name="told">Whether the CAD program reports its undo; if not, the plugin must notice it by itself.</param>
        [TestCase(true)]
        [TestCase(false)]
        public void A_fix_is_refused_when_undo_has_gone_by_while_it_was_on_its_way(bool told)
        {
            var host = new MemoryDrawing(Plates.WithFillet(0.05));
            var drawing = Open(host);
            host.Edit(Plates.WithFillet(0.07));
            drawing.Flush();
            _session.UntilChecked(drawing);
            string outcome = null;
            _session.Fix(drawing, null, done => outcome = "done", refused => outcome = refused);
            host.Watcher = told ? drawing : null;
            host.Undo();
            host.Watcher = drawing;
            _session.Until(() => outcome != null, "an answer");
            Assert.AreEqual("the drawing has changed since the fix was made for it", outcome);
            Assert.IsTrue(host.Read("2A").IsSameAs(Plates.WithFillet(0.05)), "nothing was changed");
            Assert.AreEqual(0, host.StepsOfUndo, "nothing was written");
            Assert.AreEqual(1, drawing.Flush(), "what undo has changed is sent now");
            _session.UntilChecked(drawing);
            Assert.AreEqual(0.05, drawing.Findings.First(finding => finding.Rule == "small-radius").Radius.Value, 1e-9);
        }

        [Test]
        public void A_fix_is_refused_when_something_else_has_changed_meanwhile_for_it_may_have_been_made_for_that()
        {
            var host = new MemoryDrawing(Plates.WithFillet(0.05), Plates.WithFillet(2, "2B"));
            var drawing = Open(host);
            string outcome = null;
            _session.Fix(drawing, null, done => outcome = "done", refused => outcome = refused);
            host.Edit(Plates.WithFillet(3, "2B"));
            Assert.AreEqual(1, drawing.Flush());
            _session.Until(() => outcome != null, "an answer");
            Assert.AreEqual("the drawing has changed since the fix was made for it", outcome);
            Assert.IsTrue(host.Read("2A").IsSameAs(Plates.WithFillet(0.05)), "nothing was changed");
        }

        [Test]
        public void A_server_that_is_killed_in_the_middle_of_an_edit_comes_back_with_the_drawing_as_it_is()
        {
            var host = new MemoryDrawing(Plates.WithFillet(2));
            var drawing = Open(host);
            var other = Open(new MemoryDrawing(Plates.WithFillet(0.06)), "cad:other");
            var first = _session.ServerId.Value;
            host.Edit(Plates.WithFillet(0.05));
            Process.GetProcessById(first).Kill();
            drawing.Flush();
            string outcome = null;
            _session.Generate(drawing, "3b", done => outcome = "done", refused => outcome = refused);
            _session.Until(() => outcome != null, "the request that nobody can answer any more");
            StringAssert.DoesNotStartWith("done", outcome);
            _session.Until(() => _session.State == SessionState.Running && _session.ServerId != first, "a new server");
            _session.UntilChecked(drawing);
            CollectionAssert.AreEqual(new[] { "small-radius" }, Rules(drawing));
            // The other drawing is with the new server too: it was opened there, and there are answers for it.
            _session.UntilChecked(other);
            IReadOnlyList<RadiusRow> rows = null;
            _session.ListRadii(other, list => rows = list, Assert.Fail);
            _session.Until(() => rows != null, "the list of the other drawing");
            Assert.AreEqual(0.06, rows.Single(row => row.IsAtFault).Radius.Value, 1e-9);
            StringAssert.Contains("started again", _messages.Single());
        }

        [Test]
        public void The_server_gets_the_whole_drawing_when_a_change_does_not_apply()
        {
            var host = new MemoryDrawing(Plates.WithFillet(2));
            var drawing = Open(host);
            // The server takes no change of an entity that it does not know.
            _session.Notify("wedm/didChangeDrawing", JObject.Parse(
                @"{ ""drawing"": { ""uri"": ""cad:plate"", ""version"": 2 }, ""changes"": [{ ""handle"": ""77"", ""entity"": null }] }"));
            var version = drawing.Version;
            _session.Until(() => drawing.Version > version, "a request for the drawing");
            _session.UntilChecked(drawing);
            CollectionAssert.IsEmpty(Rules(drawing));
        }

        [Test]
        public void Of_twenty_thousand_vertices_the_one_that_moved_is_sent_and_judged()
        {
            const int count = 20000;
            var vertices = Enumerable.Range(0, count).Select(index =>
                new Vertex(100 * Math.Cos(2 * Math.PI * index / count), 100 * Math.Sin(2 * Math.PI * index / count), 0)).ToArray();
            var moved = (Vertex[])vertices.Clone();
            moved[count / 2] = new Vertex(moved[count / 2].X, moved[count / 2].Y, -0.9);
            var before = new PolylineEntity("1", "0", true, vertices);
            var after = new PolylineEntity("1", "0", true, moved);
            Assert.AreEqual(1, ((JArray)Changes.Between("1", before, after)["vertices"]["insert"]).Count);
            var host = new MemoryDrawing(before);
            var drawing = Open(host);
            CollectionAssert.DoesNotContain(Rules(drawing), "small-radius");
            host.Edit(after);
            Assert.AreEqual(1, drawing.Flush());
            _session.UntilChecked(drawing);
            Assert.AreEqual(count / 2, drawing.Findings.Single(finding => finding.Rule == "small-radius").Segment);
        }
    }
}
