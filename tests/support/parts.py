"""What tests/run and tests/nightly are made of: each part with its command, what it needs, and how long it takes usually.

A part that is new stands in one of the two lists.
"""

from __future__ import annotations

import os
import tomllib

from runner import ROOT, TARGET, Part, cargo, line, silent

# The program that the Rust tests build, and all clients are tested with.
WEDM = TARGET / "debug" / "wedm"

# Those whose tests install something.
CLIENTS = ("vscode", "view", "librecad", "editors", "python", "autocad", "autolisp")

# What tests/nightly takes with all that it has.
HOURS = 5
BENCHES = ("core", "program", "path", "session", "memory", "reading", "shapes")


def settings() -> dict[str, str]:
    """What all parts run under."""
    found = {
        # The same random cases every time, so that a run says something about the change and not about luck; tests/nightly draws others.
        "PROPTEST_RNG_SEED": os.environ.get("PROPTEST_RNG_SEED", "1"),
        "CARGO_TERM_PROGRESS_WHEN": "never",
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    if os.environ.get("CI"):
        # A machine that runs them once has no use for what makes the next build short, nor for lines of code in a debugger.
        found |= {"CARGO_INCREMENTAL": "0", "CARGO_PROFILE_DEV_DEBUG": "0"}
    return found


def script(name: str, lane: str, path: str, usual: int, limit: int, needs: tuple[str, ...] = ("build",)) -> Part:
    return Part(name, lane, path, usual, limit, needs, ("install",), line, {"WEDM": str(WEDM)})


def rust_tests(test: str) -> str:
    """All targets of `cargo test` but the tests of the server, and the examples in the documentation."""
    targets = [target["name"] for target in tomllib.loads((ROOT / "Cargo.toml").read_text())["test"]]
    others = " ".join(f"--test {name}" for name in targets if name != "server")
    return f"{test} --lib --bins {others} && {test} --doc"


def day() -> list[Part]:
    """What every change has to pass."""
    test = "cargo test --locked --features testing --no-fail-fast"
    setup = ". tests/support/setup.sh && "
    compilers = "command -v cc && command -v c++ || debian gcc g++ libc6-dev"
    installs = [f"{folder}/test --install" for folder in (*(f"clients/{name}" for name in CLIENTS), "tests/protocol")]
    # What the Rust tests hold their own readers and writers against; LibreCAD, too, where its client has brought it.
    ezdxf = "python_environment target/ezdxf benches/requirements.txt; "
    return [
        Part("format", "rust", "cargo fmt --check", 5, 300),
        Part("compilers", "rust", setup + compilers, 20, 900, counts=silent),
        # The program itself is built with the tests of it.
        Part("build", "rust", f"{test} --no-run", 300, 2400, ("compilers",), counts=silent),
        Part("lint", "rust", "cargo clippy --locked --all-targets --features testing --quiet -- -D warnings", 300, 2400, ("compilers",)),
        Part("documentation", "rust", "cargo doc --locked --no-deps --quiet", 65, 1800, ("compilers",), environment={"RUSTDOCFLAGS": "-D warnings"}),
        Part("tests", "rust", setup + ezdxf + rust_tests(test), 450, 2400, ("build",), ("install",), cargo),
        Part("server", "rust", f"{test} --test server", 120, 1800, ("build",), counts=cargo),
        Part("package", "rust", "dist/contents", 5, 300),
        # Everything from Debian, PyPI and npm, while the compiler is busy.
        Part("install", "clients", setup + " && ".join(installs), 200, 2400, ("compilers",), counts=silent),
        script("site", "clients", "docs/site/test", 20, 600, ()),
        # The longest first, so that both who work here end together.
        script("vscode", "clients", "clients/vscode/test", 400, 1800),
        script("librecad", "clients", "clients/librecad/test", 400, 1800),
        script("python", "clients", "clients/python/test", 120, 900),
        script("cases", "clients", "tests/cases/run", 110, 900),
        script("editors", "clients", "clients/editors/test", 60, 1800),
        script("view", "clients", "clients/view/test", 40, 900),
        script("autocad", "clients", "clients/autocad/test", 30, 900),
        script("autolisp", "clients", "clients/autolisp/test", 20, 600),
        script("protocol", "clients", "tests/protocol/test", 20, 900),
    ]


def night(share: float) -> list[Part]:
    """What a release has to pass beside that; `share` of the usual time for what has no end of its own."""
    release = str(TARGET / "release" / "wedm")
    seed = int.from_bytes(os.urandom(3))
    fuzzed, soaked = max(int(600 * share), 5), max(int(3600 * share), 20)
    rounds, mutants = max(round(10 * share), 1), max(round(6 * share), 1)
    soak = f"WEDM_SOAK_SEED={seed} WEDM_SOAK_SECONDS={soaked} cargo test --locked --features testing --test server soak -- --nocapture"
    mutate = f"cargo install --locked --quiet cargo-mutants cargo-nextest && tests/mutants/run --seed {seed} --count {mutants}"
    parts = [
        Part("release", "night", "cargo build --locked --release --bins --benches", 900, 5400, counts=silent),
        Part("cases", "night", "tests/cases/run", 120, 900, ("release",), counts=line, environment={"WEDM": release}),
        Part("map", "night", "clients/python/test tests/test_progress.py", 300, 1200, ("release",), counts=line, environment={"WEDM": release, "WEDM_MAP_BYTES": "1000000"}),
        Part("packages", "night", "dist/test", 300, 2400, ("release",), counts=line, environment={"WEDM": release}),
    ]
    for name in BENCHES:
        parts.append(Part(f"bench-{name}", "night", f"cargo bench --locked --bench {name}", 300, 3600, ("release",)))
    parts += [
        Part("random", "night", f"tests/random {rounds}", int(600 + 180 * rounds), 14400),
        Part("soak", "night", soak, soaked + 300, soaked + 3600, counts=cargo, environment={"CARGO_PROFILE_DEV_OPT_LEVEL": "2"} | apart("random")),
        Part("fuzz", "night", f"fuzz/run {fuzzed}", 8 * fuzzed + 600, 8 * fuzzed + 7200, counts=line),
        Part("mutants", "night", mutate, 600 * mutants + 600, 1800 * mutants + 3600),
    ]
    return parts


def apart(folder: str) -> dict[str, str]:
    """A target folder of its own, beside that of other settings of the compiler."""
    return {"CARGO_TARGET_DIR": str(TARGET / folder), "CARGO_PROFILE_DEV_DEBUG": "0"}
