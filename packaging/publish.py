#!/usr/bin/env python3
"""Publishes those crates on crates.io that aren't there yet in this version. Run again, it goes on where it stopped.

    python3 packaging/publish.py     # at the tag; after `cargo login`, or with CARGO_REGISTRY_TOKEN
"""

from __future__ import annotations

import json
import subprocess
import sys
import time

from platforms import ROOT

# crates.io takes five crates with new names at once, and one more every ten minutes.
WAIT = 610


def crates() -> dict[str, str]:
    """The versions of the crates that are to be published; an error if the commit isn't that of their tag."""

    def said(*command: str) -> str:
        return subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, check=True, encoding="utf-8").stdout

    packages = json.loads(said("cargo", "metadata", "--format-version=1", "--no-deps", "--locked"))["packages"]
    found = {it["name"]: it["version"] for it in packages if it["publish"] is None}
    tag = f"v{found['brinell']}"
    if tag not in said("git", "tag", "--points-at", "HEAD").split():
        raise SystemExit(f"this commit has no tag {tag}: git checkout {tag}")
    return found


def _is_known(crate: str) -> bool:
    command = ["cargo", "info", "--quiet", "--registry", "crates-io", crate]
    ended = subprocess.run(command, cwd="/", capture_output=True, text=True, check=False)
    if ended.returncode and "could not find" not in ended.stderr:
        raise SystemExit(ended.stderr)
    return ended.returncode == 0


def main() -> None:
    known = crates()
    while names := [name for name, version in known.items() if not _is_known(f"{name}@{version}")]:
        print("publishing", ", ".join(names), flush=True)
        chosen = [part for name in names for part in ("--package", name)]
        command = ["cargo", "publish", "--locked", *chosen]
        too_many = False
        with subprocess.Popen(command, cwd=ROOT, stderr=subprocess.PIPE, encoding="utf-8") as cargo:
            for line in cargo.stderr or []:
                print(line, end="", flush=True)
                too_many |= "too many" in line.lower()
        if cargo.returncode:
            if not too_many:
                raise SystemExit(cargo.returncode)
            print(f"crates.io takes the next one in ten minutes: waiting {WAIT} s", flush=True)
            time.sleep(WAIT)
    print("every crate is published")


if __name__ == "__main__":
    if sys.argv[1:]:
        raise SystemExit(__doc__)
    main()
