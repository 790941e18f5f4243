#!/usr/bin/env python3
"""Makes the data set of the finite-element curves: tidy tables with their description, for an archive.

    python3 packaging/dataset.py -o FOLDER [--truth data/truth]

FOLDER gets one table for each kind of curve, a row for each point with its case; `cases.csv` says what each case is; `datapackage.json`
(Data Package 1.0) describes every column; README.md and CITATION.cff are for people. Numbers are those of the sources, digit for digit.
"""

from __future__ import annotations

import argparse
import csv
import hashlib
import json
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

# What each column is. All numbers are relative: see the texts of the tables.
COLUMNS = {
    "case": "the case, as in cases.csv",
    "from": "peak from which it is unloaded: delta/d_y of a sphere, F/F_y of a line",
    "branch": "unload, reload, or virgin: on along the loading curve",
    "delta_over_dy": "indentation (approach of the bodies) over d_y",
    "F_over_Fy": "force over F_y; smoothed over the sawtooth of the nodes",
    "F_over_Fy_raw": "the same as computed, with the sawtooth",
    "a_over_ay": "contact radius, of a line half its width, over a_y",
    "pm_over_S": "mean pressure over the yield strength",
    "depth1_over_dy": "depth of body 1 on the axis over d_y; body 2 has the rest",
    "yielded1": "integration points of body 1 that have yielded",
    "yielded2": "integration points of body 2 that have yielded",
    "d_over_R": "indentation over the radius",
    "a_over_R": "contact radius over the radius",
    "F_over_R2S": "force over R^2 S",
    "F_raw_over_R2S": "the same as computed, with the sawtooth",
    "F_coarse_over_R2S": "force over R^2 S on the coarse mesh",
    "a_coarse_over_R": "contact radius over the radius on the coarse mesh",
    "contact_node_radius_in_over_ay": "radius of the last node in contact over a_y",
    "contact_node_radius_out_over_ay": "radius of the first node out of contact over a_y",
    "E1star_over_E2star": "ratio of the plane-strain moduli",
    "S2_over_S1": "ratio of the yield strengths; inf: body 2 stays elastic",
    "H_over_E1": "hardening modulus over Young's modulus of body 1",
    "n": "elements over the contact radius",
    "x_m": "peak: delta/d_y",
    "F_m_raw": "force at the peak over F_y, as computed",
    "F_m": "the same without the sawtooth",
    "a_m": "contact radius at the peak over a_y",
    "x_f_raw": "residual depth over d_y, as computed",
    "x_f": "the same without the sawtooth",
    "dent1": "residual depth of body 1 over d_y",
    "dent2": "residual depth of body 2 over d_y",
    "W_load": "work of loading over F_y d_y",
    "W_load_smoothed": "the same from the smoothed curve",
    "W_unload": "work that comes back over F_y d_y",
    "e_raw": "coefficient of restitution, as computed",
    "e": "the same without the sawtooth",
    "F_m_over_Fy": "force at the peak over F_y",
    "a_m_over_ay": "half width at the peak over a_y",
    "flattened_radius_over_R": "radius of the flattened surface over R",
    "residual_depth_over_dy": "residual depth over d_y",
    "recovery_minus_CF_over_4": "recovered depth over d_y without the part C F/(4 F_y) of the body's size",
    "work_load_minus_CF2_over_8": "work of loading over F_y d_y without C F^2/8",
    "work_unload_minus_CF2_over_8": "work that comes back over F_y d_y without C F^2/8",
    "e_C8": "coefficient of restitution of a body with C = 8",
    "e_C10": "the same with C = 10",
    "e_C12": "the same with C = 12",
    "e_C15": "the same with C = 15",
    "gamma_pressure": "form of the pressure, 0 Hertz, 1 uniform: from the pressure",
    "gamma_recovery": "the same from the recovery",
    "gamma_work": "the same from the work",
    "gamma": "form of the pressure, 0 Hertz, 1 uniform",
    "reload_force_change": "relative change of the force at the old depth after reloading",
    "lambda1": "recovery law: first coefficient",
    "Lambda": "recovery law: second coefficient",
    "depth_minus_CF_over_4_over_dy": "depth over d_y without C F/(4 F_y)",
    "g_plastic_depth_over_dy": "g, the plastic part of the depth over d_y",
    "g_as_run": "the same as run, with the fixed half-circle of the run",
    "work_minus_CF2_over_8": "work over F_y d_y without C F^2/8",
    "work_plastic": "plastic work over F_y d_y",
    "depth_over_dy": "whole depth of the body over d_y",
    "g_raw": "g as computed",
    "g_smoothed": "g without the sawtooth",
    "F_peak": "force at the peak over F_y",
    "depth_recovered_over_dy_C10": "depth recovered since the peak over d_y, for C = 10",
    "depth_recovered_minus_C_dF_over_4": "the same without C dF/4",
    "rms_pressure_radius_over_ay": "root mean square radius of the pressure over a_y",
    "F_over_Fm": "force over that of the peak",
    "a_over_am": "half width over that of the peak",
    "x_over_ay": "place on the surface over a_y",
    "uz_peak_over_dy": "displacement of the surface at the peak over d_y, up",
    "uz_residual_over_dy": "displacement of the surface after unloading over d_y, up",
    "contact": "sphere or line",
    "bodies": "which bodies there are, and which yield",
    "strain": "small or large",
    "poissons_ratio": "of the bodies",
    "H_over_E": "hardening modulus over E; of a line, over E*",
    "Estar_over_S": "plane-strain modulus over yield strength, where the curve depends on it",
    "source": "the file in data/truth",
}
RENAMED = {"pm_over_Sy": "pm_over_S"}
WORDS = {"case", "branch", "contact", "bodies", "strain", "source"}

SPHERE = "d_y = R (3 pi 1.1 S/(4 E*))^2, F_y = (4/3) E* sqrt(R) d_y^1.5, a_y = sqrt(R d_y); 1/E* = 1/E1* + 1/E2*, S of body 1."
LINE = "p0 = 1.7937 S (nu = 0.3), F_y = pi R p0^2/E* per length, a_y = 2 R p0/E*, d_y = a_y^2/R."

# Kinds of files: their table, what it is, and what its names begin with, in this order.
KINDS = [
    ("line_unloading_summary", "Line contact: each peak and what comes back", r"line/summary_unloading"),
    ("line_width", "Line contact: half width during unloading", r"line/contact_width_unloading_"),
    ("line_profile", "Line contact: the surface at the peak and after unloading", r"line/profile_"),
    ("line_body_unloading", "Line contact of whole bodies: unloading", r"line/body_.*_unloading"),
    ("line_body_loading", "Line contact of whole bodies, plates and a roller: loading", r"line/body_"),
    ("line_unloading", "Line contact: unloading and reloading", r"line/unloading_"),
    ("line_loading", "Line contact: loading", r"line/(loading|pair)"),
    ("sphere_unloading_summary", "Two bodies: each peak and what comes back", r"pairs/summary_unloading"),
    ("sphere_on_flat", "A yielding sphere pressed by a rigid flat, in large strain: loading", r"pairs/sphere_on_rigid_flat"),
    ("sphere_unloading", "Spheres: unloading and reloading", r"(\w+/)?unloading_"),
    ("sphere_loading", "Spheres: loading", r"(\w+/)?(loading|one_body_loading)"),
]
# Those with another task: motions and friction, computed by other methods.
OTHERS = ("bodies/", "friction/")


@dataclass
class Source:
    """A file of numbers."""

    name: str
    rows: list[dict[str, str]]

    @property
    def case(self) -> str:
        """The case that the name says, without what kind of curve it is."""
        folder, _, file = self.name.rpartition("/")
        file = re.sub(r"_from_[\d.]+$|_unloading$", "", file)
        file = re.sub(r"^(contact_width_unloading|unloading|loading|profile|pair|body)(_|$)|(?<=one_body_)loading_", "", file)
        return "/".join(filter(None, [folder, file or "rigid"]))

    @property
    def is_summary(self) -> bool:
        return "summary_" in self.name

    @property
    def peak(self) -> str | None:
        found = re.search(r"_from_([\d.]+)$", self.name)
        return found and found[1]


def sources(truth: Path) -> Iterator[Source]:
    for path in sorted(truth.rglob("*.csv")):
        name = path.relative_to(truth).with_suffix("").as_posix()
        if name.startswith(OTHERS):
            continue
        lines = [line for line in path.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
        rows = [{known(column): value for column, value in row.items()} for row in csv.DictReader(lines)]
        yield Source(name, rows)


def known(column: str) -> str:
    """The name of a column in the data set."""
    name = re.sub(r"^g_as_run_.*", "g_as_run", RENAMED.get(column, column))
    if name not in COLUMNS:
        raise SystemExit(f"nothing says what the column {column} is: COLUMNS of dataset.py has the others")
    return name


def number(pattern: str, name: str, otherwise: str) -> str:
    found = re.search(pattern, name)
    return found[1] if found else otherwise


def case_of(source: Source) -> dict[str, str]:
    """What a name says of its case."""
    name = source.name
    is_line = name.startswith("line/")
    bodies = "rigid on a half-space"
    if "elastic_" in name:
        bodies = "body 1 yields, body 2 is elastic"
    elif "both_S" in name or "both_E" in name:
        bodies = "both may yield"
    elif "sphere_on" in name:
        bodies = "yielding sphere under a rigid flat"
    elif "body_" in name and "one_body" not in name:
        bodies = "rigid on a plate" if "plate" in name else "yielding roller on a rigid flat"
    large = re.search(r"large_(deformation|strain)|sphere_on|roller", name)
    return {
        "case": source.case,
        "contact": "line" if is_line else "sphere",
        "bodies": bodies,
        "strain": "large" if large else "small",
        "poissons_ratio": number(r"nu([\d.]*\d)", name, "0.3"),
        "H_over_E": number(r"_H([\d.]*\d)", name, "0"),
        "E1star_over_E2star": number(r"E1overE2_([\d.]*\d)", name, "1" if "both_S" in name else ""),
        "S2_over_S1": number(r"S2overS1_([\d.]*\d)", name, "inf" if "elastic_" in name else ""),
        "Estar_over_S": number(r"(?:_E|EsS)(\d+)(?:$|_)", name, "300" if "roller" in name else ""),
        "source": f"{name}.csv",
    }


def tables(all_sources: list[Source]) -> dict[str, tuple[str, list[dict[str, str]]]]:
    """The rows of each table, with what it is."""
    found: dict[str, tuple[str, list[dict[str, str]]]] = {name: (title, []) for name, title, _ in KINDS}
    for source in all_sources:
        kind = next((name for name, _, pattern in KINDS if re.match(pattern, source.name)), None)
        if kind is None:
            raise SystemExit(f"nothing says what kind of curve {source.name}.csv is: KINDS of dataset.py has the others")
        folder = source.name.rpartition("/")[0]
        for row in source.rows:
            case = source.case if not source.is_summary else f"{folder}/{row.get('case', 'rigid').removeprefix('pair_')}"
            peak = {} if source.peak is None else {"from": source.peak}
            found[kind][1].append({"case": case} | peak | row | {"case": case})
    return {name: (title, rows) for name, (title, rows) in found.items() if rows}


def written(path: Path, rows: list[dict[str, str]]) -> list[str]:
    """Writes rows as CSV; returns the columns."""
    columns = list(dict.fromkeys(column for row in rows for column in row))
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, columns, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    return columns


def resource(path: Path, title: str, columns: list[str]) -> dict[str, object]:
    """A table, as a data package describes it."""
    content = path.read_bytes()
    fields = [{"name": it, "type": "string" if it in WORDS else "number", "description": COLUMNS[it]} for it in columns]
    return {
        "name": path.stem,
        "path": path.name,
        "title": title,
        "profile": "tabular-data-resource",
        "format": "csv",
        "mediatype": "text/csv",
        "encoding": "utf-8",
        "bytes": len(content),
        "hash": f"sha256:{hashlib.sha256(content).hexdigest()}",
        "schema": {"fields": fields, "missingValues": [""]},
    }


TITLE = "Finite-element curves of elastoplastic contact: spheres and lines, loaded, unloaded and reloaded"
ABOUT = """Force, contact size and dent of a rigid or deformable sphere or cylinder pressed into an elastic-plastic half-space or another body,
without friction and quasi-static, by finite elements: perfectly plastic and with linear hardening, several Poisson's ratios, pairs of
bodies, small and large strain. All numbers are relative, so that one curve of small strain serves every size, modulus and strength.
The law `brinell` of Brinell is fitted to some of them, and tested against the others; nothing here is from that law."""
SPREADS = """How they were computed and how exact they are stands in the README of each folder of `data/truth` in the repository of Brinell:
force 0.1 to 0.4 % (small strain), 0.3 to 0.7 % (large strain); contact radius 0.4 to 1 %; restitution 0.0003 to 0.002."""


def readme(resources: list[dict], cases: list[dict[str, str]]) -> str:
    text = f"# {TITLE}\n\n{ABOUT}\n\n{SPREADS}\n\n"
    text += f"- Spheres: {SPHERE}\n- Lines: {LINE} C is the part of the body's size in the depth: F/(4 F_y) (C - ln(F/F_y)) + g.\n\n## Tables\n\n"
    for it in resources:
        text += f"### `{it['path']}`\n\n{it['title']}.\n\n| column | what |\n|---|---|\n"
        text += "".join(f"| `{field['name']}` | {field['description']} |\n" for field in it["schema"]["fields"]) + "\n"
    text += f"## Cases\n\n{len(cases)} cases; `cases.csv` has their numbers.\n\n"
    return text + "Made by `python3 packaging/dataset.py`. License: MIT.\n"


CITATION = f"""cff-version: 1.2.0
message: "If you use these curves, please cite them."
type: dataset
title: "{TITLE}"
version: VERSION
license: MIT
authors:
  - name: "The Brinell developers"
keywords: [contact mechanics, indentation, plasticity, finite elements, coefficient of restitution, hardness]
"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("-o", "--output", type=Path, required=True, help="a folder, which is made")
    parser.add_argument("--truth", type=Path, default=ROOT / "data/truth", help="the sources [default: data/truth]")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    version = re.search(r'^version = "(.*)"', (ROOT / "Cargo.toml").read_text(encoding="utf-8"), re.M)
    assert version, "Cargo.toml has the version"
    all_sources = list(sources(given.truth))
    # a case is named by its curve of loading, if it has one
    curves = sorted((one for one in all_sources if not one.is_summary), key=lambda one: "loading" in one.name.replace("unloading", ""))
    cases = {source.case: case_of(source) for source in curves}
    listed = [cases[case] for case in sorted(cases)]
    parts = {"cases": ("What each case is", listed)} | tables(all_sources)
    unknown = {row["case"] for _, rows in parts.values() for row in rows} - set(cases)
    if unknown:
        raise SystemExit(f"cases without a curve: {', '.join(sorted(unknown))}")
    resources = []
    for name, (title, rows) in parts.items():
        path = given.output / f"{name}.csv"
        resources.append(resource(path, title, written(path, rows)))
        print(f"{len(rows):>6} rows {path.name}")
    package = {
        "profile": "tabular-data-package",
        "name": "brinell-finite-elements",
        "title": TITLE,
        "description": ABOUT.replace("\n", " "),
        "version": version[1],
        "licenses": [{"name": "MIT", "path": "https://opensource.org/license/mit", "title": "MIT License"}],
        "keywords": ["contact mechanics", "indentation", "plasticity", "finite elements", "restitution", "hardness"],
        "resources": resources,
    }
    (given.output / "datapackage.json").write_text(json.dumps(package, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    (given.output / "README.md").write_text(readme(resources, listed), encoding="utf-8")
    (given.output / "CITATION.cff").write_text(CITATION.replace("VERSION", version[1]), encoding="utf-8")


if __name__ == "__main__":
    main()
