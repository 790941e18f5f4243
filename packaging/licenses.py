"""The licenses of the crates that are compiled into the program, or into the module of the page."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any

from platforms import ROOT

_HEAD = """\
This contains compiled code of the Rust standard library (MIT or Apache-2.0 license, (c) The Rust Project
Developers){} and of these crates:

"""

# Modules for WebAssembly contain their C library; elsewhere it is that of the system.
_C_LIBRARY = ", of wasi-libc (MIT license, (c) its contributors and those of musl)"

# How the files are called that have a license's text.
_NAMES = ("LICENSE", "LICENCE", "COPYING", "UNLICENSE", "NOTICE")


def third_party(target: str, program: str = "brinell") -> bytes:
    """A list of the crates in the `program` for `target`, and the texts of their licenses, each once."""
    crates = linked_crates(target, program)
    text = _HEAD.format(_C_LIBRARY if target.startswith("wasm") else "")
    text += "".join(f"- {_name(crate)}: {crate['license']}\n" for crate in crates)
    by_text: dict[str, list[str]] = {}
    for crate in crates:
        for path in _files(Path(crate["manifest_path"]).parent):
            by_text.setdefault(path.read_text(encoding="utf-8").strip(), []).append(_name(crate))
    for license_text, names in by_text.items():
        text += f"\n{'-' * 78}\n{', '.join(names)}:\n\n{license_text}\n"
    return text.encode()


def linked_crates(target: str, program: str = "brinell") -> list[dict[str, Any]]:
    """What cargo says about the crates in the `program`, a package of this workspace, for `target`."""
    command = ["cargo", "metadata", "--format-version=1", "--locked", "--filter-platform", target]
    metadata = subprocess.run(command, cwd=ROOT, capture_output=True, check=True).stdout
    return _linked(json.loads(metadata), program)


def _name(crate: dict[str, Any]) -> str:
    return f"{crate['name']} {crate['version']}"


def _linked(metadata: dict[str, Any], program: str) -> list[dict[str, Any]]:
    """The crates of others that the program depends on, but for those that only build or test it."""
    nodes = {node["id"]: node for node in metadata["resolve"]["nodes"]}
    members = [crate for crate in metadata["packages"] if crate["source"] is None]
    found, waiting = set(), [crate["id"] for crate in members if crate["name"] == program]
    while waiting:
        crate = waiting.pop()
        if crate not in found:
            found.add(crate)
            needed = nodes[crate]["deps"]
            waiting += [it["pkg"] for it in needed if any(kind["kind"] is None for kind in it["dep_kinds"])]
    crates = [crate for crate in metadata["packages"] if crate["id"] in found and crate["source"]]
    return sorted(crates, key=_name)


def _files(folder: Path) -> list[Path]:
    """The files with the license of a crate; of MIT and Apache-2.0, which are a choice, the former."""
    files = [path for path in sorted(folder.iterdir()) if path.name.upper().startswith(_NAMES) and path.is_file()]
    if any("MIT" in path.name for path in files):
        files = [path for path in files if "APACHE" not in path.name.upper()]
    return files
