using System.Linq;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;
using NUnit.Framework;
using Wedm.Core;

namespace Wedm.Tests
{
    [TestFixture]
    public class ChangesTests
    {
        private static PolylineEntity Polyline(params double[] xs) => new PolylineEntity("2A", "0", false, xs.Select(x => new Vertex(x, 0, 0)).ToArray());

        public static readonly double[][][] Splices =
        {
            new[] { new[] { 1.0, 2, 3 }, new[] { 1.0, 2, 3 } },
            new[] { new[] { 1.0, 2, 3 }, new[] { 1.0, 5, 3 } },
            new[] { new[] { 1.0, 2, 3 }, new[] { 1.0, 2, 3, 4 } },
            new[] { new[] { 1.0, 2, 3 }, new[] { 0.0, 1, 2, 3 } },
            new[] { new[] { 1.0, 2, 3 }, new[] { 1.0, 3 } },
            new[] { new[] { 1.0, 1, 1 }, new[] { 1.0, 1 } },
            new[] { new[] { 1.0, 1 }, new[] { 1.0, 1, 1 } },
            new[] { new[] { 1.0, 2, 3, 4, 5 }, new[] { 1.0, 9, 3, 8, 5 } },
            new[] { new[] { 1.0, 2 }, new[] { 3.0, 4 } },
        };

        [TestCaseSource("Splices")]
        public void A_change_leads_from_what_was_to_what_is(double[][] splice)
        {
            Entity before = Polyline(splice[0]), after = Polyline(splice[1]);
            var change = Changes.Between("2A", before, after);
            if (splice[0].SequenceEqual(splice[1]))
            {
                Assert.IsNull(change);
                return;
            }
            var result = Changes.Apply(new JArray(change), handle => before).Single();
            Assert.AreEqual("2A", result.Key);
            Assert.IsTrue(result.Value.IsSameAs(after), result.Value.ToJson().ToString());
        }

        [TestCase(@"{""handle"":""2A"",""type"":""line"",""layer"":""0"",""start"":[0.1,0],""end"":[1e-7,123456.789012345]}")]
        [TestCase(@"{""handle"":""2A"",""type"":""arc"",""layer"":""0"",""center"":[1,2],""radius"":0.30000000000000004,""startAngle"":350.5,""endAngle"":10.25}")]
        [TestCase(@"{""handle"":""2A"",""type"":""circle"",""layer"":""A"",""center"":[-1.5,2],""radius"":3}")]
        [TestCase(@"{""handle"":""2A"",""type"":""text"",""layer"":""A"",""at"":[0,0],""text"":""O""}")]
        [TestCase(@"{""handle"":""2A"",""type"":""polyline"",""layer"":""A"",""closed"":true,""vertices"":[[0,0,0.41421356237309503],[1,1,0]]}")]
        public void An_entity_comes_back_from_its_json_bit_by_bit(string json)
        {
            var entity = Entity.FromJson(JObject.Parse(json));
            var text = entity.ToJson().ToString(Formatting.None);
            Assert.IsTrue(entity.IsSameAs(Entity.FromJson(JObject.Parse(text))));
            Assert.IsNull(Changes.Between("2A", entity, Entity.FromJson(JObject.Parse(text))));
        }

        [TestCase("[{'handle':'2A','vertices':{'start':2,'deleteCount':2,'insert':[]}}]", "2A has 3 vertices, the change takes 2 from 2")]
        [TestCase("[{'handle':'2A','vertices':{'start':-1,'deleteCount':0,'insert':[]}}]", "2A has 3 vertices, the change takes 0 from -1")]
        [TestCase("[{'handle':'2A','vertices':{'start':1,'deleteCount':2147483647,'insert':[]}}]", "2A has 3 vertices, the change takes 2147483647 from 1")]
        [TestCase("[{'handle':'2A','entity':null},{'handle':'2A','vertices':{'start':0,'deleteCount':0,'insert':[]}}]", "2A is no polyline, its vertices cannot be changed")]
        public void A_change_that_does_not_fit_is_refused(string changes, string reason)
        {
            var fault = Assert.Throws<System.FormatException>(() => Changes.Apply(JArray.Parse(changes), handle => Polyline(1, 2, 3)));
            Assert.AreEqual(reason, fault.Message);
        }

        [Test]
        public void Several_changes_of_one_entity_apply_one_after_another()
        {
            var changes = JArray.Parse("[{'handle':'2A','vertices':{'start':0,'deleteCount':1,'insert':[]}},{'handle':'2A','vertices':{'start':1,'deleteCount':1,'insert':[[7,0,0]]}}]");
            var result = (PolylineEntity)Changes.Apply(changes, handle => Polyline(1, 2, 3)).Single().Value;
            CollectionAssert.AreEqual(new[] { 2.0, 7 }, result.Vertices.Select(vertex => vertex.X));
        }
    }
}
