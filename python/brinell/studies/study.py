"""A study from its plan to its table."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import temporary
from ..errors import missing
from ..impacts import runs
from ..program import in_si
from ..sweeps import pandas_of
from . import plan
from .picture import draw

if TYPE_CHECKING:
    import pandas

TABLES, PICTURES = (".parquet", ".csv"), (".svg", ".png")


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
) -> pandas.DataFrame:
    """Run thousands of impacts of a scene's first contact; return a table with a row for each. Each is
    what `predict` says of the scene with its numbers.

    `vary` maps the varied quantities to their values: "speed" [m/s], "mass" [kg], and all that `sweep`
    varies along the normal. Each value is a `Range`, a text (`"0.1:10:50"`) or a list of values. Ranges
    of a decade or more are spaced logarithmically, shorter ones linearly; `"1:20:8log"` and
    `"0.1:10:8lin"` say which. `sample` is "grid", "sobol:COUNT" or "lhs:COUNT", and the runs are at
    most a million. `mass`, `speed` and `parameters` hold for all runs; the default is those of the
    scene, or what a prediction of it assumes. Numbers are in SI units, texts may have a unit: "1 m/s",
    "200 MPa:900 MPa:40". The units of the columns are in `attrs["units"]`.

    `output` names files; their extensions select the format: .parquet and .csv for the table, .svg
    and .png for a picture.

    `uncertainty` maps quantities to their spreads (see `predict`): each run is then the median of so
    many `draws`, a power of two, with the columns `restitution_low`, `restitution_high` ... between
    which 95 % of them are.

    A run that fails has its reason in the column `error`, and NaN as its results.
    """
    from .. import uncertainty as forward

    outputs = _outputs(output)
    dataframe = pandas_of("brinell.study").DataFrame
    columns = plan.runs(vary, sample, seed)
    names, count = list(columns), len(next(iter(columns.values())))
    for name, value in {"mass": mass, "speed": speed, **(parameters or {})}.items():
        if value is not None and name not in columns:
            columns[name] = np.full(count, in_si(name, value))
    if uncertainty:
        table, units = forward.banded(scene_file, columns, uncertainty, draws, seed)
    else:
        table, units = runs(scene_file, columns)
    made: pandas.DataFrame = dataframe(table)
    made.attrs["units"] = units
    for path in outputs:
        if path.suffix in PICTURES:
            draw(path, made, names)
            continue
        with temporary.draft(path) as whole:
            if path.suffix == ".csv":
                made.to_csv(whole, index=False)
            else:
                made.to_parquet(whole, index=False)
    return made


def _outputs(output: str | Path | Sequence[str | Path]) -> list[Path]:
    given = [output] if isinstance(output, str | Path) else output
    paths = [Path(path) for path in given]
    for path in paths:
        if path.suffix not in TABLES + PICTURES:
            raise ValueError(f"{path}: a study can be written to {', '.join(TABLES + PICTURES)}")
        if not path.absolute().parent.is_dir():
            raise missing("folder", path.absolute().parent)
    return paths
