using System;
using System.Linq;
using NUnit.Framework;
using Wedm.Core;

namespace Wedm.Tests
{
    [TestFixture]
    public class RestartPauseTests
    {
        [TestCase(new[] { 0.0, 0, 0, 0, 0, 0, 0, 0 }, new[] { 0.5, 1, 2, 4, 8, 16, 30, 30 })]
        [TestCase(new[] { 1.0, 1, 119, 121, 1 }, new[] { 0.5, 1, 2, 0.5, 1 })]
        public void Pauses_grow_until_a_server_has_lived_for_long(double[] lives, double[] expected)
        {
            var pause = new RestartPause();
            CollectionAssert.AreEqual(expected, lives.Select(life => pause.AfterLifeOf(TimeSpan.FromSeconds(life)).TotalSeconds).ToArray());
        }
    }
}
