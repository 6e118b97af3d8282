"""Runs the parts of a test run in lanes, says what it does and how long that takes usually, and ends with one summary.

A part is a command. Lanes run beside each other, and whoever works in a lane takes its next part: compiling keeps the cores busy, editors and
CAD programs mostly wait. What a part prints is kept in `target/tests/NAME.log`; where one part alone is run it is shown as it comes.

The last lines are one line for each failure, then `N passed, N failed, N skipped`.
"""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import threading
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TARGET = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
LOGS = ROOT / "target" / "tests"

# Never longer than this without a word, in seconds.
SILENCE = 30
# How a part begins the line of a failure: our scripts, cargo, pytest.
FAILURE = re.compile(r"^\s*(?:FAILED|SHORT|BROKEN|HOLDS|!!|not ok)\s+(.*)$|^test (\S+) \.\.\. FAILED$|^FAILED? (\S+::\S+)", re.M)
# How many parts of a lane run at a time, where it is not one.
WORKERS = {"clients": 2}
# Lines that are shown of a part that failed: from each failure on, of so many failures, and at its end.
FROM_FAILURE, FAILURES, AT_END = 12, 10, 40


@dataclass
class Counts:
    passed: int = 0
    failed: int = 0
    skipped: int = 0

    def __iadd__(self, other: Counts) -> Counts:
        self.passed += other.passed
        self.failed += other.failed
        self.skipped += other.skipped
        return self

    def __str__(self) -> str:
        return f"{self.passed} passed, {self.failed} failed, {self.skipped} skipped"


def whole(log: str, code: int) -> Counts:
    """One check: its exit code."""
    return Counts(passed=1) if code == 0 else Counts(failed=1)


def silent(log: str, code: int) -> Counts:
    """No check, only what others need: it counts where it fails."""
    return Counts() if code == 0 else Counts(failed=1)


def cargo(log: str, code: int) -> Counts:
    """The sums of `cargo test`'s own counts."""
    found = re.findall(r"^test result: .*?(\d+) passed; (\d+) failed;", log, re.M)
    return at_least_one(Counts(sum(int(p) for p, _ in found), sum(int(f) for _, f in found)), code)


def line(log: str, code: int) -> Counts:
    """The last line `N passed, M failed, K skipped` of a script."""
    found = re.findall(r"^(\d+) passed, (\d+) failed, (\d+) skipped$", log, re.M)
    return at_least_one(Counts(*map(int, found[-1])) if found else Counts(), code)


def at_least_one(counts: Counts, code: int) -> Counts:
    """What ends with an error has failed, and so has what has counted nothing."""
    if counts.failed == 0 and (code != 0 or counts.passed + counts.skipped == 0):
        counts.failed = 1
    return counts


@dataclass
class Part:
    name: str
    lane: str
    command: str
    # Seconds that it takes usually on two cores with nothing built, and at most.
    usual: int
    limit: int
    # Parts without which it cannot run, and such that it waits for where they run, too.
    needs: tuple[str, ...] = ()
    after: tuple[str, ...] = ()
    counts: Callable[[str, int], Counts] = whole
    environment: dict[str, str] = field(default_factory=dict)


@dataclass
class Ended:
    part: Part
    counts: Counts
    seconds: float
    log: str
    why: str
    # Seconds of the processor, of all that it waited for.
    worked: float = 0


class Run:
    def __init__(self, parts: list[Part], names: list[str]) -> None:
        known = {part.name: part for part in parts}
        for name in names:
            if name not in known:
                sys.exit(f"there is no part named {name}, expected one of: {' '.join(known)}")
        wanted = set(names) or set(known)
        # What a named part needs is made, too.
        for part in reversed(parts):
            if part.name in wanted:
                wanted |= set(part.needs)
        self.parts = [part for part in parts if part.name in wanted]
        self.shows = len(names) == 1
        self.alone = names[0] if self.shows else ""
        self.began = time.monotonic()
        self.spoke = self.began
        self.speaking = threading.Lock()
        self.ended = {part.name: threading.Event() for part in self.parts}
        self.results: dict[str, Ended] = {}
        self.running: dict[str, tuple[float, subprocess.Popen[bytes]]] = {}

    def say(self, text: str) -> None:
        with self.speaking:
            self.spoke = time.monotonic()
            print(f"[{clock(self.spoke - self.began)}] {text}", flush=True)

    def run(self) -> int:
        LOGS.mkdir(parents=True, exist_ok=True)
        lanes: dict[str, deque[Part]] = {}
        for part in self.parts:
            lanes.setdefault(part.lane, deque()).append(part)
        working = [(lane, worker) for lane in lanes for worker in range(WORKERS.get(lane, 1))]
        threads = [threading.Thread(target=self.lane, args=(lanes[lane],), daemon=True) for lane, _ in working]
        for thread in threads:
            thread.start()
        try:
            while any(thread.is_alive() for thread in threads):
                time.sleep(0.2)
                if time.monotonic() - self.spoke > SILENCE:
                    self.say("still at " + self.at_work())
        except KeyboardInterrupt:
            self.stop()
            raise SystemExit(130) from None
        return self.summary()

    def at_work(self) -> str:
        now = time.monotonic()
        usual = {part.name: part.usual for part in self.parts}
        return ", ".join(f"{name} ({now - since:.0f} s of usually {usual[name]})" for name, (since, _) in list(self.running.items()))

    def stop(self) -> None:
        for _, process in list(self.running.values()):
            end_group(process)

    def lane(self, parts: deque[Part]) -> None:
        while True:
            try:
                part = parts.popleft()
            except IndexError:
                return
            for name in (*part.needs, *part.after):
                if name in self.ended:
                    self.ended[name].wait()
            missing = [name for name in part.needs if name in self.results and self.results[name].counts.failed]
            if missing:
                self.results[part.name] = Ended(part, Counts(failed=1), 0, "", f"not run, since {missing[0]} failed")
            else:
                self.results[part.name] = self.perform(part)
            ended = self.results[part.name]
            self.say(f"{'FAILED' if ended.counts.failed else 'ok':6} {part.name}: {ended.counts}, {ended.seconds:.0f} s {ended.why}".rstrip())
            self.ended[part.name].set()

    def perform(self, part: Part) -> Ended:
        self.say(f"begins {part.name} (usually {part.usual} s): {part.command}")
        begin = time.monotonic()
        path = LOGS / f"{part.name}.log"
        shown = self.shows and part.name == self.alone
        environment = {**os.environ, **part.environment}
        why = ""
        with path.open("wb") as log:
            process = subprocess.Popen(
                ["bash", "-c", part.command],
                cwd=ROOT,
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
            self.running[part.name] = (begin, process)
            ticking = threading.Timer(part.limit, end_group, [process])
            ticking.start()
            assert process.stdout is not None
            for text in process.stdout:
                log.write(text)
                log.flush()
                if shown:
                    self.spoke = time.monotonic()
                    sys.stdout.buffer.write(text)
                    sys.stdout.flush()
            _, status, usage = os.wait4(process.pid, 0)
            code = process.returncode = os.waitstatus_to_exitcode(status)
            if not ticking.is_alive():
                why = f"(ended after {part.limit} s, its limit)"
            ticking.cancel()
        # What it left running would disturb the others.
        end_group(process)
        del self.running[part.name]
        text = path.read_text(errors="replace")
        worked = usage.ru_utime + usage.ru_stime
        return Ended(part, part.counts(text, code), time.monotonic() - begin, text, why, worked)

    def summary(self) -> int:
        everything, failed = Counts(), []
        for part in self.parts:
            ended = self.results[part.name]
            everything += ended.counts
            if ended.counts.failed:
                failed.append(ended)
        for ended in failed:
            if not ended.log:
                continue
            print(f"\n== {ended.part.name} failed {ended.why}; all that it printed: target/tests/{ended.part.name}.log")
            print("\n".join(shown(ended.log.splitlines())))
        # By the clock, and of the processor.
        times = [(part.name, self.results[part.name]) for part in self.parts]
        print("\ntime: " + ", ".join(f"{name} {ended.seconds:.0f} s ({ended.worked:.0f} s)" for name, ended in times), end="")
        print(f", together {clock(time.monotonic() - self.began)}")
        for ended in failed:
            for reason in reasons(ended):
                print(f"failed: {ended.part.name}: {reason}")
        print(everything)
        return 1 if everything.failed else 0


def reasons(ended: Ended) -> list[str]:
    """One line for each failure, in the words of the part."""
    found = FAILURE.findall(ended.log)
    lines = list(dict.fromkeys(next(text for text in texts if text).strip() for texts in found))
    return lines or [ended.why or f"see target/tests/{ended.part.name}.log"]


def shown(log: list[str]) -> list[str]:
    """The failures of a part where they stand in its log, then its end."""
    at = [nth for nth, text in enumerate(log) if FAILURE.match(text)][:FAILURES]
    last = max(len(log) - AT_END, 0)
    wanted = sorted({nth for begin in at for nth in range(begin, min(begin + FROM_FAILURE, len(log)))} | set(range(last, len(log))))
    lines = []
    for before, nth in zip([-1, *wanted], wanted):
        if nth > before + 1:
            lines.append("   ...")
        lines.append(log[nth])
    return lines


def clock(seconds: float) -> str:
    return f"{int(seconds) // 60:2d}:{int(seconds) % 60:02d}"


def end_group(process: subprocess.Popen[bytes]) -> None:
    try:
        os.killpg(process.pid, signal.SIGTERM)
        if process.poll() is None:
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass
