using System;
using System.Diagnostics;
using System.Threading;
using NUnit.Framework;
using Wedm.Core;

namespace Wedm.Tests
{
    internal static class Waiting
    {
        /// <summary>Longer than anything takes here, also on a busy machine with a server that is not optimised.</summary>
        private static readonly TimeSpan Patience = TimeSpan.FromMinutes(5);

        /// <summary>Pumps the session, as the CAD program's timer does, until something is so.</summary>
        public static void Until(this Session session, Func<bool> isSo, string what)
        {
            for (var clock = Stopwatch.StartNew(); !isSo(); Thread.Sleep(5))
            {
                session.Pump();
                Assert.Less(clock.Elapsed, Patience, "waited for: " + what);
            }
        }

        public static void UntilChecked(this Session session, LiveDrawing drawing)
        {
            session.Until(() => drawing.Version > 0 && drawing.FindingsVersion == drawing.Version, "findings of the newest version");
        }
    }
}
