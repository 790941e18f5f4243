"""Fits: measurements that are read, parameters that are found, and what is said of them."""

import subprocess
import sys

import brinell
import matplotlib
import numpy as np
import pytest
from brinell.fits.law import LARGEST_RADIUS_RATIO
from units import SCENES

matplotlib.use("Agg")

RECORD = SCENES.parent / "data/experiment/indentation_record.csv"
SPEEDS = (0.05, 0.1, 0.2, 0.4, 0.8, 1.2, 2.0, 3.0, 5.0, 8.0)
JOHNSON_COOK = 'rate = {{ model = "johnson-cook", c = {}, reference_rate = 1.0 }}'
COWPER_SYMONDS = 'rate = {{ model = "cowper-symonds", d = {}, q = 5.0 }}'
BOTH = ("yield_strength", "hardening_modulus")


def rebounds(scene, speeds=SPEEDS, errors=0.0):
    """The program's restitutions, with errors."""
    values = np.array([brinell.predict(scene, speed=speed).restitution for speed in speeds])
    # an elastic impact may exceed 1 by its rounding
    return {"speed": speeds, "restitution": np.minimum(values + errors, 1.0)}


def loading(scene, depths):
    """The forces of the program's curve to each depth."""
    forces = [brinell.curve(scene, to=depth) for depth in depths]
    return {"depth": depths, "force": [float(it["force"].max()) for it in forces]}


def close(found, expected, tolerance):
    assert found == pytest.approx(expected, rel=tolerance)


# what is found


@pytest.mark.parametrize(("start", "strength"), [(20e6, 2e9), (5e9, 50e6), (300e6, 300e6)])
def test_a_fit_finds_the_strength_that_made_the_rebounds_wherever_it_starts(scene, start, strength):
    found = brinell.fit(scene(start), rebounds(scene(strength)))
    (estimate,) = found.estimates
    assert (estimate.name, estimate.unit) == ("target.yield_strength", "Pa")
    assert (estimate.scene, estimate.doubt) == (start, None)
    close(estimate.value, strength, 1e-6)
    low, high = estimate.interval
    assert low <= strength * (1 + 1e-6) and high >= strength * (1 - 1e-6) and high / low < 1.0001
    assert found.rms["restitution"] < 1e-9 and found.count == 10
    assert found.values == {"target.yield_strength": estimate.value}
    # 8 m/s make too wide a dent in the softest target
    wide = [note for note in found.notes if "at 1 of 10 points (speeds from 8 m/s" in note]
    assert (len(found.notes), len(wide)) == ((1, 1) if strength < 100e6 else (0, 0))


def test_a_fit_finds_the_strength_of_a_loading_curve_and_its_hardening(scene):
    depths = [2e-6 * index for index in range(1, 21)]
    points = loading(scene(400e6, "hardening_modulus = 5e9"), depths)
    start = scene(300e6)
    found = brinell.fit(start, points, BOTH)
    close(found.values["target.yield_strength"], 400e6, 1e-5)
    close(found.values["target.hardening_modulus"], 5e9, 1e-4)
    assert found.points["force, fitted"] == pytest.approx(points["force"], rel=1e-6)
    # the strength alone can't describe a target that hardens
    alone = brinell.fit(start, points)
    assert alone.values["target.yield_strength"] > 410e6 and alone.rms["force"] > 100.0 * found.rms["force"]
    assert any("follow a trend" in note for note in alone.notes)


def test_a_fit_finds_the_constant_of_a_rate_model(scene):
    points = rebounds(scene(300e6, JOHNSON_COOK.format(0.04)))
    found = brinell.fit(scene(300e6, JOHNSON_COOK.format(0.01)), points, "rate")
    assert found.estimates[0].unit == ""
    close(found.values["target.rate.c"], 0.04, 1e-5)
    points = rebounds(scene(300e6, COWPER_SYMONDS.format(8000.0)))
    found = brinell.fit(scene(300e6, COWPER_SYMONDS.format(40.4)), points, "rate")
    assert found.estimates[0].unit == "1/s"
    close(found.values["target.rate.d"], 8000.0, 1e-4)


def test_a_rate_constant_is_fitted_beside_a_power_law_and_beside_a_loss(scene):
    power = "power_law = { coefficient = 700e6, exponent = 0.2 }\n"
    for strength, more in ((None, power), (300e6, "plate_thickness = 0.01\ndensity = 7850.0\n")):
        both = [scene(strength, more + JOHNSON_COOK.format(c)) for c in (0.04, 0.02)]
        found = brinell.fit(both[1], rebounds(both[0], (0.2, 1.0, 3.0)), "rate")
        close(found.values["target.rate.c"], 0.04, 1e-5)


def test_a_slow_loading_knows_neither_rate_nor_loss(scene):
    plain, more = scene(300e6), "plate_thickness = 0.01\ndensity = 7850.0\n"
    points = loading(plain, (2e-6, 1e-5, 3e-5))
    found = brinell.fit(scene(500e6, more + JOHNSON_COOK.format(0.02)), points)
    close(found.values["target.yield_strength"], 300e6, 1e-6)


def test_the_softer_body_is_fitted_even_beyond_the_strength_of_the_other(scene):
    ball = "radius = 5e-3, youngs_modulus = 206e9, poissons_ratio = 0.3, yield_strength = {!r}"
    points = rebounds(scene(800e6, ball="radius = 5e-3, youngs_modulus = 206e9, poissons_ratio = 0.3"))
    found = brinell.fit(scene(300e6, ball=ball.format(400e6)), points)
    close(found.values["target.yield_strength"], 800e6, 1e-6)
    # the ball yields first, and bulges as no plane does
    points = rebounds(scene(1e12, ball=ball.format(800e6)))
    found = brinell.fit(scene(300e6, ball=ball.format(200e6)), points)
    close(found.values["impactor.yield_strength"], 800e6, 1e-6)


@pytest.mark.parametrize("name", ["steel_ball", "mass_known", "rough_contacts", "two_contacts"])
def test_scenes_of_every_kind_are_fitted(name):
    path = SCENES / f"{name}.toml"
    table = {"speed": [0.5, 1.0, 2.0]}
    table["restitution"] = [brinell.predict(path, speed=it).restitution for it in table["speed"]]
    found = brinell.fit(path, table)
    (estimate,) = found.estimates
    close(estimate.value, estimate.scene, 1e-6)
    assert found.rms_of_scene["restitution"] < 1e-9


def test_another_mass_takes_the_place_of_the_scenes(scene):
    speeds = (0.2, 1.0, 3.0)
    values = [brinell.predict(scene(500e6), speed=it, mass=0.1).restitution for it in speeds]
    found = brinell.fit(scene(300e6), {"speed": speeds, "restitution": values}, mass=0.1)
    close(found.values["target.yield_strength"], 500e6, 1e-6)


# how sure it is


def test_where_a_parameter_would_be_negative_the_others_are_fitted_again_with_zero(scene):
    """Once the strength, its interval and the rms were those of the negative optimum."""
    points = {"depth [um]": [5.0, 10.0, 15.0, 20.0], "force": [114.40, 257.01, 404.79, 558.65]}
    both = brinell.fit(scene(300e6), points, BOTH)
    alone = brinell.fit(scene(300e6), points)
    strength, hardening = both.estimates
    close(strength.value, 294.39e6, 1e-4)
    close(both.rms["force"], 3.878, 2e-4)
    close(both.rms_of_scene["force"], 6.236, 2e-4)
    low, high = hardening.interval
    assert hardening.value == low == 0.0 and 0.0 < high < 0.05 * 206e9
    assert "the best value would be negative" in hardening.doubt
    close(strength.value, alone.estimates[0].value, 1e-6)
    # a hardening that the points allow makes the strength smaller, but not larger
    sure = alone.estimates[0].interval
    close(strength.interval[1], sure[1], 1e-4)
    assert 0.8 * sure[0] < strength.interval[0] < sure[0]


def test_what_a_measurement_does_not_determine_is_said(scene):
    def says(words, path, points, parameters="yield_strength"):
        assert words in str(brinell.fit(path, points, parameters))

    normal, hard = scene(300e6), scene(30e9)
    # impacts below yield
    slow = rebounds(hard, (0.01, 0.02, 0.05))
    says("not determined: no restitution depends on it", hard, slow)
    says("without an interval: 1 points for 1 parameters", normal, rebounds(normal, (1.0,)))
    shallow = loading(hard, (1e-8, 2e-8, 3e-8, 4e-8))
    says("not determined: no force depends on it", hard, shallow)
    says("not determined: no force depends on it", hard, shallow, "hardening_modulus")
    # measurements of the same impact that disagree
    scattered = rebounds(normal, (1.0, 1.0, 1.0), 0.2 * np.array([-1.0, 0.0, 1.0]))
    says("hardly determined: its interval spans a factor", normal, scattered)
    # a softening target
    soft = rebounds(normal, errors=-0.01 * np.arange(10))
    says("the best value would be negative", normal, soft, "hardening_modulus")
    # strength and rate act alike at one speed
    rate = scene(300e6, JOHNSON_COOK.format(0.02))
    same = rebounds(rate, (1.0,) * 4, 0.001 * np.array([1.0, -1.0, 2.0, -2.0]))
    says("only a combination of the parameters", rate, same, ("yield_strength", "rate"))


def test_a_constant_above_those_of_scenes_is_no_value(scene):
    """Rebounds of a target that is many times as strong."""
    start = scene(30e6, JOHNSON_COOK.format(0.02))
    found = brinell.fit(start, rebounds(scene(3e9), (0.5, 1.0, 2.0)), "rate")
    (estimate,) = found.estimates
    assert estimate.value == estimate.interval[1] == 1.0
    assert "the best value would be above 1" in estimate.doubt


def test_points_that_repeat_each_other_give_no_interval(scene):
    normal = scene(300e6)
    (estimate,) = brinell.fit(normal, rebounds(normal, (1.0, 1.0, 1.0))).estimates
    assert "without an interval: 1 different points for 1 parameters" in estimate.doubt
    assert estimate.interval is None


@pytest.mark.parametrize(
    ("kind", "at", "words"),
    [
        (loading, (1e-6, 1e-5, 5e-5), None),
        (loading, (1e-5, 5e-5, 5e-4, 6e-4), "at 2 of 4 points (depths from 500 um to 600 um)"),
        (rebounds, SPEEDS, None),
        (rebounds, (1.0, 2.0, 100.0), "at 1 of 3 points (speeds from 100 m/s"),
    ],
)
def test_points_too_wide_for_the_law_are_named(scene, kind, at, words):
    normal = scene(300e6)
    notes = [it for it in brinell.fit(normal, kind(normal, at)).notes if "effective radii" in it]
    assert [words in it for it in notes] == ([] if words is None else [True])


def test_the_limit_of_the_contact_radius_is_that_of_the_program(scene):
    (warning,) = brinell.predict(scene(300e6), speed=100.0).warnings
    assert f"effective radii; above {LARGEST_RADIUS_RATIO} a sphere" in warning


# what is refused


def test_what_can_not_be_fitted_or_chosen_is_rejected_with_the_reason(scene):
    def fit(*arguments, **more):
        return lambda: brinell.fit(*arguments, **more)

    normal, rate = scene(300e6), scene(300e6, JOHNSON_COOK.format(0.02))
    speeds = {"speed": [1.0, 2.0], "restitution": [0.5, 0.4]}
    forces = {"depth [um]": [1.0, 10.0], "force": [10.0, 200.0]}
    record = {"depth [um]": [1.0, 10.0, 20.0], "force": [10.0, 200.0, 400.0]}
    power = scene(None, "power_law = { coefficient = 700e6, exponent = 0.2 }")
    for call, words in [
        (fit(normal, speeds, "rate"), "rate needs a rate model in the scene: give target.rate"),
        (fit(rate, forces, "rate"), "rate needs speeds"),
        (fit(normal, speeds, ["yield_strength"] * 2), "names yield_strength twice"),
        (fit(normal, speeds, []), "parameters is empty; expected"),
        (fit(normal, speeds, "hardness"), "'hardness' can't be fitted; expected"),
        (fit(normal, forces, mass=1.0), "mass = 1.0 has no effect"),
        (fit(scene(more='law = { loading = "hertz" }'), speeds), "the law hertz doesn't yield"),
        (
            fit(scene(more='law = { loading = "thornton" }'), speeds, "hardening_modulus"),
            'no effect on law.loading = "thornton"',
        ),
        (fit(power, speeds), "target.yield_strength follows from target.power_law"),
        (fit(normal, {"depth [m]": [1e-6, 1e7], "force": [1.0, 2.0]}), "can't be evaluated"),
        (fit(normal, speeds, "compliance"), "compliance can't be fitted here"),
        (fit(normal, speeds, "friction"), "friction needs a column"),
        (fit(normal, record, fixed={"yield_strength": 1e9}), "is free and fixed"),
        (fit(normal, record, priors={"compliance": (0.0, 1.0)}), "it is not fitted: add it"),
        (fit(normal, record, bounds={"yield_strength": (2e9, 1e9)}), "the first must be below"),
        (fit(normal, record, bounds={"yield_strength": ("1 m", 1e9)}), "yield_strength = '1 m': m is a length; a pressure has a unit"),
        (fit(normal, record, accuracy={"dent_depth": 1e-6}), "'dent_depth' was not measured; expected force"),
        (fit(normal, record, outside="drop"), "allowed are 'mark' and 'leave out'"),
    ]:  # fmt: skip
        with pytest.raises(ValueError) as error:
            call()
        assert words in str(error.value)


def test_a_bad_scene_is_told_by_the_program(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"nowhere.toml"):
        brinell.fit(tmp_path / "nowhere.toml", {"speed": [1.0], "restitution": [0.5]})


# what is shown


def test_the_guide_shows_what_its_code_prints_and_draws(tmp_path):
    page = (SCENES.parent / "docs/guide/fits.md").read_text(encoding="utf-8")
    code, text = (page.split(f"```{it}\n")[1].split("```")[0] for it in ("python", "text"))
    for name in ("scenes", "data"):
        (tmp_path / name).symlink_to(SCENES.parent / name)
    printed = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (printed.stdout, printed.stderr, printed.returncode) == (text, "", 0)
    assert "measured</text>" in (tmp_path / "fit.svg").read_text(encoding="utf-8")


def test_a_result_is_drawn_with_its_differences(scene):
    points = {"depth [um]": [5.0, 10.0, 15.0, 20.0], "force": [114.40, 257.01, 404.79, 558.65]}
    found = brinell.fit(scene(300e6), points, BOTH)
    above, below = found.plot().get_axes()
    lines = {line.get_label(): line.get_xydata() for line in above.get_lines()}
    assert lines["measured"] == pytest.approx(np.column_stack([points["depth [um]"], points["force"]]))
    assert set(lines) == {"measured", "law, scene", "law, fitted"}
    assert (below.get_xlabel(), above.get_ylabel()) == ("depth [µm]", "force [N]")
    left = points["force"] - lines["law, fitted"][:, 1]
    assert below.get_lines()[0].get_ydata() == pytest.approx(left)
    speeds = brinell.fit(scene(300e6), rebounds(scene(300e6))).plot()
    assert speeds.get_axes()[0].get_xscale() == "log"


def test_the_scene_of_a_result_predicts_what_was_fitted(scene, tmp_path):
    points = rebounds(scene(350e6, JOHNSON_COOK.format(0.03)), SPEEDS[::3])
    hard = 'hardness = "200 HBW 10/3000"\n'
    # a hardness has the rate of its own test
    own = 'rate = { model = "johnson-cook", c = 0.0 }'
    start = scene(None, hard + own)
    found = brinell.fit(start, points, ("yield_strength", "rate"))
    path = tmp_path / "fitted.toml"
    text = found.scene(path)
    assert "hardness" not in text.split("\n", 2)[2] and "# fitted: target.yield_strength" in text
    again = [brinell.predict(path, speed=it).restitution for it in points["speed"]]
    assert again == pytest.approx(points["restitution"], rel=1e-4)
    assert brinell.export(path, tmp_path / "unit.fmu").exists()


POOL = """\
name = "pool"
impactor = {{ radius = 28.575e-3, youngs_modulus = 5.84e9, poissons_ratio = 0.34 }}
target = {{ radius = 28.575e-3, youngs_modulus = 5.84e9, poissons_ratio = 0.34, yield_strength = {} }}
law = {{ loading = "brinell"{} }}
friction = {{ coefficient = {} }}
impact = {{ speed = 2.0 }}
body = [
  {{ name = "cue", mass = "170 g", inertia = 5.552e-5 }},
  {{ name = "object", mass = "170 g", inertia = 5.552e-5 }},
]
[[contact]]
name = "hit"
between = ["cue", "object"]
normal = [1, 0, 0]
tangent = [0, 1, 0]
arms = [[28.575e-3, 0, 0], [-28.575e-3, 0, 0]]
"""


def test_scenes_with_bodies_are_fitted_like_others(tmp_path):
    true, start = tmp_path / "true.toml", tmp_path / "start.toml"
    true.write_text(POOL.format("40e6", "", 0.2))
    start.write_text(POOL.format("90e6", "", 0.2))
    found = brinell.fit(start, rebounds(true, (1.0, 2.0, 4.0)))
    close(found.values["target.yield_strength"], 40e6, 1e-4)


def test_friction_of_bodies_is_fitted_with_their_masses_and_a_loss(tmp_path):
    true, start = tmp_path / "true.toml", tmp_path / "start.toml"
    loss = ", elastic_restitution = 0.95"
    true.write_text(POOL.format("1e9", loss, 0.06))
    start.write_text(POOL.format("1e9", loss, 0.2))
    angles = [20.0, 40.0, 60.0]
    table = brinell.sweep(true, {"angle": angles}, speed=2.0)
    points = {
        "angle [deg]": angles,
        "speed [m/s]": [2.0] * 3,
        "tangential restitution": table["tangential_restitution"].tolist(),
    }
    found = brinell.fit(start, points, parameters=["friction"])
    close(found.values["friction.coefficient"], 0.06, 1e-3)
    assert 'friction = { "coefficient" = 0.06' in found.scene()
