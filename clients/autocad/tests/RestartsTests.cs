using System;
using System.IO;
using System.Linq;
using Newtonsoft.Json.Linq;
using NUnit.Framework;
using Wedm.Core;

namespace Wedm.Tests
{
    [TestFixture]
    public class RestartsTests
    {
        [Test]
        public void Pauses_are_those_of_every_client()
        {
            var cases = JObject.Parse(File.ReadAllText(Environment.GetEnvironmentVariable("WEDM_RESTARTS")))["cases"].ToArray();
            CollectionAssert.IsNotEmpty(cases);
            foreach (var each in cases)
            {
                var restarts = new Restarts();
                var pauses = each["lives"].Select(life => restarts.AfterLifeOf(TimeSpan.FromSeconds((double)life))?.TotalSeconds);
                CollectionAssert.AreEqual(each["pauses"].Select(pause => (double?)pause), pauses.ToArray());
            }
        }

        [Test]
        public void A_start_that_the_user_wants_begins_anew()
        {
            var restarts = new Restarts();
            var pauses = Enumerable.Range(0, Restarts.MostEnds).Select(_ => restarts.AfterLifeOf(TimeSpan.Zero)).ToArray();
            Assert.IsNull(pauses.Last());
            restarts.Reset();
            Assert.AreEqual(TimeSpan.Zero, restarts.AfterLifeOf(TimeSpan.Zero));
        }
    }
}
