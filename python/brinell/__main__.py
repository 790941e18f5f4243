"""`python -m brinell study` and `fit`, and every command of the exporter: if the folder of scripts is not on
PATH, `python -m brinell export scene.toml` is the same as `brinell export scene.toml`."""

from __future__ import annotations

import argparse
import subprocess
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .errors import ContactError, ProgramError
from .fits import command_line
from .program import program
from .studies.study import study
from .workbooks import environment

if TYPE_CHECKING:
    import pandas

TOLD = 10
"""Largest number of failed runs that the command lists."""


def _arguments(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python -m brinell",
        epilog="All other arguments go to the exporter: `python -m brinell help` lists its commands.",
    )
    commands = parser.add_subparsers(dest="command", required=True)
    text = "predict thousands of impacts of a scene's first contact"
    it = commands.add_parser("study", help=text, description=text)
    add = it.add_argument
    add("scene", help="the scene file (TOML)")
    add("--vary", type=command_line.pair, action="append", required=True, metavar="NAME=FROM:TO[:COUNT]",
        help="speed, mass or another quantity of --sweep, in SI units or with a unit ('speed=10 mm/s:5 m/s:20'); or "
        "NAME=VALUE,VALUE,... Ranges of a decade or more are spaced logarithmically, shorter ones linearly; "
        "speed=1:20:8log and 0.1:10:8lin say which")  # fmt: skip
    add("--sample", default="grid", help="grid, sobol:COUNT or lhs:COUNT [default: grid]")
    add("--seed", type=int, default=0, help="seed of the samples [default: 0]")
    add("--set", type=command_line.pair, action="append", default=[], metavar="NAME=VALUE",
        help="a parameter for all runs")  # fmt: skip
    add("--uncertain", type=command_line.pair, action="append", default=[], metavar="NAME=SPREAD",
        help="a standard deviation ('5 %%', '10 MPa'); bands of the results follow")  # fmt: skip
    add("--mass", help="effective mass [kg, or with a unit], instead of the scene's")
    add("--speed", help="closing speed [m/s, or with a unit], instead of the scene's")
    add("-o", "--output", action="append", default=[], metavar="FILE",
        help=".parquet, .csv, .svg or .png; can be repeated")  # fmt: skip
    command_line.add_arguments(commands)
    return parser.parse_args(arguments)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; return the exit status."""
    arguments = sys.argv[1:] if arguments is None else arguments
    if arguments and arguments[0] not in ("study", "fit", "-h", "--help"):
        return _exporter(arguments)
    given = _arguments(arguments)
    try:
        if given.command == "fit":
            return command_line.run(given)
        table = study(
            given.scene,
            dict(given.vary),
            sample=given.sample,
            seed=given.seed,
            mass=given.mass,
            speed=given.speed,
            parameters=dict(given.set),
            uncertainty=dict(given.uncertain),
            output=given.output,
        )
    except ModuleNotFoundError as error:
        print(f"brinell: {error}: pip install 'brinell[{given.command}]'", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
    except (ContactError, ProgramError, TypeError, ValueError, OSError) as error:
        print(f"brinell: {error}", file=sys.stderr)
        return 1
    failed = table["error"] != ""
    told = np.count_nonzero(table["warning"] != "")
    print(f"{len(failed)} runs, {np.count_nonzero(failed)} failed, {told} with a warning")
    for name in ("restitution", "dent"):
        values = table[name][~failed]
        if len(values):
            print(f"{name} from {values.min():.6g} to {values.max():.6g}")
    for path in given.output:
        print(path)
    _tell(table, np.flatnonzero(failed), [name for name, _ in given.vary])
    return 0


def _tell(table: pandas.DataFrame, failed: NDArray[np.int_], names: Sequence[str]) -> None:
    """Print the first failed runs and the reasons; the table contains all of them."""
    for index in failed[:TOLD]:
        run = ", ".join(f"{name} = {table[name][index]:g}" for name in names)
        print(f"failed: {run}: {table['error'][index]}", file=sys.stderr)
    if len(failed) > TOLD:
        print(f"and {len(failed) - TOLD} more: see the column error", file=sys.stderr)


def _exporter(arguments: Sequence[str]) -> int:
    """Run the exporter; return its exit status."""
    try:
        with environment(arguments) as own:
            return subprocess.run([program(), *arguments], check=False, env=own).returncode
    except (ProgramError, OSError, ModuleNotFoundError) as error:
        print(f"brinell: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(main())
