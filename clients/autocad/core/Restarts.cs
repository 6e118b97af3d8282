using System;

namespace Wedm.Core
{
    /// <summary>
    /// How often a server that ends is started again, and after what pause: "When the server ends" in docs/protocol.md.
    /// </summary>
    internal sealed class Restarts
    {
        /// <summary>Ends in a row after which it is not started again.</summary>
        public static int MostEnds => Pauses.Length + 1;

        private static readonly double[] Pauses = { 0, 0.5, 1, 2, 4 };

        /// <summary>After a server that has lived this long, the count of ends in a row begins again.</summary>
        private static readonly TimeSpan SoundLife = TimeSpan.FromSeconds(60);

        private int _ends;

        /// <summary>
        /// The pause before the next start, after a server that has ended <paramref name="life"/> after its answer to initialize (zero
        /// where none came); null when it has ended too often.
        /// </summary>
        public TimeSpan? AfterLifeOf(TimeSpan life)
        {
            if (life >= SoundLife)
            {
                _ends = 0;
            }
            return _ends == Pauses.Length ? (TimeSpan?)null : TimeSpan.FromSeconds(Pauses[_ends++]);
        }

        /// <summary>The user wants another start: earlier ends no longer count.</summary>
        public void Reset()
        {
            _ends = 0;
        }
    }
}
