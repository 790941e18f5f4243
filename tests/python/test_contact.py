"""One contact: steps, values, forces, errors, and the end of its life."""

import copy
import gc
import os
import pickle
import shutil
import warnings
from pathlib import Path

import brinell
import numpy as np
import pytest
from brinell import Contact, ContactError, ContactWarning, ProgramError, UnknownName
from units import SCENES, UNITS, bounce, contact

RESTITUTION = 0.4402119478536266  # of 4 g at 1 m/s, by the balance of energies


@pytest.mark.parametrize("h", [1e-6, 1e-5, 1e-4, 1e-3, 1.0])
@pytest.mark.parametrize("gap", [0.0, 1e-6, 3e-4])
def test_a_unit_that_knows_the_mass_is_right_at_any_step(h, gap):
    with contact("mass_known", initial_gap=gap) as made:
        steps = int((gap + 1e-4) / h) + 2
        assert bounce(made, h=h, steps=steps) == pytest.approx(RESTITUTION, rel=1e-10)


def explicit(steps, **arguments):
    """Restitution with an importer that moves the mass itself, with a fraction of the contact time as its step size."""
    h, mass, speed, last = 2.866e-5 / steps, 4e-3, 1.0, 0.0
    derivatives = arguments.pop("derivatives", False)
    with contact("coupled", initial_gap=1.5 * h, **arguments) as made:
        for _ in range(2 * steps):
            force = made.step(h, speed, -last / mass) if derivatives else made.step(h, speed)
            speed -= h * force / mass
            last = made["force"]
    return -speed


def test_the_force_that_is_chosen_by_itself_is_the_better_one():
    def error(**arguments):
        return abs(explicit(256, **arguments) / RESTITUTION - 1.0)

    assert error() == error(force="end") < 1e-3 < error(force="mean")
    assert error(derivatives=True) == error(derivatives=True, force="mean")
    assert error(derivatives=True) < 0.1 * error(derivatives=True, force="end")


def test_the_force_is_the_one_that_is_asked_for():
    for force, output in [("end", "force"), ("mean", "mean_force")]:
        with contact("coupled", force=force) as made:
            assert made.step(1e-6, 1.0) == made[output] > 0.0
            assert made.step(1e-6, 1.0, 2.0, 3.0) == made[output]
        with contact("mass_known", force=force) as made:
            assert made.step(1e-5, 1.0) == made[output] > 0.0
    with pytest.raises(ValueError, match="'auto', 'mean' and 'end'"):
        contact("coupled", force="middle")


def test_a_unit_without_the_force_that_is_asked_for_says_what_its_scene_needs():
    with pytest.raises(ContactError, match="outputs under .fmu."):
        contact("steel_ball", force="mean")


def test_a_unit_whose_force_belongs_to_the_next_step_is_used_knowingly_or_not_at_all():
    library = brinell.library.Library.of(UNITS["mass_known"])
    variable = library.variables["mean_force"]
    text = variable.description
    variable.description = "Force to apply to the bodies over the next step, held constant"
    try:
        with pytest.raises(ContactError, match='master = "serial" under .coupling.'):
            contact("mass_known")
        with contact("mass_known", force="mean") as made:
            assert made.step(1e-5, 1.0) > 0.0
    finally:
        variable.description = text


def test_which_units_know_the_mass():
    known = {name for name in UNITS if contact(name, force="end").knows_mass}
    assert known == {"mass_known", "two", "each", "nothing_settable", "feet", "stack"}


def test_derivatives_of_the_rate_reach_the_unit():
    with contact("coupled") as made:
        made.step(1e-5, 1.0, -3e4, 5e9)
        way = 1e-5 - 3e4 * 1e-10 / 2 + 5e9 * 1e-15 / 6
        assert made["indentation"] == pytest.approx(way, rel=1e-13)
        made.step(1e-5, 0.0, jerk=5e9)
        assert made["indentation"] == pytest.approx(way + 5e9 * 1e-15 / 6, rel=1e-13)
    with contact("mass_known") as made, pytest.raises(ContactError, match="order 2"):
        made.step(1e-5, 1.0, 0.0, 1.0)


def test_output_derivatives():
    with contact("coupled") as made:
        made.step(1e-6, 1.0)
        slope, curvature = made.derivative(), made.derivative("force", 2)
        before = made["force"]
        made.step(1e-9, 1.0)
        assert (made["force"] - before) / 1e-9 == pytest.approx(slope, rel=1e-3)
        assert np.isfinite(curvature)
        with pytest.raises(UnknownName, match="indentation, max_indentation"):
            made.derivative("indentation_rate")
        with pytest.raises(ContactError, match="order 3"):
            made.derivative("force", 3)


def test_parameters_by_keyword_and_by_name():
    for arguments in [
        {"target_yield_strength": 4e8},
        {"parameters": {"target.yield_strength": 4e8}},
        {"parameters": {"target.yield_strength": np.float64(4e8)}},
        {"target_yield_strength": 400_000_000},
    ]:
        with contact("steel_ball", **arguments) as made:
            assert made["target.yield_strength"] == 4e8
    with contact("steel_ball", initial_gap=-1e-5) as made:
        assert made["indentation"] == 1e-5 and made["force"] > 0.0


@pytest.mark.parametrize(
    "arguments", [{"yield_strength": 1.0}, {"parameters": {"target.hardness": 1.0}}, {"mass": 1.0}]
)
def test_an_unknown_parameter_names_those_that_there_are(arguments):
    with pytest.raises(KeyError, match="target.yield_strength, initial_gap"):
        contact("steel_ball", **arguments)
    with contact("steel_ball") as made, pytest.raises(UnknownName, match="no parameter"):
        made.reset(**arguments)


def test_a_constant_is_no_parameter():
    with pytest.raises(UnknownName, match="there are: none"):
        contact("nothing_settable", initial_gap=1.0)


@pytest.mark.parametrize("value", [0.0, -1.0, float("nan"), float("inf"), 1e30])
def test_a_refused_parameter_is_told_in_the_words_of_the_unit(value):
    with pytest.raises(ContactError, match="target.yield_strength"):
        contact("steel_ball", target_yield_strength=value)


def test_values_by_name():
    with contact("regime") as made:
        made.step(1e-6, 1.0)
        assert made["indentation"] == 1e-6 and isinstance(made["regime"], int)
        assert set(made.outputs) | set(made.parameters) | {"indentation_rate"} == {
            name for name in [*made.outputs, *made.parameters, "indentation_rate"] if made[name] is not None
        }
        for name in ("depth", "", 3, None):
            with pytest.raises(KeyError, match="there are: indentation_rate, force, indentation"):
                made[name]


STEPS = [("1", 1.0), (None, 1.0), (object(), 1.0)]
STEPS += [(1e-6, rate) for rate in ("1", None, [1.0, 2.0], {}, True, 1j)] + [(1e-6, 1.0, "x"), (1e-6, 1.0, 0.0, b"x")]


@pytest.mark.parametrize("step", STEPS)
def test_wrong_types_are_refused_before_anything_happens(step):
    with contact("coupled") as made:
        with pytest.raises(TypeError, match="h|rate|acceleration|jerk"):
            made.step(*step)
        assert made.time == 0.0
        made.step(1e-6, 1.0)
        assert made["indentation"] == 1e-6


REFUSED = [((h, 1.0), "StepSize") for h in (0.0, -1.0, float("nan"), float("inf"))]
REFUSED += [((1e-6, *more), "indentation_rate") for more in ((float("nan"),), (float("inf"),), (1.0, float("nan")))]


@pytest.mark.parametrize(("step", "words"), REFUSED)
def test_a_refused_step_is_told_in_the_words_of_the_unit_and_reset_mends_it(step, words):
    with contact("coupled") as made:
        with pytest.raises(ContactError, match=words) as refused:
            made.step(*step)
        assert "contact.reset()" in str(refused.value)
        made.reset()
        assert made.time == 0.0 and made.step(1e-6, 1.0) > 0.0


def test_numbers_of_all_kinds():
    for number in (1, 1.0, np.float32(1.0), np.int64(1), np.array(1.0)):
        with contact("steel_ball") as made:
            made.step(1e-6, number)
            assert made["indentation"] == 1e-6


def test_reset_keeps_parameters_or_replaces_them():
    with contact("steel_ball", initial_gap=1e-6, target_yield_strength=4e8) as made:
        made.step(1e-5, 1.0)
        made.reset()
        assert (made.time, made["indentation"], made["target.yield_strength"]) == (0.0, -1e-6, 4e8)
        made.reset(initial_gap=2e-6, parameters={"target.yield_strength": 5e8})
        assert (made["indentation"], made["target.yield_strength"]) == (-2e-6, 5e8)
        with pytest.raises(ContactError, match="yield_strength"):
            made.reset(target_yield_strength=-1.0)
        made.reset()
        assert made["target.yield_strength"] == 5e8


def test_warnings_of_the_unit_are_warnings_of_python_where_the_step_is_called():
    with contact("steel_ball") as made:
        with pytest.warns(ContactWarning, match="contact radius|wave speed") as told:
            made.step(1e-5, 100.0)
        assert all(Path(one.filename).name == "test_contact.py" for one in told)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            made.step(1e-6, 100.0)  # each is told once
    with contact("steel_ball") as made, warnings.catch_warnings():
        warnings.simplefilter("error", ContactWarning)
        with pytest.raises(ContactWarning):
            made.step(1e-5, 100.0)


def test_a_mass_that_cannot_be_set_says_so():
    with contact("steel_ball") as made, pytest.raises(ContactError, match="no effective_mass") as told:
        made.step(1e-6, 1.0, mass=1.0)
    assert "contact.reset()" not in str(told.value)  # nothing was refused by the FMU
    with contact("mass_known") as made:
        if not made.mass_is_settable:
            with pytest.raises(ContactError, match="fixed once a simulation has started"):
                made.step(1e-6, 1.0, mass=1.0)
        made.reset(effective_mass=8e-3)
        # the same energy causes the same dent
        speed = 0.5**0.5
        assert bounce(made, mass=8e-3, speed=speed) == pytest.approx(RESTITUTION * speed, rel=1e-9)


def test_a_mass_that_can_be_set_between_steps_counts_from_the_next_step():
    with contact("mass_known", initial_gap=1e-4) as made:
        if not made.mass_is_settable:
            pytest.skip("effective_mass of the unit is a fixed parameter")
        made.step(5e-5, 1.0)
        speed = 0.5**0.5
        force = made.step(1e-3, speed, mass=8e-3)
        assert 1e-3 * force / 8e-3 - speed == pytest.approx(RESTITUTION * speed, rel=1e-9)
        with pytest.raises(TypeError):
            made.step(1e-3, 1.0, mass="8 g")
        with pytest.raises(TypeError):
            made.step(1e-3, 1.0, mass=[1.0, 2.0])
        with pytest.raises(ContactError, match="effective_mass"):
            made.step(1e-3, 1.0, mass=-1.0)


def test_a_contact_that_cannot_touch_goes_where_the_bodies_are():
    for name in ("mass_known", "coupled"):
        with contact(name, initial_gap=1e-3) as made:
            # the simulation starts at 5 mm, and the step moves the bodies 1.5 mm closer
            assert made.step(1e-3, 1.0, 1e3, gap=5e-3) == 0.0
            assert made["indentation"] == pytest.approx(-3.5e-3, rel=1e-14)
            made.step(1e-3, -1.0, gap=np.float64(1e-3))
            assert made["indentation"] == pytest.approx(-2e-3, rel=1e-14)
    with contact("coupled", initial_gap=1e-3) as made:
        made.step(1e-3, 1.0, 1e3, 3e6, gap=5e-3)
        assert made["indentation"] == pytest.approx(-3e-3, rel=1e-14)


@pytest.mark.parametrize("gap", [0.5e-3, 1e-3, 0.0, -1.0])
def test_a_contact_that_may_touch_goes_its_own_way(gap):
    with contact("mass_known", initial_gap=3e-4) as made, contact("mass_known", initial_gap=3e-4) as plain:
        assert made.step(1e-3, 1.0, gap=gap) == plain.step(1e-3, 1.0) > 0.0
        assert made["indentation"] == plain["indentation"]


def test_a_contact_that_pushes_goes_its_own_way():
    with contact("coupled", initial_gap=-1e-5) as made:
        made.step(1e-6, -1.0, gap=1.0)
        assert made["indentation"] == pytest.approx(9e-6, rel=1e-14)


@pytest.mark.parametrize("gap", ["1", [1.0, 2.0], None.__class__])
def test_a_gap_is_a_number(gap):
    with contact("coupled") as made:
        with pytest.raises(TypeError, match="gap"):
            made.step(1e-6, 1.0, gap=gap)
        assert made.time == 0.0
    with contact("without_indentation") as made, pytest.raises(KeyError, match="'indentation'"):
        made.step(1e-6, 1.0, gap=1.0)


def test_files_that_are_no_units(tmp_path):
    with pytest.raises(FileNotFoundError, match="no FMU.*nowhere.fmu"):
        Contact(tmp_path / "nowhere.fmu")
    with pytest.raises(FileNotFoundError):
        Contact(tmp_path)
    (tmp_path / "text.fmu").write_text("not a zip")
    with pytest.raises(ContactError, match="text.fmu: it is no zip archive"):
        Contact(tmp_path / "text.fmu")
    with pytest.raises(TypeError):
        Contact(3)


def test_a_scene_is_exported_and_loaded():
    scene = SCENES / "mass_known.toml"
    with brinell.Contact(scene) as made, contact("mass_known") as known:
        assert made.path == scene and "mass_known.toml" in repr(made)
        assert bounce(made).hex() == bounce(known).hex()
        with brinell.Contact(scene, target_yield_strength="400 MPa") as again:
            assert again._instance.library is made._instance.library, "loaded once"


def test_parameters_are_texts_with_a_unit():
    texts = {"target_yield_strength": "400 MPa", "initial_gap": "5 um"}
    with contact("steel_ball", **texts) as made:
        assert made["target.yield_strength"] == 4e8 and made["indentation"] == -5e-6
        made.reset(parameters={"target.yield_strength": "0.5 GPa"})
        assert made["target.yield_strength"] == 5e8
        with pytest.raises(ProgramError, match="target.yield_strength = 4 kg: kg is a mass"):
            made.reset(target_yield_strength="4 kg")
    gaps = [f"{index} um" for index in range(20)]
    with contact("each", initial_gap=gaps, effective_mass="4 g") as bed:
        assert bed["indentation"] == pytest.approx(-1e-6 * np.arange(20), abs=1e-18)
        assert set(bed["effective_mass"]) == {4e-3}


def test_an_unknown_name_tells_the_nearest():
    with contact("steel_ball") as made:
        with pytest.raises(UnknownName, match="'indentatoin' .did you mean 'indentation'"):
            made["indentatoin"]
        with pytest.raises(UnknownName, match="did you mean 'target.yield_strength'"):
            made.reset(target_yeild_strength=4e8)
        with pytest.raises(UnknownName, match="no variable 'xyz'; there are"):
            made["xyz"]


def test_a_unit_that_is_exported_again_is_another_one(tmp_path):
    path = tmp_path / "unit.fmu"
    shutil.copy(UNITS["steel_ball"], path)
    with Contact(path) as first:
        os.remove(path)
        shutil.copy(UNITS["mass_known"], path)
        with Contact(path) as second:
            assert not first.knows_mass and second.knows_mass
            assert first.step(1e-6, 1.0) > 0.0


def test_after_the_end_every_use_is_refused():
    made = contact("coupled")
    state = made.save()
    assert not made.closed
    made.close()
    made.close()
    assert made.closed and "closed" in repr(made)
    for use in (
        lambda: made.step(1e-6, 1.0),
        lambda: made["force"],
        lambda: made.save(),
        lambda: made.restore(state),
        lambda: made.reset(),
        lambda: made.derivative(),
        lambda: made.__enter__(),
    ):
        with pytest.raises(ContactError, match="is closed"):
            use()


def test_a_with_block_closes_also_after_an_error():
    with pytest.raises(ZeroDivisionError), contact("coupled") as made:
        raise ZeroDivisionError
    assert made.closed


def test_a_contact_is_not_copied():
    made = contact("coupled")
    for way in (copy.copy, copy.deepcopy, pickle.dumps):
        with pytest.raises(TypeError, match="save"):
            way(made)


def test_nothing_is_left_on_disk(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    path = tmp_path / "copy.fmu"
    shutil.copy(UNITS["damped"], path)
    with Contact(path) as made:
        made.step(1e-6, 1.0)
    del made
    gc.collect()
    assert list(tmp_path.iterdir()) == [path]
