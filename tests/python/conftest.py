"""Fixtures: scenes of fits and FMUs for engines."""

import itertools

import brinell
import pytest

SCENE = """
name = "{name}"
[impactor]
radius = 5e-3
[target]
material = "mild steel"
[law]
loading = "big-alabo"
unloading = "contact-radius"
{loss}
{friction}
[fmu]
outputs = ["indentation", "elastic_energy", "dissipated_energy"{outputs}]
[impact]
mass = 0.1
speed = 0.3
{coupling}
[[contact]]
name = "foot"
count = {count}
parameters_per_contact = ["initial_gap"{more}]
"""
INPUTS = '[coupling]\ninverse_masses = "input"'


@pytest.fixture(scope="module")
def unit(tmp_path_factory):
    """Exports an FMU of `count` feet that share bodies, once."""
    folder, made = tmp_path_factory.mktemp("units"), {}

    def export(count, directions=0, coupling=INPUTS, own_masses=False, loss=""):
        kind = "" if coupling == INPUTS else "_alone" if coupling else "_plain"
        name = f"feet{count}{kind}" + "_rough" * directions + "_own" * own_masses + "_lossy" * bool(loss)
        if name not in made:
            scene = folder / f"{name}.toml"
            values = {"name": name, "coupling": coupling, "count": count, "loss": loss}
            values["more"] = ', "effective_mass"' if own_masses else ""
            rough = f"[friction]\ncoefficient = 0.3\ndirections = {directions}"
            values["friction"] = rough if directions else ""
            values["outputs"] = ', "tangential_energy", "friction_work"' if directions else ""
            scene.write_text(SCENE.format(**values), encoding="utf-8")
            made[name] = brinell.export(scene, folder / f"{name}.fmu")
        return made[name]

    return export


@pytest.fixture(scope="module")
def resting(unit):
    """An FMU of one contact with a loss, so that bodies come to rest."""
    return unit(1, loss="elastic_restitution = 0.8")


ELASTIC = "youngs_modulus = 206e9\npoissons_ratio = 0.3\n"


@pytest.fixture
def scene(tmp_path):
    """A function that writes a scene file: a ball on a plane that yields, with more lines of its target, and before it."""
    count = itertools.count()

    def write(strength=300e6, target="", more="", ball="radius = 5e-3", elastic=ELASTIC):
        path = tmp_path / f"scene{next(count)}.toml"
        yields = "" if strength is None else f"yield_strength = {strength!r}\n"
        path.write_text(
            f'name = "ball"\nimpactor = {{ {ball} }}\nimpact = {{ mass = 4.11e-3, speed = 1.0 }}\n{more}\n'
            f"[target]\n{elastic}{yields}{target}\n",
            encoding="utf-8",
        )
        return path

    return write
