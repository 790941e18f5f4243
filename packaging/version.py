#!/usr/bin/env python3
"""Sets the version of the next release wherever it stands, with the date of today in CHANGELOG.md, and writes the files that later
versions are tested with (tests/surface/).

    python3 packaging/version.py 0.1.0
"""

from __future__ import annotations

import datetime
import os
import re
import subprocess
import sys

from platforms import ROOT


def replaced(name: str, pattern: str, text: str) -> None:
    """Replaces what matches `pattern` in a file."""
    path = ROOT / name
    changed, count = re.subn(pattern, text, path.read_text(encoding="utf-8"), flags=re.M)
    if not count:
        raise SystemExit(f"{name}: nothing matches {pattern}")
    path.write_text(changed, encoding="utf-8")


def main(version: str) -> None:
    # this first: it fails if nothing is written about the version
    today = datetime.datetime.now(tz=datetime.UTC).date()
    replaced("CHANGELOG.md", rf"^## {re.escape(version)} \(.*\)$", f"## {version} ({today})")
    replaced("Cargo.toml", r'^version = ".*"$', f'version = "{version}"')
    replaced("Cargo.toml", r'^(brinell-.*), version = ".*" }$', rf'\1, version = "{version}" }}')
    replaced("CITATION.cff", r"^version: .*$", f"version: {version}")
    for manifest in ("Cargo.toml", "benches/physics/Cargo.toml"):
        command = ["cargo", "update", "--quiet", "--workspace", "--manifest-path", manifest]
        subprocess.run(command, cwd=ROOT, check=True)
    command = ["cargo", "test", "--release", "--test", "guide", "surface"]
    subprocess.run(command, cwd=ROOT, check=True, env={**os.environ, "BRINELL_WRITE": "1"})


if __name__ == "__main__":
    if len(sys.argv) != 2 or not re.fullmatch(r"\d+\.\d+\.\d+", sys.argv[1]):
        raise SystemExit(__doc__)
    main(sys.argv[1])
