"""`python -m brinell fit SCENE DATA`."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from .fit import fit
from .parameters import PARAMETERS

PICTURES = (".svg", ".png", ".pdf")


def pair(text: str) -> tuple[str, str]:
    """The name and the value of `NAME=VALUE`."""
    name, equals, value = text.partition("=")
    if not (name and equals and value):
        raise argparse.ArgumentTypeError(f"{text!r} is not of the form NAME=VALUE")
    return name, value


def _ends(text: str) -> tuple[str, tuple[str, str]]:
    name, value = pair(text)
    first, colon, second = value.partition(":")
    if not (colon and first and second):
        raise argparse.ArgumentTypeError(f"{text!r} is not of the form NAME=A:B")
    return name, (first, second)


def _column(text: str) -> tuple[str, str]:
    # a heading may have `=` in it
    heading, equals, name = text.rpartition("=")
    if not (heading and equals and name):
        raise argparse.ArgumentTypeError(f"{text!r} is not of the form HEADING=NAME [UNIT], such as 'E2=depth [mm]'")
    return heading, name


def add_arguments(commands: Any) -> None:
    """Add the command to those of the program."""
    text = "find the parameters of a scene that explain a measurement, with confidence intervals"
    it = commands.add_parser("fit", help=text, description=text)
    add = it.add_argument
    add("scene", help="the scene file (TOML)")
    add("data", help="the measurement: CSV of any dialect, Excel or Parquet")
    add(
        "--free",
        default="yield_strength",
        metavar="NAME,NAME",
        help=f"what is fitted, of {', '.join(PARAMETERS)} [default: yield_strength]",
    )
    add("--fix", type=pair, action="append", default=[], metavar="NAME=VALUE",
        help="a value that is held, such as compliance='5 nm/N'")  # fmt: skip
    add("--bound", type=_ends, action="append", default=[], metavar="NAME=LOW:HIGH",
        help="the lowest and the largest value of a free parameter")  # fmt: skip
    add("--prior", type=_ends, action="append", default=[], metavar="NAME=MEAN:DEVIATION",
        help="what is known of a free parameter beforehand")  # fmt: skip
    add("--accuracy", type=pair, action="append", default=[], metavar="NAME=DEVIATION",
        help="standard deviation of a result, such as restitution=0.01")  # fmt: skip
    add("--column", type=_column, action="append", default=[], metavar="HEADING=NAME [UNIT]",
        help="what a column of the file is, such as 'E2=depth [mm]'; an unknown name is answered with those that exist")  # fmt: skip
    add("--decimal", choices=[".", ","], help="the decimal sign, where the file leaves it open")
    add("--laws", help="laws to try beside each other, separated by commas")
    add("--mass", type=float, help="effective mass [kg], instead of the scene's")
    add("--leave-out", action="store_true",
        help="leave out points outside the validity of the law")  # fmt: skip
    add("--no-unloading", action="store_true", help="fit the first loading of a record alone")
    add("--bootstrap", type=int, default=0, metavar="DRAWS",
        help="draws for a second kind of interval, such as 1000")  # fmt: skip
    add("-o", "--output", action="append", default=[], metavar="FILE",
        help=".toml: the scene with the fitted numbers; .svg, .png, .pdf: a picture")  # fmt: skip


def run(given: argparse.Namespace) -> int:
    """Run the command; return the exit status."""
    outputs = [Path(it) for it in given.output]
    for path in outputs:
        if path.suffix not in (".toml", *PICTURES):
            raise ValueError(f"{path}: a fit can be written to .toml, {', '.join(PICTURES)}")
    found = fit(
        given.scene,
        given.data,
        [it.strip() for it in given.free.split(",")],
        mass=given.mass,
        fixed=dict(given.fix),
        bounds=dict(given.bound),
        priors=dict(given.prior),
        accuracy=dict(given.accuracy),
        laws=[it.strip() for it in given.laws.split(",")] if given.laws else None,
        outside="leave out" if given.leave_out else "mark",
        unloading=not given.no_unloading,
        columns=dict(given.column),
        decimal=given.decimal,
        bootstrap=given.bootstrap,
    )
    print(found)
    for path in outputs:
        if path.suffix == ".toml":
            found.scene(path)
        else:
            found.plot(path)
        print(path)
    return 0
