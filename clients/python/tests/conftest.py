"""The real server for every test, named by the environment variable WEDM or built in the checkout."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from wedm_client import Server

ROOT = Path(__file__).resolve().parents[3]


def pytest_configure() -> None:
    named = os.environ.get("WEDM") or str(ROOT / "target/release/wedm")
    if not os.access(named, os.X_OK):
        pytest.exit(f"{named} is not a program: build it with `cargo build --release`, or name it in WEDM", returncode=2)
    os.environ["WEDM"] = named


@pytest.fixture
def program() -> str:
    return os.environ["WEDM"]


@pytest.fixture
def data() -> Path:
    """The drawings that the project's own tests use."""
    return ROOT / "tests/data"


@pytest.fixture
def root() -> Path:
    return ROOT


@pytest.fixture
def server(tmp_path: Path) -> Iterator[Server]:
    with Server(folder=tmp_path, timeout=30) as started:
        yield started
