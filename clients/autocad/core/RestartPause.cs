using System;

namespace Wedm.Core
{
    /// <summary>How long a server that has died is left alone: twice as long each time, but not for ever.</summary>
    internal sealed class RestartPause
    {
        private static readonly TimeSpan First = TimeSpan.FromSeconds(0.5);
        private static readonly TimeSpan Longest = TimeSpan.FromSeconds(30);

        /// <summary>A server that has lived so long is not blamed for what came before.</summary>
        private static readonly TimeSpan LongLife = TimeSpan.FromMinutes(2);

        private TimeSpan _next = First;

        /// <summary>The pause before the next start, after a server that has lived for <paramref name="life"/>.</summary>
        public TimeSpan AfterLifeOf(TimeSpan life)
        {
            var pause = life > LongLife ? First : _next;
            _next = TimeSpan.FromTicks(Math.Min(pause.Ticks * 2, Longest.Ticks));
            return pause;
        }
    }
}
