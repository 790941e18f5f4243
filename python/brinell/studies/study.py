"""A study from its plan to its table."""

from __future__ import annotations

import multiprocessing
import os
import threading
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .. import temporary
from ..errors import ContactError, missing
from ..library import Library
from ..program import in_si
from ..sweeps import pandas_of
from ..variables import Variables
from . import impacts, plan, scene
from .impacts import UNITS, Table

if TYPE_CHECKING:
    import pandas

# The instance of a chunk takes as long as five runs: a hundred runs are worth it. A bar moves with each chunk.
FEWEST, MOST, CHUNKS = 100, 1000, 200
# One run [s], and what a process needs before its first one and after its last one [s], about.
RUN, PROCESS = 40e-6, 0.02
TABLES, PICTURES = (".parquet", ".csv"), (".svg", ".png")
Rows = NDArray[np.float64]


def study(
    scene_file: str | Path,
    vary: Mapping[str, plan.Varied],
    *,
    sample: str = "grid",
    seed: int = 0,
    mass: float | str | None = None,
    speed: float | str | None = None,
    parameters: Mapping[str, float | str] | None = None,
    uncertainty: Mapping[str, Any] | None = None,
    draws: int = 128,
    output: str | Path | Sequence[str | Path] = (),
    workers: int | None = None,
    progress: bool = True,
) -> pandas.DataFrame:
    """Run thousands of impacts of a scene's first contact; return a table with a row for each.

    `vary` maps the varied quantities to their values: "speed" [m/s], "mass" [kg], and any parameter
    of the FMU. Each value is a `Range`, a text (`"0.1:10:50"`) or a list of values. Ranges of a
    decade or more are spaced logarithmically, shorter ones linearly; `"1:20:8log"` and
    `"0.1:10:8lin"` say which. `sample` is "grid", "sobol:COUNT" or "lhs:COUNT". `mass`, `speed` and
    `parameters` hold for all runs; the default is those of the scene, where a solid ball has the mass
    of its density. Numbers are in SI units, texts may have a unit: "1 m/s", "200
    MPa:900 MPa:40". The units of the columns are in `attrs["units"]`.

    `output` names files; their extensions select the format: .parquet and .csv for the table, .svg
    and .png for a picture. The study uses as many processes as there are cores, or fewer if it is
    short, or `workers`.

    `uncertainty` maps quantities to their spreads (see `predict`): each run is then the median of so
    many `draws`, a power of two, with the columns `restitution_low`, `restitution_high` ... between
    which 95 % of them are.

    A run that fails has its reason in the column `error`, and NaN as its results.
    """
    from .. import uncertainty as forward

    outputs = _outputs(output)
    dataframe = pandas_of("brinell.study").DataFrame
    values = plan.runs(vary, sample, seed)
    mass, speed = (
        None if number is None else in_si(name, number) for name, number in (("mass", mass), ("speed", speed))
    )
    fixed = {name: in_si(name, number) for name, number in (parameters or {}).items()}
    with temporary.folder() as folder:
        known = mass if mass is not None or "mass" not in values else float(values["mass"][0])
        unit, usual = _unit(Path(scene_file), folder, known)
        usual |= {"speed": speed} if speed is not None else {}
        usual |= {"mass": mass} if mass is not None else {}
        columns = _columns(values, {**usual, **fixed})
        # in memory until the end: processes that are forked have it without unpacking it again
        library = Library.of(unit)
        with scene.naming(scene_file, unit.name):
            if uncertainty:
                known_names = dict.fromkeys(columns, 0.0)
                for name, value in forward.centres(library, known_names, uncertainty).items():
                    columns.setdefault(name, np.full(len(next(iter(columns.values()))), value))
            _check(library, columns)
        names, rows = list(columns), np.column_stack(list(columns.values()))
        drawn = forward.spread(names, rows, uncertainty, draws, seed) if uncertainty else rows
        table = _run(library.path, names, drawn, workers or _workers(len(drawn)), progress)
        units = UNITS | {name: _unit_of(library, name) for name in names if name not in UNITS}
    if uncertainty:
        table = forward.banded(table, rows, names, draws)
    made: pandas.DataFrame = dataframe(table)
    # a band has the unit of its quantity
    plain = {name: name.removesuffix("_low").removesuffix("_high") for name in table}
    made.attrs["units"] = {name: units.get(name) or units[plain[name]] for name in table}
    for path in outputs:
        with temporary.draft(path) as whole:
            if path.suffix in PICTURES:
                from .picture import draw

                draw(whole, made, list(values))
            elif path.suffix == ".csv":
                made.to_csv(whole, index=False)
            else:
                made.to_parquet(whole, index=False)
    return made


def _unit_of(library: Library, name: str) -> str:
    """The unit of a parameter."""
    return library.variables[name].unit or ""


def _outputs(output: str | Path | Sequence[str | Path]) -> list[Path]:
    given = [output] if isinstance(output, str | Path) else output
    paths = [Path(path) for path in given]
    for path in paths:
        if path.suffix not in TABLES + PICTURES:
            raise ValueError(f"{path}: a study can be written to {', '.join(TABLES + PICTURES)}")
        if not path.absolute().parent.is_dir():
            raise missing("folder", path.absolute().parent)
    return paths


def _unit(path: Path, folder: Path, mass: float | None) -> tuple[Path, dict[str, float]]:
    if path.suffix == ".fmu":
        return path, {}
    return scene.unit(path, folder, mass)


def _columns(values: Mapping[str, Rows], usual: Mapping[str, float]) -> dict[str, Rows]:
    """The values of all runs; speed and mass, which every run has, come first."""
    count = len(next(iter(values.values())))
    fixed = {name: np.full(count, float(value)) for name, value in usual.items()}
    columns = {**fixed, **values}
    for name in ("speed", "mass"):
        if name not in columns:
            raise ValueError(f"{name} is needed: the scene has none; pass {name}= (--{name}), or vary it")
    return columns


def _workers(runs: int) -> int:
    """How many processes so many runs are worth: each must save more time than it takes."""
    return max(1, min(os.cpu_count() or 1, int(runs * RUN / (2.0 * PROCESS))))


def _check(library: Library, columns: Mapping[str, Rows]) -> None:
    variables = Variables(library)
    if not variables.knows_mass or len(variables.contacts) != 1:
        raise ContactError(f"{library.path}: a study needs an FMU with one contact that knows the mass")
    for name in ("effective_mass", "initial_gap", *(set(columns) - {"speed", "mass"})):
        if name not in variables.parameters:
            raise variables.unknown("parameter", name, ("speed", "mass", *variables.parameters))


def _run(unit: Path, names: list[str], rows: Rows, workers: int, progress: bool) -> Table:
    size = max(FEWEST, min(MOST, len(rows) // CHUNKS))
    chunks = [rows[at : at + size] for at in range(0, len(rows), size)]
    one, tables = partial(impacts.run, unit, names), list[Table]()
    with _bar(len(rows), progress) as bar, _mapped(workers if len(chunks) > 1 else 1) as mapped:
        for table in mapped(one, chunks):
            tables.append(table)
            bar(len(table["speed"]))
    return {name: np.concatenate([table[name] for table in tables]) for name in tables[0]}


@contextmanager
def _mapped(workers: int) -> Iterator[Any]:
    """`map`, by so many processes."""
    if workers == 1:
        yield map
        return
    pool = ProcessPoolExecutor(workers, initializer=_end_with_parent)
    try:
        yield pool.map
    finally:
        # an interrupted study does not wait for the remaining chunks
        pool.shutdown(cancel_futures=True)


def _end_with_parent() -> None:
    """End this process with the study, which cannot tell its processes if it is killed."""

    def wait() -> None:
        parent = multiprocessing.parent_process()
        if parent is not None:
            parent.join()
            os._exit(1)

    threading.Thread(target=wait, daemon=True).start()


@contextmanager
def _bar(runs: int, progress: bool) -> Iterator[Any]:
    """A bar of so many runs, if tqdm is installed: what is called with each number of finished runs."""
    try:
        from tqdm import tqdm
    except ModuleNotFoundError:
        yield lambda count: None
        return
    with tqdm(total=runs, unit="run", disable=not progress) as bar:
        yield bar.update
