#!/usr/bin/env python3
"""Writes the addresses of repository and documentation wherever they belong, or takes them out again, so that nothing
points to a place that doesn't exist.

    python3 packaging/addresses.py https://github.com/OWNER/brinell https://OWNER.github.io/brinell
    python3 packaging/addresses.py              # none

They stand in `[workspace.package]` of Cargo.toml; all else follows from there.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

from platforms import ROOT

CRATES = [
    "Cargo.toml",
    *(f"crates/{name}/Cargo.toml" for name in ("contact", "exporter", "fmu", "unit")),
    "modelDescription/Cargo.toml",
]


def edited(name: str, pattern: str, lines: str, after: str) -> None:
    """Replaces all that matches `pattern` in a file by `lines` behind the first match of `after`."""
    path = Path(ROOT / name)
    text = re.sub(pattern, "", path.read_text(encoding="utf-8"), flags=re.M)
    found = re.search(after, text, re.M)
    if found is None:
        raise SystemExit(f"{name}: nothing matches {after}")
    path.write_text(text[: found.end()] + lines + text[found.end() :], encoding="utf-8")


def main(repository: str, documentation: str) -> None:
    for address in filter(None, (repository, documentation)):
        if not re.fullmatch(r"https://[\w.-]+(/[\w.-]+)*", address):
            raise SystemExit(f"{address!r}: an address begins with https:// and has no slash at its end")
    both = {"repository": repository, "homepage": documentation}
    known = {key: address for key, address in both.items() if address}
    edited(
        "Cargo.toml",
        r'^(repository|homepage) = ".*"\n',
        "".join(f'{key} = "{address}"\n' for key, address in known.items()),
        r'^\[workspace\.package\]\n(.+\n)*?license = "MIT"\n',
    )
    for name in CRATES:
        inherited = "".join(f"{key}.workspace = true\n" for key in known)
        edited(name, r"^(repository|homepage)\.workspace = true\n", inherited, r"^license\.workspace = true\n")
    urls = {"Documentation": documentation, "Repository": repository}
    section = "".join(f'{key} = "{address}"\n' for key, address in urls.items() if address)
    edited(
        "python/pyproject.toml",
        r'^\[project\.urls\]\n(\w+ = ".*"\n)*\n',
        f"[project.urls]\n{section}\n" if section else "",
        r"^dynamic = .*\n\n",
    )
    edited(
        "CITATION.cff",
        r"^(repository-code|url): .*\n",
        "".join(
            f'{key}: "{address}"\n'
            for key, address in {"repository-code": repository, "url": documentation}.items()
            if address
        ),
        r"^license: MIT\n",
    )
    edited(
        "docs/book.toml",
        r"^git-repository-url = .*\n",
        f'git-repository-url = "{repository}"\n' if repository else "",
        r"^\[output\.html\]\n",
    )
    readme = ROOT / "README.md"
    cloned = re.sub(
        r"git clone \S+ brinell", f"git clone {repository or 'REPOSITORY'} brinell", readme.read_text(encoding="utf-8")
    )
    readme.write_text(cloned, encoding="utf-8")
    tools = ROOT / "docs/fmi-tools.json"
    listed = re.sub(
        r'"(\w+)": "(?:\S+?)(/blob/main/\S+)?"(?=,\n)',
        lambda found: f'"{found[1]}": "{repository or "REPOSITORY"}{found[2] or ""}"' if found[1].lower().endswith("url") else found[0],
        tools.read_text(encoding="utf-8"),
    )
    tools.write_text(listed, encoding="utf-8")


if __name__ == "__main__":
    given = [*sys.argv[1:], "", ""]
    if len(given) > 4 or "-h" in given or "--help" in given:
        raise SystemExit(__doc__)
    main(given[0], given[1])
