#!/usr/bin/env python3
"""Publishes those crates on crates.io that aren't there yet in this version. Run again, it goes on where it stopped.

python3 packaging/publish.py     # after `cargo login`, or with CARGO_REGISTRY_TOKEN
"""

from __future__ import annotations

import json
import subprocess
import time

from platforms import ROOT

# crates.io takes five crates with new names at once, and one more every ten minutes.
WAIT = 610


def missing() -> list[str]:
    """The crates that are published, and aren't."""
    command = ["cargo", "metadata", "--format-version=1", "--no-deps", "--locked"]
    packages = json.loads(subprocess.run(command, cwd=ROOT, capture_output=True, check=True).stdout)["packages"]
    names = [(it["name"], it["version"]) for it in packages if it["publish"] is None]
    return [name for name, version in names if not _is_known(f"{name}@{version}")]


def _is_known(crate: str) -> bool:
    command = ["cargo", "info", "--quiet", "--registry", "crates-io", crate]
    ended = subprocess.run(command, cwd="/", capture_output=True, text=True, check=False)
    if ended.returncode and "could not find" not in ended.stderr:
        raise SystemExit(ended.stderr)
    return ended.returncode == 0


def main() -> None:
    while names := missing():
        print("publishing", ", ".join(names), flush=True)
        chosen = [part for name in names for part in ("--package", name)]
        ended = subprocess.run(
            ["cargo", "publish", "--locked", *chosen], cwd=ROOT, stderr=subprocess.PIPE, text=True, check=False
        )
        if ended.returncode:
            print(ended.stderr, flush=True)
            if "too many" not in ended.stderr.lower():
                raise SystemExit(ended.returncode)
            time.sleep(WAIT)
    print("every crate is published")


if __name__ == "__main__":
    main()
