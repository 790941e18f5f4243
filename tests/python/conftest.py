"""Fixtures of the tests of engines."""

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

    def export(count, directions=0, coupling=INPUTS, own_masses=False):
        kind = "" if coupling == INPUTS else "_alone" if coupling else "_plain"
        name = f"feet{count}{kind}" + "_rough" * directions + "_own" * own_masses
        if name not in made:
            scene = folder / f"{name}.toml"
            values = {"name": name, "coupling": coupling, "count": count}
            values["more"] = ', "effective_mass"' if own_masses else ""
            rough = f"[friction]\ncoefficient = 0.3\ndirections = {directions}"
            values["friction"] = rough if directions else ""
            values["outputs"] = ', "tangential_energy", "friction_work"' if directions else ""
            scene.write_text(SCENE.format(**values), encoding="utf-8")
            made[name] = brinell.export(scene, folder / f"{name}.fmu")
        return made[name]

    return export


@pytest.fixture(scope="module")
def resting(tmp_path_factory):
    """An FMU of one contact with a loss, so that bodies come to rest."""
    scene = tmp_path_factory.mktemp("resting") / "resting.toml"
    values = {"name": "resting", "coupling": INPUTS, "count": 1, "more": "", "friction": "", "outputs": ""}
    text = SCENE.format(**values).replace('"contact-radius"', '"contact-radius"\nelastic_restitution = 0.8')
    scene.write_text(text, encoding="utf-8")
    return brinell.export(scene, scene.with_suffix(".fmu"))
