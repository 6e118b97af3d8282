using System;
using System.IO;
using Wedm.Core;

namespace Wedm.Tests
{
    internal static class Plates
    {
        /// <summary>tan(90° / 4): a quarter turn, counter-clockwise.</summary>
        public const double QuarterTurn = 0.41421356237309503;

        /// <summary>A rectangle 20 × 10 with one corner rounded; below the correction of 0.1 for radii under it.</summary>
        public static PolylineEntity WithFillet(double radius, string handle = "2A")
        {
            return new PolylineEntity(handle, "DIE", true, new[]
            {
                new Vertex(0, 0, 0),
                new Vertex(20 - radius, 0, QuarterTurn),
                new Vertex(20, radius, 0),
                new Vertex(20, 10, 0),
                new Vertex(0, 10, 0),
            });
        }

        public static string Server()
        {
            var path = Environment.GetEnvironmentVariable("WEDM");
            return !string.IsNullOrEmpty(path) && File.Exists(path) ? path : throw new FileNotFoundException("WEDM must name the server's program", path);
        }
    }
}
