"""Runs the steps of a case, each under limits of processor time, clock and memory."""

import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

from checks import verdict
from drawings import made
from results import Result, Short, Skip, environment
from session import Session

try:
    import resource
except ImportError:                                     # Windows: limits by the clock
    resource = None


def command(argv, folder, cpu, wall):
    """Runs a command within a limit of CPU seconds, and a generous one by the clock."""
    result = Result()
    result.argv = argv
    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(cpu) + 1, math.ceil(cpu) + 3))
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        process = subprocess.Popen(argv, stdin=subprocess.DEVNULL, stdout=out, stderr=err, cwd=folder, env=environment(),
                                   preexec_fn=limit if resource and cpu else None)
        end = time.monotonic() + wall
        usage = status = None
        while True:
            if resource:
                pid, status, usage = os.wait4(process.pid, os.WNOHANG)
                if pid:
                    process.returncode = os.waitstatus_to_exitcode(status)
                    break
            elif process.poll() is not None:
                break
            if time.monotonic() > end:
                process.kill()
                process.wait()
                raise Short(f"`{' '.join(argv[1:4])}` does not end in {wall:.0f} s")
            time.sleep(0.005)
        out.seek(0), err.seek(0)
        result.out, result.err = out.read().decode("utf-8", "replace"), err.read().decode("utf-8", "replace")
    result.code = process.returncode
    if usage:
        result.cpu = usage.ru_utime + usage.ru_stime
        result.memory = usage.ru_maxrss / (1024 if sys.platform != "darwin" else 1024 * 1024)
    if resource and cpu and (result.code in (-24, -9) or result.cpu > cpu + 0.5):
        raise Short(f"`{' '.join(argv[1:4])}` takes more than {cpu:g} s of CPU time")
    if result.code < 0 or result.code == 101:
        raise Short(f"`{' '.join(argv[1:4])}` ends with {result.code}: {result.err.strip()[-160:]}")
    return result


def holes_printed(result):
    """The places (x, y) on the lines of stderr that have two numbers with a comma between them and follow `thread`."""
    pairs = []
    for line in result.err.splitlines():
        if re.search(r"thread|hole|穿丝", line):
            pairs += re.findall(r"(-?\d+(?:\.\d+)?)\s*,\s*(-?\d+(?:\.\d+)?)", line)
    return [",".join(p) for p in pairs]


def prepare(case, cases, folder):
    for item in case.get("files", []):
        if isinstance(item, str):
            item = {"from": item}
        to = folder / item.get("to", pathlib.PurePath(item.get("from", "x")).name)
        to.parent.mkdir(parents=True, exist_ok=True)
        if "from" in item:
            shutil.copyfile(cases / item["from"], to)
        elif "make" in item:
            to.write_text(made(item["make"], item["count"]))
        elif "text" in item:
            to.write_text(item["text"])
        elif item.get("fifo"):
            if not hasattr(os, "mkfifo"):
                raise Skip("this system has no FIFOs")
            os.mkfifo(to)


def perform(case, cases, wedm, slower, patience):
    """Runs a case. `patience`: that many times as long a server has to be silent until it counts as done."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="wedm-case-"))
    try:
        prepare(case, cases, folder)
        results = []
        for step in case["run"]:
            if isinstance(step, list):
                step = {"argv": step}
            if "do" in step:
                result = Result()
                result.got = Session(wedm, folder, step.get("server", {}), slower, patience).run(step["do"])
                results.append(result)
                continue
            if "sleep" in step:
                time.sleep(step["sleep"])
                results.append(Result())
                continue
            if "needs" in step and not shutil.which(step["needs"]):
                raise Skip(step["needs"] + " is not installed")
            if step.get("needs") == "strace" and subprocess.run(["strace", "-o", os.devnull, "true"], capture_output=True).returncode:
                raise Skip("strace may not trace here")
            argv = [a.replace("{wedm}", wedm).replace("{tmp}", str(folder)) for a in step["argv"]]
            if any("{hole}" in a for a in argv):
                holes = holes_printed(results[-1])
                if not holes:
                    raise Short("the place of the thread hole is not printed")
                tries = [command([a.replace("{hole}", h) for a in argv], folder, 60, 120 * slower) for h in dict.fromkeys(holes)]
                result = tries[0]
                result.tries = tries
            else:
                result = command(argv, folder, step.get("cpu", 60) * slower, step.get("wall", 120) * slower)
            results.append(result)
        verdict(case["expect"], results, folder)
    finally:
        shutil.rmtree(folder, ignore_errors=True)
