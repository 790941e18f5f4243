"""Uncertainty forward: bands of predictions and studies."""

import json

import brinell
import numpy as np
import pandas
import pytest
from brinell.program import run
from scipy import stats
from units import SCENES

SCENE = SCENES / "mass_known.toml"
STRENGTH = "target.yield_strength"


def test_the_band_of_a_monotone_result_ends_where_its_input_does():
    """95 % of a strength of 300 MPa +- 8 % are between 253 and 347 MPa."""
    found = brinell.predict(SCENE, uncertainty={STRENGTH: "8 %"})
    assert found.restitution == brinell.predict(SCENE).restitution
    low, high = found.bands.bands["restitution"]
    for end, sign in ((low, -1.0), (high, 1.0)):
        strength = 300e6 * (1.0 + sign * 0.08 * 1.959964)
        at_end = brinell.sweep(SCENE, {STRENGTH: f"{strength!r}:{strength * 1.001!r}:2"})
        assert end == pytest.approx(np.array(at_end["restitution"])[0], abs=5e-4)
    assert found.bands.median["restitution"] == pytest.approx(found.restitution, abs=1e-3)
    assert found.bands.shares["restitution"][STRENGTH] > 0.999


@pytest.mark.parametrize("same", ["24 MPa", 24e6, stats.norm(300e6, 24e6)])
def test_a_spread_is_the_same_however_it_is_written(same):
    one, other = (brinell.predict(SCENE, uncertainty={STRENGTH: it}).bands for it in ("8 %", same))
    assert one.bands["dent"] == pytest.approx(other.bands["dent"], rel=1e-9)


def test_a_range_is_spread_evenly_and_draws_are_kept():
    found = brinell.predict(SCENE, uncertainty={"speed": ("900 mm/s", "1.1 m/s"), "mass": "1 %"})
    speeds = found.bands.draws["speed"]
    assert speeds.min() >= 0.9 and speeds.max() <= 1.1 and len(speeds) == 1024
    assert np.histogram(speeds, 8, (0.9, 1.1))[0].tolist() == [128] * 8
    shares = found.bands.shares["energy_lost"]
    assert shares["speed"] > 0.9 > 0.1 > shares["mass"]
    assert "energy_lost: " in str(found.bands) and "speed makes" in str(found.bands)


def test_a_study_has_bands_beside_its_results(tmp_path):
    path = tmp_path / "x.parquet"
    more = {"uncertainty": {STRENGTH: "8 %"}, "output": [path, tmp_path / "x.svg"]}
    table = brinell.study(SCENE, {"speed": [0.5, 1.0]}, **more)
    one = brinell.predict(SCENE, speed=1.0, uncertainty={STRENGTH: "8 %"}).bands
    assert len(table["speed"]) == 2 and list(table[STRENGTH]) == [300e6] * 2
    for name in ("restitution", "dent"):
        found = (table[f"{name}_low"][1], table[f"{name}_high"][1])
        assert found == pytest.approx(one.bands[name], rel=0.02)
        assert found[0] < table[name][1] < found[1]
    assert pandas.read_parquet(path).equals(table)
    assert (tmp_path / "x.svg").stat().st_size > 5000


def test_a_study_spreads_around_each_value_that_varies():
    table = brinell.study(SCENE, {STRENGTH: [200e6, 800e6]}, speed=1.0, uncertainty={STRENGTH: "5 %"})
    assert np.all(table["restitution_low"] < table["restitution"])
    assert table["restitution_high"][0] < table["restitution_low"][1]


@pytest.mark.parametrize(
    ("spread", "error", "words"),
    [
        ({"target.strength": "5 %"}, brinell.UnknownName, "no parameter 'target.strength'"),
        ({STRENGTH: "5 kg"}, brinell.ProgramError, "kg is a mass"),
        ({STRENGTH: -1.0}, ValueError, "must be positive and finite"),
        ({STRENGTH: (3e8, 2e8)}, ValueError, "the first end must be below the second"),
        ({STRENGTH: [1.0, 2.0, 3.0]}, ValueError, "two ends of a range, or a distribution"),
        ({"speed": 3.0}, brinell.ContactError, "a draw is no impact (speed = -"),
    ],
)
def test_a_spread_that_can_not_be_is_told(spread, error, words):
    with pytest.raises(error) as told:
        brinell.predict(SCENE, uncertainty=spread)
    assert words in str(told.value)


def test_several_laws_have_no_bands():
    with pytest.raises(ValueError, match="leave laws out"):
        brinell.predict(SCENE, laws=["brinell"], uncertainty={STRENGTH: "5 %"})


def test_the_program_has_the_band_of_a_hardness(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(
        'name = "ball"\nimpactor = { radius = 5e-3 }\nimpact = { mass = 4e-3, speed = 1.0 }\n'
        "[target]\nyoungs_modulus = 206e9\npoissons_ratio = 0.3\n"
        'hardness = "180 HBW"\nhardening_exponent = 0.0\nrate = { model = "johnson-cook", c = 0.0 }\n'
    )
    said = json.loads(run("predict", path)[0])["laws"][0]["spread"]
    drawn = brinell.predict(path, uncertainty={STRENGTH: "8 %"}).bands.bands
    for name in ("restitution", "dent"):
        width = said[name][1] - said[name][0]
        assert np.allclose(said[name], drawn[name], atol=0.03 * width), (name, said[name], drawn[name])
