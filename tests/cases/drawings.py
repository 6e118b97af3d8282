"""Outlines of a DXF, how far a cut comes nearer to them than the correction, what holds a part, and large inputs that are made here."""

import collections
import math

from programs import along, length_of


def outlines(text):
    """Closed LWPOLYLINEs and CIRCLEs of a small DXF as lists of (x, y, bulge)."""
    lines = [l.strip() for l in text.splitlines()]
    tags = list(zip(lines[::2], lines[1::2]))
    out, now, kind, circle = [], None, None, {}
    for code, value in tags + [("0", "EOF")]:
        if code == "0":
            if kind == "LWPOLYLINE" and now:
                out.append([tuple(v) for v in now])
            if kind == "CIRCLE" and "40" in circle:
                x, y, r = (float(circle[c]) for c in ("10", "20", "40"))
                out.append([(x + r, y, 1.0), (x - r, y, 1.0)])
            now, kind, circle = [], value, {}
        elif kind == "LWPOLYLINE":
            if code == "10":
                now.append([float(value), 0.0, 0.0])
            elif code == "20" and now:
                now[-1][1] = float(value)
            elif code == "42" and now:
                now[-1][2] = float(value)
        elif kind == "CIRCLE":
            circle[code] = value
    return out


def chords(outline):
    out = []
    for (x, y, b), (u, v, _) in zip(outline, outline[1:] + outline[:1]):
        out.append((x, y))
        if abs(b) > 1e-12:
            sweep, chord = 4 * math.atan(b), math.dist((x, y), (u, v))
            r = chord / 2 / math.sin(abs(sweep) / 2)
            h = r * math.cos(sweep / 2) * (1 if b > 0 else -1)
            cx, cy = (x + u) / 2 - h * (v - y) / chord, (y + v) / 2 + h * (u - x) / chord
            a, n = math.atan2(y - cy, x - cx), max(4, int(abs(sweep) / 0.01))
            out += [(cx + r * math.cos(a + sweep * i / n), cy + r * math.sin(a + sweep * i / n)) for i in range(1, n)]
    return out


def inside(p, ring):
    hit, (x, y) = False, p
    for (a, b), (c, d) in zip(ring, ring[1:] + ring[:1]):
        if (b > y) != (d > y) and x < (c - a) * (y - b) / (d - b) + a:
            hit = not hit
    return hit


def away(p, ring):
    best = math.inf
    for (a, b), (c, d) in zip(ring, ring[1:] + ring[:1]):
        l = (c - a) ** 2 + (d - b) ** 2
        t = 0.0 if l == 0 else min(1.0, max(0.0, ((p[0] - a) * (c - a) + (p[1] - b) * (d - b)) / l))
        best = min(best, math.dist(p, (a + t * (c - a), b + t * (d - b))))
    return best


def gouge_of(cuts, rings, material, correction):
    """How far the wire comes nearer to the material than the correction, mm; and where."""
    worst, place = -math.inf, None
    for cut in cuts:
        for p in along(cut, min(20000, int(length_of(cut) / 0.01) + 1)):
            for ring in rings:
                d = away(p, ring)
                if d > 3 * correction + 1 and not inside(p, ring):
                    continue
                if inside(p, ring) == (material == "inside"):
                    d = -d
                if correction - d > worst:
                    worst, place = correction - d, p
    return worst, place


def neck_of(cut, correction):
    """The narrowest place between the first and the last quarter of a cut, less the kerf, mm: what holds the part at a stop."""
    n = min(6000, int(length_of(cut) / 0.03) + 4)
    points = along(cut, n)
    first, last = points[:n // 4], points[-(n // 4):]
    cell, table = 0.5, collections.defaultdict(list)
    for p in first:
        table[int(p[0] // cell), int(p[1] // cell)].append(p)
    best = math.inf
    for q in last:
        i, j = int(q[0] // cell), int(q[1] // cell)
        for di in range(-6, 7):
            for dj in range(-6, 7):
                for p in table.get((i + di, j + dj), ()):
                    best = min(best, math.dist(p, q))
    return best - 2 * correction


# ---------------------------------------------------------------- large inputs

def made(kind, n):
    out = ["0", "SECTION", "2", "ENTITIES"]
    if kind == "circles":                               # one in another, at 0.5 mm
        for i in range(n):
            out += ["0", "CIRCLE", "8", "0", "10", "0", "20", "0", "40", f"{1 + i / 2:.1f}"]
    elif kind == "star":                                # lines from one point
        for i in range(n):
            out += ["0", "LINE", "8", "0", "10", "0", "20", "0", "11", f"{math.cos(i):.6f}", "21", f"{math.sin(i):.6f}"]
    elif kind == "grid":                                # short lines end to end, each 4 µm from the next
        per_row = 300
        for i in range(n):
            x, y = (i % per_row) * 0.009, (i // per_row) * 0.009
            out += ["0", "LINE", "8", "0", "10", f"{x:.3f}", "20", f"{y:.3f}", "11", f"{x + 0.005:.3f}", "21", f"{y:.3f}"]
    else:
        raise ValueError(kind)
    return "\n".join(out + ["0", "ENDSEC", "0", "EOF"]) + "\n"
