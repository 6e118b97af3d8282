"""What a case can expect of what its steps printed and wrote."""

import collections
import difflib
import json
import math
import re

from drawings import chords, gouge_of, neck_of, outlines
from programs import PATHS, along, box_of, closed, cuts_of, decode, decode_iso, language_of, length_of, same_path
from results import Result, Short

SEVERITIES = ["hint", "information", "warning", "error"]
BLOCKS = 0.002                                          # mm: two programs have the same blocks, added up from their start


def verdict(expect, results, folder):
    """Raises Short where what is expected does not hold."""
    if "all" in expect:
        for e in expect["all"]:
            verdict(e, results, folder)
        return
    if "any" in expect:
        reasons = []
        for e in expect["any"]:
            try:
                return verdict(e, results, folder)
            except Short as reason:
                reasons.append(str(reason))
        raise Short("; and ".join(dict.fromkeys(reasons)))
    result = results[expect.get("of", -1)]
    names = [k for k in expect if k not in ("of", "file")]
    if len(names) != 1:
        raise ValueError(f"one check, not {names}")
    CHECKS[names[0]](expect[names[0]], result, results, folder, expect.get("file"))


def text_of(result, folder, file):
    if not file:
        return result.out
    path = folder / file
    return path.read_text(errors="replace") if path.exists() else ""


def number_fits(name, value, want, tolerance):
    low, high = want if isinstance(want, list) else (want - tolerance, want + tolerance)
    if not low <= value <= high:
        raise Short(f"{name} is {value:.3f}, not {want}")


def read_json(result):
    try:
        return json.loads(result.out)
    except ValueError:
        raise Short(f"no JSON, exit code {result.code}: {(result.err or result.out).strip()[:120]}")


def findings(want, result):
    rules = want.get("rule")
    rules = [rules] if isinstance(rules, str) else rules
    out = []
    for d in read_json(result)["diagnostics"]:
        lines = want.get("line")
        if rules and d["rule"] not in rules:
            continue
        if lines and d["line"] not in (lines if isinstance(lines, list) else [lines]):
            continue
        if SEVERITIES.index(d["severity"]) < SEVERITIES.index(want.get("severity", "hint")):
            continue
        if "path" in want and not d["path"].endswith(want["path"]):
            continue
        out.append(d)
    return out


def described(want):
    return "/".join([want["rule"]] if isinstance(want.get("rule"), str) else want.get("rule", ["finding"])) + (
        f" of {want['severity']} or worse" if "severity" in want else "") + (f" at line {want['line']}" if "line" in want else "")


def all_found(result):
    c = collections.Counter(f"{d['severity']}[{d['rule']}]" for d in read_json(result)["diagnostics"])
    return ", ".join(f"{n} {k}" for k, n in c.items()) or "nothing is found"


def check_exit(want, result, *_):
    fits = result.code != 0 if want == "nonzero" else result.code in (want if isinstance(want, list) else [want])
    if not fits:
        raise Short(f"exit code {result.code}, not {want}: {(result.err or result.out).strip().splitlines()[-1][:110] if (result.err or result.out).strip() else ''}")


def check_finds(want, result, *_):
    n = sum((d.get("data") or {}).get("count", 1) if d["rule"] in ("sharp-corner", "self-intersection", "arc-as-chords") else 1
            for d in findings(want, result))
    if n < want.get("at_least", 1) or n > want.get("at_most", math.inf):
        raise Short(f"{n} {described(want)}: {all_found(result)}")


def check_lacks(want, result, *_):
    found = findings(want, result)
    if found:
        raise Short(f"{len(found)} {described(want)}: {found[0]['severity']}[{found[0]['rule']}] line {found[0]['line']}, {found[0]['message'][:80]}")


def check_says(want, result, results, folder, file):
    text = text_of(result, folder, file) if file else result.out + "\n" + result.err
    if not re.search(want, text, re.M):
        raise Short(f"nothing there like {want}: {(result.err or result.out).strip()[:110]!r}")


def check_unsays(want, result, results, folder, file):
    text = text_of(result, folder, file) if file else result.out + "\n" + result.err
    m = re.search(want, text, re.M)
    if m:
        raise Short(f"there is {m.group(0)[:80]!r}")


def check_numbers(want, result, *_):
    for d in read_json(result)["diagnostics"]:
        value = (d.get("data") or {}).get(want["key"])
        if value is not None and value > want["at_most"]:
            raise Short(f"{want['key']} is {value:g}, above {want['at_most']}")
        for n in re.findall(r"\d+(?:\.\d+)?", d["message"]):
            if float(n) > want.get("messages", math.inf):
                raise Short(f"the number {n} in a message: {d['message'][:100]}")


def check_contours(want, result, *_):
    data = read_json(result)
    contours = data["contours"]
    for kind in ("closed", "open"):
        n = sum(c["closed"] == (kind == "closed") for c in contours)
        if kind in want and n != want[kind]:
            raise Short(f"{n} {kind} contours, not {want[kind]}")
    if "total" in want and len(contours) != want["total"]:
        raise Short(f"{len(contours)} contours, not {want['total']}")
    if "role" in want and {c["role"] for c in contours} != {want["role"]}:
        raise Short(f"role {'/'.join(sorted({c['role'] for c in contours}))}, not {want['role']}")
    if "unit" in want and abs(data["unitsToMm"] - want["unit"]) > 1e-9:
        raise Short(f"a unit is {data['unitsToMm']} mm, not {want['unit']}")
    if "lengths" in want:
        have = sorted(c["length"] for c in contours)
        if len(have) != len(want["lengths"]) or any(abs(a - b) > want.get("tolerance", 0.01) for a, b in zip(have, sorted(want["lengths"]))):
            raise Short(f"contours of {[round(v, 3) for v in have]}, not {want['lengths']}")


def check_program(want, result, results, folder, file):
    text = text_of(result, folder, file)
    if "language" in want and language_of(text) != want["language"]:
        raise Short(f"the program is {language_of(text) or 'missing'}, not {want['language']}")
    moves = decode(text)
    cuts = cuts_of(text)
    rounds = [c for c in cuts if closed(c)]
    tolerance = want.get("tolerance", 0.02)
    if "blocks" in want:
        number_fits("the number of blocks", sum(m[0] in ("cut", "way") for m in moves), want["blocks"], 0)
    if "groups" in want:
        number_fits("the number of cuts and ways", len(cuts), want["groups"], 0)
    if "contours" in want and len(rounds) != want["contours"]:
        raise Short(f"{len(rounds)} contours are cut, not {want['contours']}")
    every = [p for c in (rounds or cuts) for p in c]
    if "length" in want:
        number_fits("the length of the cuts", sum(length_of(c) for c in (rounds or cuts)), want["length"], tolerance)
    for i, name in enumerate(("width", "height")):
        if name in want:
            number_fits("the path's " + name, box_of(every)[i], want[name], tolerance)
        if "each_" + name in want:
            for k, c in enumerate(rounds or cuts, 1):
                number_fits(f"the {name} of cut {k}", box_of(c)[i], want["each_" + name], tolerance)


def check_gouge(want, result, results, folder, file):
    rings = [chords(o) for o in outlines((folder / want["drawing"]).read_text(errors="replace"))]
    worst, place = gouge_of(cuts_of(text_of(result, folder, file)), rings, want["material"], want["correction"])
    if worst > want.get("at_most", 0.003):
        raise Short(f"the wire cuts {worst:.3f} mm into the part at {place[0]:.3f}, {place[1]:.3f}")


def check_neck(want, result, results, folder, file):
    left = neck_of(cuts_of(text_of(result, folder, file))[0], want["correction"])
    if left <= want.get("above", 0):
        raise Short(f"the first cut leaves {left:.3f} mm of the tab: the part is loose before the stop")


def check_same(want, result, results, folder, file):
    other = want["as"]
    if want["what"] == "contours":
        def table(r):
            return sorted((c["closed"], c["role"] if want.get("roles", True) else "", c["length"], abs(c.get("area") or 0)) for c in read_json(r)["contours"])
        a, b = table(result), table(results[other])
        if len(a) != len(b):
            raise Short(f"{len(a)} contours here, {len(b)} there")
        for x, y in zip(a, b):
            if x[:2] != y[:2] or abs(x[2] - y[2]) > want.get("tolerance", 0.005) or abs(x[3] - y[3]) > want.get("tolerance", 0.005) * 100:
                raise Short(f"{'closed' if x[0] else 'open'} {x[1]} {x[2]:.4f} mm, {x[3]:.4f} mm² here, {'closed' if y[0] else 'open'} {y[1]} {y[2]:.4f} mm, {y[3]:.4f} mm² there")
        return
    if want["what"] == "rules":
        def rules(r):
            return collections.Counter(d["rule"] for d in read_json(r)["diagnostics"] if d["rule"] not in want.get("but", []))
        if rules(result) != rules(results[other]):
            raise Short(f"{dict(rules(result))} here, {dict(rules(results[other]))} there")
        return
    a = text_of(result, folder, file)
    b = (folder / other).read_text(errors="replace") if isinstance(other, str) and (folder / other).exists() else results[other].out if isinstance(other, int) else ""
    if want["what"] == "bytes":
        if a != b or not a:
            new = [l for l in difflib.unified_diff(b.splitlines(), a.splitlines(), lineterm="", n=0) if l[:1] in "+-" and l[:3] not in ("+++", "---")]
            raise Short(f"{len(new)} lines differ, such as {new[:1]}" if a else "nothing was written")
        return
    texts = [t.out if not file else a for t in getattr(result, "tries", [result])]
    reasons = [same_path(t, b, want.get("tolerance", PATHS)) for t in texts]
    if all(reasons):
        raise Short("another path: " + reasons[0])


def same_blocks(a, b, tolerance=BLOCKS):
    """Whether two programs have the same moves, block by block: ends, middles of arcs, stops; within `tolerance` mm."""
    one, two = decode(a), decode(b)
    if [m[0] for m in one] != [m[0] for m in two]:
        return False
    return all(math.dist(p, q) <= tolerance for m, n in zip(one, two) if m[1] for p, q in zip(along(m[1], 2), along(n[1], 2)))


def check_one_of(want, result, results, folder, file):
    text = text_of(result, folder, file)
    if not text:
        return                                          # nothing is written: the program is left as it is
    if not any(same_blocks(text, (folder / w).read_text()) for w in want):
        given = (folder / want[0]).read_text().splitlines()
        changed = [l for l in difflib.unified_diff(given, text.splitlines(), lineterm="", n=0) if l[:1] in "+-" and l[:3] not in ("+++", "---")]
        raise Short("neither as it was nor right: " + " ".join(changed[:3]))


def check_drift(want, result, results, folder, file):
    blocks = [b for b in read_json(result)["blocks"] if b["kind"] in ("line", "arc")]
    nodes = [m[1][-1] for m in decode_iso(results[want["ideal"]].out) if m[0] == "cut"]
    first = decode_iso(results[want["ideal"]].out)[0][1][0]
    if len(nodes) != len(blocks):
        raise Short(f"{len(blocks)} blocks, {len(nodes)} in the ISO program")
    start, worst, place = blocks[0]["start"], 0.0, 0
    for i, b in enumerate(blocks):
        p = tuple((b["end"][k] - start[k]) / 1000 + first[k] for k in (0, 1))
        d = min(math.dist(p, q) for q in nodes[max(0, i - 3):i + 4]) * 1000
        if d > worst:
            worst, place = d, b["line"] + 1
    if worst > want["at_most"]:
        told = results[want["told"]]
        said = max([float(v) for v in re.findall(r"(\d+(?:\.\d+)?)\s*(?:µm|um|μm)", told.out + told.err)], default=0.0)
        if said < 0.8 * worst:
            raise Short(f"block {place} ends {worst:.1f} µm from where it should, at most {said:g} µm is said")


def check_growth(want, result, results, folder, file):
    small = results[want["from"]]
    if result.cpu > want["free"] * want.get("slower", 1) and result.cpu > want["times"] * max(small.cpu, 0.05):
        raise Short(f"{small.cpu:.1f} s, then {result.cpu:.1f} s: {result.cpu / max(small.cpu, 0.05):.1f} times as much")


def check_memory(want, result, *_):
    if result.memory > want:
        raise Short(f"{result.memory:.0f} MiB, more than {want}")


def check_got(want, result, results, folder, file):
    value = result.got.get(want["label"])
    for key in want.get("key", "").split(".") if want.get("key") else []:
        value = value.get(key) if isinstance(value, dict) else None
    if "is" in want and value != want["is"]:
        raise Short(f"{want['label']}: {json.dumps(value)[:200]}, not {json.dumps(want['is'])}")
    if "isnt" in want and value == want["isnt"]:
        raise Short(f"{want['label']}: {json.dumps(value)[:200]}")
    if "has" in want and want["has"] not in (value or []):
        raise Short(f"{want['label']}: {json.dumps(value)[:160]}, without {want['has']}")
    if "hasnt" in want and want["hasnt"] in (value or []):
        raise Short(f"{want['label']}: {json.dumps(value)[:160]}, with {want['hasnt']}")
    if "count" in want and len(value or []) != want["count"]:
        raise Short(f"{want['label']}: {len(value or [])}, not {want['count']}")


def check_contours_as(want, result, results, folder, file):
    """The contours of a session's `wedm/contours` against those of a step's `contours --output json`."""
    value = result.got.get(want["label"]) or {}
    stand_in = Result()
    stand_in.out = json.dumps(value)
    check_same({"what": "contours", "as": want["as"], "roles": False}, stand_in, results, folder, None)


def check_program_as(want, result, results, folder, file):
    """The program of a session's `wedm/generate` against that of a step's `generate`."""
    value = result.got.get(want["label"]) or {}
    program = value.get("program")
    if not program:
        raise Short("no program: " + json.dumps(value)[:160])
    reason = same_path(program, results[want["as"]].out)
    if reason:
        raise Short("another program: " + reason)


def check_actions(want, result, results, folder, file):
    """None of the preferred quick fixes spoils the program; `offers`: the right one is among them, where there are any."""
    actions, right = result.got.get(want["label"]) or [], (folder / want["right"]).read_text()
    for a in actions:
        if a["preferred"] and a["text"].split() != right.split():
            raise Short(f"preferred, and wrong: {a['title'][:90]}")
    if want.get("offers") and not any(a["text"].split() == right.split() for a in actions):
        raise Short(f"the right one is not offered: {[a['title'][:50] for a in actions]}")


def check_told_replaced(want, result, results, folder, file):
    """What is said where a file is there already differs from what is said where it is not."""
    other = results[want]
    clean = lambda r: re.sub(r"\S*(old|new)\S*", "", r.out + r.err).split()
    if clean(result) == clean(other):
        raise Short("a file of another content is replaced, and nothing says so")


CHECKS = {"exit": check_exit, "finds": check_finds, "lacks": check_lacks, "says": check_says, "unsays": check_unsays, "numbers": check_numbers,
          "contours": check_contours, "program": check_program, "gouge": check_gouge, "neck": check_neck, "same": check_same, "one_of": check_one_of,
          "drift": check_drift, "growth": check_growth, "memory": check_memory, "got": check_got, "contours_as": check_contours_as,
          "program_as": check_program_as, "actions": check_actions, "told_replaced": check_told_replaced}
