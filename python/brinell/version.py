"""The version of this package: that of its wheel, or of the repository."""

from __future__ import annotations

import tomllib
from importlib import metadata
from pathlib import Path

MODULE = Path(__file__).resolve().parent
"""The folder of this package."""


def installed() -> metadata.Distribution | None:
    """The wheel of this package; None if the package is used from the repository."""
    try:
        distribution = metadata.distribution("brinell")
    except metadata.PackageNotFoundError:
        return None
    is_here = Path(str(distribution.locate_file("brinell"))).resolve() == MODULE
    return distribution if is_here else None


def version() -> str:
    """The version, as in `0.1.0`."""
    distribution = installed()
    if distribution is not None:
        return distribution.version
    manifest = MODULE.parents[1] / "Cargo.toml"
    if not manifest.is_file():
        return "unknown"
    data = tomllib.loads(manifest.read_text(encoding="utf-8"))
    return str(data["workspace"]["package"]["version"])
