using System;
using System.Collections.Generic;
using System.Linq;
using Newtonsoft.Json.Linq;
using NUnit.Framework;
using Wedm.Core;

namespace Wedm.Tests
{
    /// <summary>How entities are shown decides whether they are cut; what cannot be sent is named; and what is asked in one go is done in turn.</summary>
    [TestFixture]
    public class LookTests
    {
        private Session _session;

        [SetUp]
        public void Start()
        {
            _session = new Session(Plates.Server) { Settings = JObject.Parse(@"{ ""side"": ""auto"" }") };
            _session.Start();
        }

        [TearDown]
        public void Stop()
        {
            _session.Dispose();
        }

        private static Look LookOf(string linetype = null, bool byLayer = false, object visible = null, params string[] xdata)
        {
            return Look.Of(linetype, byLayer, new JValue(1), new JValue(visible ?? true), xdata);
        }

        private static CircleEntity Circle(string handle, double radius, Look look = null)
        {
            return new CircleEntity(handle, "PLATE", new[] { 20.0, 0 }, radius) { Look = look ?? Look.Plain };
        }

        private LiveDrawing Open(MemoryDrawing host)
        {
            var drawing = _session.Open("cad:" + Guid.NewGuid(), host);
            host.Watcher = drawing;
            _session.UntilChecked(drawing);
            return drawing;
        }

        private string Program(LiveDrawing drawing)
        {
            string program = null;
            _session.Generate(drawing, "3b", done => program = done, refused => program = "refused: " + refused);
            Assert.IsTrue(_session.Finish(TimeSpan.FromMinutes(5)));
            return program;
        }

        public static readonly Look[] NotCut =
        {
            LookOf("HIDDEN"), LookOf("Center2", true), LookOf(null, false, false), LookOf("Continuous", true, "frozen"), LookOf(null, false, "off"),
        };

        [TestCaseSource("NotCut")]
        public void What_is_drawn_to_be_read_or_not_shown_is_not_cut(Look look)
        {
            var plate = new CircleEntity("1", "0", new[] { 0.0, 0 }, 40);
            var without = Program(Open(new MemoryDrawing(plate, Circle("2", 3))));
            StringAssert.StartsWith("B", without);
            var host = new MemoryDrawing(plate, Circle("2", 3), Circle("3", 5, look));
            var drawing = Open(host);
            Assert.AreEqual(without, Program(drawing));
            // Shown otherwise, it is cut, and that is sent as the whole entity.
            host.Edit(Circle("3", 5));
            Assert.AreEqual(1, drawing.Flush());
            Assert.AreNotEqual(without, Program(drawing));
            host.Undo();
            Assert.AreEqual(1, drawing.Flush());
            Assert.AreEqual(without, Program(drawing));
        }

        [Test]
        public void A_layer_that_is_frozen_changes_what_lies_on_it()
        {
            var host = new MemoryDrawing(new CircleEntity("1", "0", new[] { 0.0, 0 }, 40), Circle("2", 3));
            var drawing = Open(host);
            host.Watcher = null;
            host.Edit(Circle("2", 3, LookOf(null, false, "frozen")));
            Assert.AreEqual(0, drawing.Flush());
            drawing.TouchAll();
            Assert.AreEqual(1, drawing.Flush());
        }

        [Test]
        public void A_look_goes_there_and_back()
        {
            foreach (var look in NotCut.Concat(new[] { LookOf(null, false, true, "suppress gap: as drawn"), Look.Plain }))
            {
                Entity there = Circle("2", 3, look);
                Assert.IsTrue(Entity.FromJson(there.ToJson()).IsSameAs(there), there.ToJson().ToString());
                Assert.IsTrue(Look.FromJson(there.ToJson()).IsSameAs(look));
            }
            Assert.IsFalse(Circle("2", 3).IsSameAs(Circle("2", 3, LookOf("HIDDEN"))));
            Assert.AreEqual(@"{""handle"":""2"",""layer"":""PLATE"",""type"":""circle"",""center"":[20.0,0.0],""radius"":3.0}",
                Circle("2", 3, Look.Of("CONTINUOUS", true, null, new JValue(true), new string[0])).ToJson().ToString(Newtonsoft.Json.Formatting.None));
        }

        [Test]
        public void A_repair_keeps_the_look_and_the_vertices_are_sent_alone()
        {
            _session.Settings = JObject.Parse(@"{ ""side"": ""opening"" }");
            var tight = Plates.WithFillet(0.05);
            tight.Look = LookOf("WAVES", true);
            var host = new MemoryDrawing(tight);
            var drawing = Open(host);
            string outcome = null;
            _session.Fix(drawing, null, done => outcome = done, refused => outcome = "refused: " + refused);
            Assert.IsTrue(_session.Finish(TimeSpan.FromMinutes(5)));
            StringAssert.StartsWith("Fix all", outcome);
            Assert.IsTrue(host.Read("2A").Look.IsSameAs(tight.Look));
            Assert.IsNotNull(Changes.Between("2A", tight, host.Read("2A"))["vertices"]);
        }

        [Test]
        public void What_cannot_be_sent_is_named_with_its_number()
        {
            var host = new MemoryDrawing(Plates.WithFillet(2), new OtherEntity("3", "0", "SPLINE"), new OtherEntity("4", "0", "SPLINE"), new OtherEntity("5", "0", "HATCH"));
            var drawing = Open(host);
            Assert.AreEqual("1 HATCH, 2 SPLINE", drawing.LeftOut);
            Assert.AreEqual(1, ((JArray)drawing.Whole()["entities"]).Count);
            host.Write(new[] { new KeyValuePair<string, Entity>("3", null), new KeyValuePair<string, Entity>("5", null) });
            Assert.AreEqual(0, drawing.Flush());
            Assert.AreEqual("1 SPLINE", drawing.LeftOut);
            host.Write(new[] { new KeyValuePair<string, Entity>("4", null) });
            drawing.Flush();
            Assert.IsNull(drawing.LeftOut);
        }

        /// <summary>As a script does: RMINFIX, and WEDM3B at once.</summary>
        [Test]
        public void A_program_that_is_asked_for_while_a_repair_is_on_its_way_is_that_of_the_repaired_drawing()
        {
            _session.Settings = JObject.Parse(@"{ ""side"": ""opening"" }");
            var host = new MemoryDrawing(Plates.WithFillet(0.05));
            var drawing = Open(host);
            var said = new List<string>();
            _session.Fix(drawing, null, done => said.Add("fixed"), said.Add);
            _session.Generate(drawing, "3b", program => said.Add(program), said.Add);
            Assert.IsEmpty(said);
            Assert.IsTrue(_session.Finish(TimeSpan.FromMinutes(5)));
            Assert.AreEqual(2, said.Count, string.Join(" / ", said));
            Assert.AreEqual("fixed", said[0]);
            StringAssert.StartsWith("B", said[1]);
            Assert.AreEqual(1, host.StepsOfUndo);
        }
    }
}
