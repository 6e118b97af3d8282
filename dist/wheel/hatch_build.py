"""Puts a program that is built into the wheel: $WEDM. Version, description, licence and readme are those of Cargo.toml."""

from __future__ import annotations

import os
import platform
import re
import sys
import tomllib
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface
from hatchling.metadata.plugin.interface import MetadataHookInterface

ROOT = Path(__file__).resolve().parents[2]


def cargo() -> dict[str, Any]:
    """What Cargo.toml says of the package."""
    return tomllib.loads((ROOT / "Cargo.toml").read_text(encoding="utf-8"))["package"]


def system(program: Path) -> str:
    """The platform tag: on Linux by the newest version of glibc that the program asks for."""
    machine = platform.machine().lower()
    if sys.platform == "win32":
        return {"amd64": "win_amd64", "arm64": "win_arm64"}[machine]
    if sys.platform == "darwin":
        return {"x86_64": "macosx_10_12_x86_64", "arm64": "macosx_11_0_arm64"}[machine]
    asked = [(int(major), int(minor)) for major, minor in re.findall(rb"GLIBC_(\d+)\.(\d+)", program.read_bytes())]
    if not asked:
        raise SystemExit(f"{program} names no version of glibc: there is no wheel for such a Linux")
    return "manylinux_{}_{}_{}".format(*max(asked), machine)


class CustomMetadataHook(MetadataHookInterface):
    def update(self, metadata: dict[str, Any]) -> None:
        crate = cargo()
        metadata["description"] = crate["description"]
        metadata["license"] = crate["license"]
        metadata["readme"] = {"content-type": "text/markdown", "text": (ROOT / crate["readme"]).read_text(encoding="utf-8")}
        metadata["urls"] = {"Source": crate["repository"]}


class CustomBuildHook(BuildHookInterface):
    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        program = Path(os.environ["WEDM"]).resolve()
        build_data["pure_python"] = False
        build_data["tag"] = f"py3-none-{system(program)}"
        build_data["shared_scripts"][str(program)] = program.name
        for licence in sorted(ROOT.glob("LICENSE-*")):
            build_data["extra_metadata"][str(licence)] = licence.name
