"""Reads 3B and ISO programs as the machine runs them, without a line of wedm's: moves, cuts, lengths, whether two lead along the same path."""

import math
import re

from results import Short

PATHS = 0.003                                           # mm: two programs lead along the same path


def decode_3b(text):
    """Moves of a 3B program, mm from its start: [(kind, points, line)]; kind 'cut' or 'stop'."""
    moves, x, y = [], 0.0, 0.0
    block = re.compile(r"B\s*(\d*)\s*B\s*(\d*)\s*B\s*(\d*)\s*G\s*([XY])\s*(L[1-4]|[SN]R[1-4])", re.I)
    for number, line in enumerate(text.splitlines(), 1):
        line = line.split(";")[0]
        found = list(block.finditer(line))
        if not found:
            word = line.strip().upper()
            if re.fullmatch(r"(N\d+\s*)?(DD|E|FF|MJ)", word):
                moves.append(("end", [], number))
                break
            if re.fullmatch(r"(N\d+\s*)?(D|A)", word):
                moves.append(("stop", [], number))
            continue
        for m in found:
            a, b, j = (int(v or 0) for v in m.group(1, 2, 3))
            axis, z = m.group(4).upper(), m.group(5).upper()
            if z[0] == "L":
                q = int(z[1])
                if not a and not b:
                    a, b = (1, 0) if axis == "X" else (0, 1)
                sx, sy = {1: (1, 1), 2: (-1, 1), 3: (-1, -1), 4: (1, -1)}[q]
                if b == 0:
                    dx, dy = {1: (1, 0), 3: (-1, 0)}.get(q, (sx, 0))
                    a = 1
                elif a == 0:
                    dx, dy = {2: (0, 1), 4: (0, -1)}.get(q, (0, sy))
                    b = 1
                else:
                    dx, dy = sx * a, sy * b
                along = abs(dx) if axis == "X" else abs(dy)
                k = j / along if along else 0.0
                points = [(x, y), (x + dx * k, y + dy * k)]
            else:
                points = arc_3b(x, y, a, b, j, axis, z)
            moves.append(("cut", [(p / 1000, q / 1000) for p, q in points], number))
            x, y = points[-1]
    return moves


def arc_3b(x, y, a, b, j, axis, z):
    turn, q = (1 if z[0] == "N" else -1), int(z[2])
    sx, sy = {1: (1, 1), 2: (-1, 1), 3: (-1, -1), 4: (1, -1)}[q]
    r = math.hypot(a, b)
    if r == 0:
        return [(x, y)]
    cx, cy = x - sx * a, y - sy * b
    angle = math.atan2(sy * b, sx * a)
    value = (lambda t: r * math.cos(t)) if axis == "X" else (lambda t: r * math.sin(t))
    left, total, here = float(j), 0.0, angle
    while left > 1e-9 and total < 4 * math.pi:
        step = math.pi / 2
        k = here / step
        edge = (math.floor(k + 1e-9) + 1) * step if turn > 0 else (math.ceil(k - 1e-9) - 1) * step
        way = abs(value(edge) - value(here))
        if way >= left - 1e-9:
            low, high = 0.0, abs(edge - here)
            for _ in range(60):
                middle = (low + high) / 2
                if abs(value(here + turn * middle) - value(here)) < left:
                    low = middle
                else:
                    high = middle
            total += high
            break
        left -= way
        total += abs(edge - here)
        here = edge
    n = max(2, int(total * r / 20) + 2, int(total / 0.05) + 2)
    n = min(n, 4000)
    return [(cx + r * math.cos(angle + turn * total * i / n), cy + r * math.sin(angle + turn * total * i / n)) for i in range(n + 1)]


def decode_iso(text):
    """Moves of an ISO program, mm: [(kind, points, line)]; kind 'cut', 'way' or 'stop'. I and J lead from the start to the centre."""
    moves, x, y, motion, absolute, unit = [], 0.0, 0.0, 1, True, 1.0
    code = re.sub(r"\([^)]*\)", "", text)
    whole = not re.search(r"[XYIJ]\s*[-+]?\d*\.\d*", code)
    for number, line in enumerate(code.splitlines(), 1):
        words = re.findall(r"([A-Z])\s*([-+]?\d*\.?\d+|[-+]?\d+\.?)", line.split(";")[0].upper())
        at, stop, end, set_zero = {}, False, False, False
        for letter, value in words:
            v = float(value)
            if letter == "G":
                if v in (0, 1, 2, 3):
                    motion = int(v)
                elif v == 90:
                    absolute = True
                elif v == 91:
                    absolute = False
                elif v in (20, 70):
                    unit = 25.4
                elif v in (21, 71):
                    unit = 1.0
                elif v == 92:
                    set_zero = True
            elif letter == "M":
                stop |= v in (0, 1)
                end |= v in (2, 30)
            elif letter in "XYIJR":
                at[letter] = v * (unit if not whole else (0.001 if unit == 1 else 0.00254))
        if set_zero:
            x, y = at.get("X", 0.0), at.get("Y", 0.0)
        elif at:
            tx = at.get("X", x if absolute else 0.0) + (0 if absolute else x)
            ty = at.get("Y", y if absolute else 0.0) + (0 if absolute else y)
            points = [(x, y), (tx, ty)]
            if motion > 1 and ("I" in at or "J" in at or "R" in at):
                points = arc_iso(x, y, tx, ty, at, motion, "X" in at or "Y" in at)
            moves.append(("way" if motion == 0 else "cut", points, number))
            x, y = points[-1]
        if stop:
            moves.append(("stop", [], number))
        if end:
            moves.append(("end", [], number))
            break
    return moves


def arc_iso(x, y, tx, ty, at, motion, moved):
    turn = 1 if motion == 3 else -1
    if "R" in at:
        r, chord = at["R"], math.dist((x, y), (tx, ty))
        h = math.sqrt(max(r * r - chord * chord / 4, 0.0)) * (1 if r > 0 else -1) * turn
        cx, cy = (x + tx) / 2 - h * (ty - y) / chord, (y + ty) / 2 + h * (tx - x) / chord
    else:
        cx, cy = x + at.get("I", 0.0), y + at.get("J", 0.0)
    r, a = math.dist((x, y), (cx, cy)), math.atan2(y - cy, x - cx)
    sweep = 2 * math.pi
    if moved and math.dist((x, y), (tx, ty)) > 1e-6:
        sweep = (turn * (math.atan2(ty - cy, tx - cx) - a)) % (2 * math.pi)
    n = min(4000, max(2, int(sweep * r / 0.02) + 2, int(sweep / 0.05) + 2))
    out = [(cx + r * math.cos(a + turn * sweep * i / n), cy + r * math.sin(a + turn * sweep * i / n)) for i in range(n + 1)]
    if moved:
        out[-1] = (tx, ty)
    return out


def language_of(text):
    if re.search(r"B\s*\d*\s*B\s*\d*\s*B\s*\d*\s*(R\s*\d*\s*)?G\s*[XY]", text, re.I):
        return "3b"
    if re.search(r"\bG\s*0?[0-3]\b.*[XY]", text):
        return "iso"
    return None


def decode(text):
    kind = language_of(text)
    if kind is None:
        raise Short("there is no program: " + (text.strip().splitlines() or ["nothing was written"])[0][:80])
    return (decode_3b if kind == "3b" else decode_iso)(text)


def cuts_of(text):
    """The cuts between stops as lists of points; ways between contours (open, between two stops) are left out."""
    groups, now = [], []
    for kind, points, _ in decode(text):
        if kind == "cut":
            now += points if not now else points[1:]
        elif now:
            groups.append(now)
            now = []
    if now:
        groups.append(now)
    return groups


def closed(points):
    return len(points) > 2 and math.dist(points[0], points[-1]) < 0.02


def length_of(points):
    return sum(math.dist(a, b) for a, b in zip(points, points[1:]))


def box_of(points):
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    return max(xs) - min(xs), max(ys) - min(ys)


def along(points, n):
    """n + 1 points at equal distances along a path."""
    total, out, done, i = length_of(points), [points[0]], 0.0, 1
    for k in range(1, n + 1):
        want = total * k / n
        while i < len(points) and done + math.dist(points[i - 1], points[i]) < want - 1e-12:
            done += math.dist(points[i - 1], points[i])
            i += 1
        if i >= len(points):
            out.append(points[-1])
            continue
        d = math.dist(points[i - 1], points[i])
        f = (want - done) / d if d else 0.0
        a, b = points[i - 1], points[i]
        out.append((a[0] + (b[0] - a[0]) * f, a[1] + (b[1] - a[1]) * f))
    return out


def same_path(a, b, tolerance=PATHS):
    """Why two programs do not lead along the same path; None where they do. Each is counted from its own start."""
    def groups(text):
        kinds = [[]]
        for kind, points, _ in decode(text):
            if kind == "cut" or kind == "way":
                kinds[-1] += points if not kinds[-1] else points[1:]
            else:
                kinds.append([])
        found = [k for k in kinds if k]
        return [[(p[0] - found[0][0][0], p[1] - found[0][0][1]) for p in k] for k in found]
    one, two = groups(a), groups(b)
    if len(one) != len(two):
        return f"{len(one)} cuts and ways, not {len(two)}"
    for number, (p, q) in enumerate(zip(one, two), 1):
        if abs(length_of(p) - length_of(q)) > max(0.01, tolerance * 4):
            return f"cut {number} is {length_of(p):.3f} mm long, not {length_of(q):.3f}"
        far = max(math.dist(s, t) for s, t in zip(along(p, 500), along(q, 500)))
        if far > tolerance * 4 + 1e-9:
            return f"cut {number} is {far:.4f} mm beside the other"
    return None
