"""A study from its plan to its table."""

from __future__ import annotations

import multiprocessing
import os
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
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

    from .store import Parts

# The instance of a chunk takes as long as five runs, and its part of the result on the disk as long as twenty: a
# hundred runs are worth it. A chunk of a thousand loses little when its process ends.
FEWEST, MOST, CHUNKS = 100, 1000, 200
# One run [s], and what a process needs before its first one and after its last one [s], about.
RUN, PROCESS = 40e-6, 0.02
ENDINGS = (".parquet", ".csv", ".svg", ".png")
Rows = NDArray[np.float64]
Chunks = dict[int, Rows]


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
    chunk: int | None = None,
    scheduler: str | None = None,
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
    and .png for a picture. With a table among them, an interrupted study continues where it was.
    The study uses as many processes as there are cores, or fewer if it is short, or `workers`, in
    chunks of `chunk` runs. With `scheduler` it uses Dask: "local", or an address such as
    "tcp://host:8786".

    `uncertainty` maps quantities to their spreads (see `predict`): each run is then the median of so
    many `draws`, a power of two, with the columns `restitution_low`, `restitution_high` ... between
    which 95 % of them are. Such a study can't be resumed.

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
        unit, usual = _unit(Path(scene_file), Path(folder), known)
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
        workers = workers or _workers(len(drawn), scheduler)
        size = chunk or max(FEWEST, min(MOST, len(drawn) // CHUNKS))
        kept = () if uncertainty else outputs
        table = _run(library, names, drawn, size, kept, workers, scheduler, progress)
        units = UNITS | {name: _unit_of(library, name) for name in names if name not in UNITS}
    if uncertainty:
        table = forward.banded(table, rows, names, draws)
        _write(outputs, table)
    made: pandas.DataFrame = dataframe(table)
    # a band has the unit of its quantity
    plain = {name: name.removesuffix("_low").removesuffix("_high") for name in table}
    made.attrs["units"] = {name: units.get(name) or units[plain[name]] for name in table}
    for path in outputs:
        if path.suffix in (".svg", ".png"):
            from .picture import draw

            draw(path, made, list(values))
    return made


def _unit_of(library: Library, name: str) -> str:
    """The unit of a parameter."""
    return library.variables[name].unit or ""


def _write(outputs: Sequence[Path], table: Table) -> None:
    for path in outputs:
        if path.suffix in (".parquet", ".csv"):
            from . import store

            store.write(path, table)


def _outputs(output: str | Path | Sequence[str | Path]) -> list[Path]:
    given = [output] if isinstance(output, str | Path) else output
    paths = [Path(path) for path in given]
    for path in paths:
        if path.suffix not in ENDINGS:
            raise ValueError(f"{path}: a study can be written to {', '.join(ENDINGS)}")
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


def _workers(runs: int, scheduler: str | None) -> int:
    """How many processes so many runs are worth: each must save more time than it takes."""
    cores = os.cpu_count() or 1
    return cores if scheduler else max(1, min(cores, int(runs * RUN / (2.0 * PROCESS))))


def _check(library: Library, columns: Mapping[str, Rows]) -> None:
    variables = Variables(library)
    if not variables.knows_mass or len(variables.contacts) != 1:
        raise ContactError(f"{library.path}: a study needs an FMU with one contact that knows the mass")
    for name in ("effective_mass", "initial_gap", *(set(columns) - {"speed", "mass"})):
        if name not in variables.parameters:
            raise variables.unknown("parameter", name, ("speed", "mass", *variables.parameters))


def _run(
    library: Library,
    names: list[str],
    rows: Rows,
    size: int,
    outputs: Sequence[Path],
    workers: int,
    scheduler: str | None,
    progress: bool,
) -> Table:
    tables = [path for path in outputs if path.suffix in (".parquet", ".csv")]
    parts: Parts | None = None
    if tables:
        # what is on the disk takes pyarrow
        from . import store

        key = repr(names).encode() + rows.tobytes()
        key += library.description.guid.encode()
        parts = store.Parts(tables[0], key, size)
    size = parts.size if parts else size
    chunks = {at: rows[at : at + size] for at in range(0, len(rows), size)}
    done = {at: part for at, chunk in chunks.items() if parts and (part := parts.load(at, len(chunk))) is not None}
    before = sum(len(chunks[at]) for at in done)
    with _bar(len(rows), before, progress) as done_more:
        left = {at: chunk for at, chunk in chunks.items() if at not in done}
        for at, table in _results(library.path, names, left, workers, scheduler):
            done[at] = table
            if parts:
                parts.save(at, table)
            done_more(len(chunks[at]))
    whole = impacts.joined([done[at] for at in chunks])
    _write(tables, whole)
    if parts:
        parts.remove()
    return whole


@contextmanager
def _bar(runs: int, before: int, progress: bool) -> Iterator[Callable[[int], object]]:
    """A bar of so many runs, if tqdm is installed: what is called with each number of finished runs."""
    try:
        from tqdm import tqdm
    except ModuleNotFoundError:
        yield lambda count: None
        return
    with tqdm(total=runs, initial=before, unit="run", disable=not progress) as bar:
        yield bar.update


def _results(
    unit: Path, names: list[str], chunks: Chunks, workers: int, scheduler: str | None
) -> Iterator[tuple[int, Table]]:
    """The chunks as they finish. A chunk that fails is tried once more, alone."""
    if scheduler is None and (workers == 1 or len(chunks) <= 1):
        for at, rows in chunks.items():
            yield at, impacts.run(unit, names, rows)
        return
    broken = []
    with _pool(unit, workers, scheduler) as (submit, completed):
        futures = {submit(names, rows): at for at, rows in chunks.items()}
        for future in completed(futures):
            try:
                yield futures[future], future.result()
            except Exception:
                broken.append(futures[future])
    for at in broken:
        yield at, _alone(unit, names, chunks[at])


def _end_with_parent() -> None:
    """End this process with the study, which cannot tell its processes if it is killed."""

    def wait() -> None:
        parent = multiprocessing.parent_process()
        if parent is not None:
            parent.join()
            os._exit(1)

    threading.Thread(target=wait, daemon=True).start()


def _alone(unit: Path, names: list[str], rows: Rows) -> Table:
    """Run a chunk in a process of its own. If the process dies, run halves of the chunk, down to
    the run that is the reason."""
    with ProcessPoolExecutor(1, initializer=_end_with_parent) as pool:
        try:
            return pool.submit(impacts.run, unit, names, rows).result()
        except BrokenProcessPool as error:
            if len(rows) == 1:
                return impacts.failed(names, rows, f"the run has killed its process: {error}")
        except Exception as error:
            return impacts.failed(names, rows, f"the run has failed: {error!r}")
    middle = len(rows) // 2
    parts = (rows[:middle], rows[middle:])
    return impacts.joined([_alone(unit, names, part) for part in parts])


@contextmanager
def _pool(unit: Path, workers: int, scheduler: str | None) -> Iterator[tuple[Callable[..., Any], Callable[..., Any]]]:
    """A function to start a chunk, and one to wait for chunks."""
    if scheduler is None:
        pool = ProcessPoolExecutor(workers, initializer=_end_with_parent)
        try:
            yield lambda names, rows: pool.submit(impacts.run, unit, names, rows), as_completed
        finally:
            # an interrupted study does not wait for the remaining chunks
            pool.shutdown(cancel_futures=True)
        return
    from dask import distributed

    connect: Any = distributed.Client

    local = {"n_workers": workers, "threads_per_worker": 1, "dashboard_address": None}
    client = connect(**local if scheduler == "local" else {"address": scheduler})
    with client:
        # other machines do not have the file
        data = client.scatter(unit.read_bytes(), broadcast=True)
        yield (lambda names, rows: client.submit(impacts.run, data, names, rows, pure=False), distributed.as_completed)
