"""Results of the exporter as numbers and arrays."""

import re
import sys
import tomllib
from xml.dom import minidom
from xml.etree import ElementTree

import brinell
import matplotlib
import numpy as np
import pytest
from brinell import ProgramError, ProgramWarning
from brinell.pictures import compact, save
from brinell.prediction import quantity
from matplotlib.figure import Figure
from units import SCENES, bounce

SCENE = SCENES / "mass_known.toml"


def test_an_exported_unit_does_what_is_predicted(tmp_path):
    path = brinell.export(SCENE, tmp_path / "made.fmu")
    assert path == tmp_path / "made.fmu"
    predicted = brinell.predict(SCENE, speed=2.0)
    with brinell.Contact(path) as made:
        assert bounce(made, speed=2.0) / 2.0 == pytest.approx(predicted.restitution, rel=1e-12)
        assert made["residual_indentation"] == pytest.approx(predicted.dent, rel=1e-12)
        assert made["max_indentation"] == pytest.approx(predicted.largest_indentation, rel=1e-12)


def test_an_export_without_a_path_goes_to_the_current_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert brinell.export(SCENE).resolve() == tmp_path / "mass_known.fmu"
    assert (tmp_path / "mass_known.fmu").is_file()


def test_the_impact_of_a_prediction():
    plain = brinell.predict(SCENE)
    assert (plain.mass, plain.speed, plain.law) == (4e-3, 1.0, "brinell/brinell")
    assert brinell.predict(SCENE, speed=1.0, mass=4e-3) == plain
    assert brinell.predict(SCENE, energy=2e-3).restitution == pytest.approx(plain.restitution)
    dropped = brinell.predict(SCENE, drop_height=0.5 / 9.80665)
    assert dropped.restitution == pytest.approx(plain.restitution)
    assert plain.onsets[0][1] < plain.onsets[-1][1]
    assert brinell.predict(SCENE, speed=100.0).warnings


def test_an_angle_makes_an_oblique_prediction():
    scene = SCENES / "oblique.toml"
    found = brinell.predict(scene, angle=30, speed=2.0)
    assert isinstance(found, brinell.ObliquePrediction)
    swept = brinell.sweep(scene, {"angle": [30.0]}, speed=2.0).iloc[0]
    for name in ("normal_restitution", "tangential_restitution", "rebound_angle", "friction_work"):
        assert getattr(found, name) == swept[name], name
    assert (found.speed, found.angle, found.spin) == (2.0, 30.0, 0.0)
    assert brinell.predict(scene, angle="0.5 rad").angle == pytest.approx(np.degrees(0.5))
    # a ball without friction keeps its speed along the surface
    smooth = brinell.predict(scene, angle=30, friction=0.0)
    assert smooth.tangential_restitution == 1.0 and smooth.rebound_spin == 0.0
    both = brinell.predict(SCENE, angle=30, spin=-50.0, friction=0.1, laws=["hertz", "thornton"])
    assert [one.law for one in both] == ["hertz", "thornton/thornton"]
    # along the normal, it is the impact without an angle
    straight = brinell.predict(scene, angle=0.0).normal_restitution
    assert straight == pytest.approx(brinell.predict(scene).restitution, rel=1e-9)


def test_what_belongs_to_an_oblique_impact_is_refused_without_an_angle():
    scene = SCENES / "oblique.toml"
    for more in ({"spin": 1.0}, {"friction": 0.3}, {"inertia": "1 g.mm^2"}):
        with pytest.raises(ValueError, match="belongs to an oblique impact"):
            brinell.predict(scene, **more)
    with pytest.raises(ValueError, match="along the normal"):
        brinell.predict(scene, angle=30, uncertainty={"speed": "5 %"})
    with pytest.raises(ProgramError, match="angle"):
        brinell.predict(scene, angle=90)


def test_a_prediction_has_the_rebound_the_contact_time_and_the_regime_by_name():
    found = brinell.predict(SCENE, drop_height="5 cm")
    assert found.rebound_speed == found.restitution * found.speed
    assert found.rebound_height == pytest.approx(0.05 * found.restitution**2, rel=1e-14)
    assert found.contact_time == found.loading_time + found.unloading_time
    assert (found.regime, found.regime_number) == ("elastoplastic (second region)", 3)
    assert [name for name, _ in found.onsets] == [
        "elastoplastic (first region)",
        "elastoplastic (second region)",
        "fully plastic",
    ]
    assert any("dent" in note for note in found.notes)


def test_a_prediction_is_a_table_in_a_notebook_and_text_in_a_terminal():
    found = brinell.predict(SCENE, speed=100.0)
    for text in (found._repr_html_(), str(found)):
        for part in ("4 g at 100 m/s", "contact time", "fully plastic", "warning:", "wave speed"):
            assert part in text, part
    html = minidom.parseString(f"<p>{found._repr_html_()}</p>")
    cells = [cell.firstChild.data for cell in html.getElementsByTagName("td")]
    assert cells[0] == "0.1315" and "13.15 m/s" in cells


@pytest.mark.parametrize(
    ("value", "unit", "words"),
    [
        (12.8175e-6, "m", "12.82 um"),
        (4e-3, "kg", "4 g"),
        (12.0, "kg", "12 kg"),
        (1500.0, "kg", "1500 kg"),
        (2e-6, "kg", "2 mg"),
        (1500.0, "m/s", "1500 m/s"),
        (-2.5e6, "N", "-2.5 MN"),
        (0.0, "m", "0 m"),
        (0.44021, "", "0.4402"),
        (float("nan"), "s", "nan s"),
        (999.96e6, "Pa", "1 GPa"),
        (12473.58, "1/s", "12470 1/s"),
        (1.5e7, "1/s", "1.5e+07 1/s"),
    ],
)
def test_quantities_in_words(value, unit, words):
    assert quantity(value, unit) == words


def test_the_version_is_that_of_the_repository():
    manifest = SCENES.parent / "Cargo.toml"
    data = tomllib.loads(manifest.read_text(encoding="utf-8"))
    assert brinell.__version__ == data["workspace"]["package"]["version"]


def test_several_laws():
    both = brinell.predict(SCENE, laws=["brinell", "hertz"])
    assert [it.law for it in both] == ["brinell/brinell", "hertz"]
    assert both[0] == brinell.predict(SCENE) and both[1].restitution == pytest.approx(1.0)
    assert len(brinell.predict(SCENE, laws=["all"])) > 15
    damped = brinell.predict(SCENES / "damped.toml")
    assert damped.dent == 0.0 and 0.0 < damped.restitution < 1.0


def test_a_sweep_is_a_table_of_predictions():
    columns = brinell.sweep(SCENE, {"speed": "0.1:10"})
    assert columns["speed"].iloc[0] == 0.1 and columns["speed"].iloc[-1] == 10.0
    middle = len(columns["speed"]) // 2
    one = brinell.predict(SCENE, speed=columns["speed"][middle])
    assert columns["restitution"][middle] == pytest.approx(one.restitution, rel=1e-14)
    assert columns["dent"][middle] == pytest.approx(one.dent, rel=1e-14)
    assert columns["largest_force"].dtype == np.float64
    assert columns["regime"][middle] == one.regime and columns["valid"].all()
    assert list(columns)[:2] == ["law", "speed"]


def test_every_column_of_a_table_has_its_unit():
    swept = brinell.sweep(SCENE, {"target.yield_strength": "2e8:4e8:2"})
    units = swept.attrs["units"]
    assert list(units) == list(swept)
    assert (units["target.yield_strength"], units["dent"], units["regime"]) == ("Pa", "m", "")
    curve = brinell.curve(SCENE)
    assert list(curve.attrs["units"]) == list(curve) and curve.attrs["units"]["force"] == "N"


def test_a_sweep_with_several_laws_has_rows_of_each():
    laws = ["hertz", "stronge"]
    swept = brinell.sweep(SCENE, {"speed": "0.1:1:5"}, laws=laws, mass=1.0)
    assert swept["law"].value_counts().tolist() == [5, 5] and swept.index.is_unique
    assert swept.groupby("law")["restitution"].min()["hertz"] == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("values", "expected"),
    [
        ([1.0, 3.0, 2.0], [1.0, 3.0, 2.0]),
        ([2.0], [2.0]),
        (np.linspace(1.0, 2.0, 3), [1.0, 1.5, 2.0]),
        (["1 m/s", "3.6 km/h"], [1.0, 1.0]),
        ("1 m/s,200 cm/s", [1.0, 2.0]),
        ("1:4 m/s:3log", [1.0, 2.0, 4.0]),
        (brinell.Range(1.0, 4.0, 3), [1.0, 2.5, 4.0]),
    ],
)
def test_a_sweep_takes_the_same_values_as_a_study(values, expected):
    assert brinell.sweep(SCENE, {"speed": values})["speed"].tolist() == pytest.approx(expected)


def test_without_pandas_a_sweep_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    for call in (
        lambda: brinell.sweep(SCENE, {"speed": "1:2:2"}),
        lambda: brinell.curve(SCENE),
        lambda: brinell.study(SCENE, {"speed": "1:2:2"}),
    ):
        with pytest.raises(ModuleNotFoundError, match="pip install pandas"):
            call()
    assert brinell.predict(SCENE).restitution > 0.0


def test_a_sweep_over_several_quantities_is_every_combination():
    vary = {"speed": "1:3:3", "target.yield_strength": "2e8:4e8:2"}
    columns = brinell.sweep(SCENE, vary, mass=8e-3)
    assert columns["speed"].tolist() == [1, 1, 2, 2, 3, 3]
    assert columns["target.yield_strength"].tolist() == 3 * [2e8, 4e8]
    alone = brinell.sweep(SCENE, {"target.yield_strength": "2e8:4e8:2"}, speed=2.0, mass=8e-3)
    assert columns["restitution"][2:4].tolist() == alone["restitution"].tolist()


def test_an_oblique_sweep_has_the_rebound_of_each_angle():
    columns = brinell.sweep(SCENES / "oblique.toml", {"angle": "10:60:3"}, speed=2.0, friction=0.1)
    assert columns["angle"].tolist() == [10.0, 35.0, 60.0]
    assert (np.diff(columns["rebound_angle"]) > 0.0).all()
    spun = brinell.sweep(SCENES / "oblique.toml", {"speed": "1:2:2"}, angle=10.0, spin=50.0)
    assert not np.array_equal(spun["rebound_spin"], [0.0, 0.0])


# pictures


def texts(path):
    return re.findall(r"<text.*?>(.*?)</text>", path.read_text(encoding="utf-8"))


def seen(svg):
    """Kind, text, style and numbers of everything in a picture."""
    root = ElementTree.fromstring(svg)
    rules = dict(re.findall(r"\.(\S+?)\{(.*?)\}", svg))
    found = []

    def look(element, group):
        style = element.get("style", rules.get(element.get("class"), group))
        kind = element.tag.rpartition("}")[2]
        if kind in ("path", "text", "use", "image"):
            place = re.sub(r"rotate\(-?0 .*?\)", "", element.get("transform", ""))
            places = " ".join(element.get(name, "") for name in ("d", "x", "y")) + place
            numbers = [float(number) for number in re.findall(r"-?[\d.]+", places)]
            looks = kind, (element.text or "").strip(), style
            # one path may have several straight lines
            straight = len(numbers) % 4 == 0 and kind == "path" and "fill: none" in style
            length = 4 if straight else max(1, len(numbers))
            parts = range(0, len(numbers), length)
            found.extend((*looks, numbers[at : at + length]) for at in parts)
        for child in element:
            if kind != "metadata":
                look(child, style)

    look(root, "")
    return sorted(found, key=lambda one: (*one[:3], *map(round, one[3])))


def test_a_picture_of_a_third_of_the_size_shows_what_matplotlib_draws(tmp_path):
    axes = Figure(layout="constrained").subplots()
    axes.plot(np.linspace(0.0, 1.0, 30), np.linspace(-3.0, 2.0, 30) ** 3, "s--", label="é < ü")
    axes.fill_between([0.0, 0.5], -1.0, [2.0, 3.0], alpha=0.3)
    axes.set(ylabel="turned", xscale="symlog")
    axes.legend()
    axes.grid()
    axes.figure.savefig(tmp_path / "large.svg")
    save(axes.figure, tmp_path / "small.svg")
    with matplotlib.rc_context({"svg.fonttype": "none", "svg.hashsalt": "brinell"}):
        axes.figure.savefig(tmp_path / "drawn.svg")
    drawn = (tmp_path / "drawn.svg").read_text(encoding="utf-8")
    for (*expected, places), (*found, rounded) in zip(seen(drawn), seen(compact(drawn)), strict=True):
        assert found == expected
        assert rounded == pytest.approx(places, abs=0.005001)
    large, small = (len((tmp_path / f"{name}.svg").read_bytes()) for name in ("large", "small"))
    assert small < large / 3


def test_a_map_over_two_quantities_and_curves_of_several_laws_are_drawn(tmp_path):
    path = tmp_path / "map.svg"
    table = brinell.sweep(SCENE, {"speed": "0.1:10:7", "target.yield_strength": "2e8:9e8:5"})
    brinell.draw(path, table, ["speed", "target.yield_strength"], ["restitution", "largest_force"])
    for label in ("speed [m/s]", "target.yield_strength [Pa]", "largest_force [N]", "restitution"):
        assert texts(path).count(label) == (2 if "." in label or "speed" in label else 1), label
    first = path.read_bytes()
    brinell.draw(path, table, ["speed", "target.yield_strength"], ["restitution", "largest_force"])
    assert path.read_bytes() == first, "the same picture has the same bytes"
    tables = brinell.sweep(SCENE, {"speed": "0.1:10:7"}, laws=["brinell", "thornton"])
    brinell.draw(path, tables, ["speed"])
    assert {"brinell/brinell", "thornton/thornton", "dent [µm]"} <= set(texts(path))


def test_angles_are_drawn_over_the_speed(tmp_path):
    path = tmp_path / "angles.svg"
    vary = {"speed": "1:4:4", "angle": "10:60:5"}
    table = brinell.sweep(SCENES / "oblique.toml", vary, friction=0.1)
    results = ["rebound_angle", "tangential_restitution", "rebound_spin"]
    brinell.draw(path, table, ["speed", "angle"], results)
    assert {"speed [m/s]", "angle [deg]", "rebound_angle [deg]", "rebound_spin [rad/s]"} <= set(texts(path))
    brinell.draw(path, table, ["angle"], results)
    brinell.draw(path, table, ["angle", "speed", "rebound_speed"], results)


@pytest.mark.parametrize(
    ("names", "results", "words"),
    [
        (["sped"], ["dent"], "'sped' is no column .did you mean 'speed'.*allowed are speed, .*dent"),
        (["speed"], ["force"], "'force' is no column"),
        (["speed"], [], "at least one name and one result"),
        (["speed"], ["regime"], "the column 'regime' has texts"),
        (["speed", "mass"], ["dent"], "a picture shows one law"),
    ],
)
def test_a_picture_that_cannot_be_drawn_is_refused(tmp_path, names, results, words):
    vary = {"speed": "1:2:2", "mass": "4e-3:5e-3:2"}
    tables = brinell.sweep(SCENE, vary, laws=["brinell", "hertz"])
    with pytest.raises(ValueError, match=words):
        brinell.draw(tmp_path / "x.svg", tables, names, results)
    assert not (tmp_path / "x.svg").exists()


def test_a_curve_is_a_table_whose_work_is_the_integral_of_the_force():
    curve = brinell.curve(SCENE, to=1e-5)
    assert curve["indentation"].max() == 1e-5
    force, work = curve["force"].to_numpy(), curve["work"].to_numpy()
    integral = np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(curve["indentation"]))
    assert work[-1] - work[0] == pytest.approx(integral, rel=1e-3)
    assert set(brinell.curve(SCENE, laws=["hertz"])["law"]) == {"hertz"}


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: brinell.predict(SCENE, speed=-1.0), "speed = -1 must be positive"),
        (lambda: brinell.predict(SCENE, mass=float("nan")), "mass"),
        (lambda: brinell.predict(SCENE, speed=1.0, energy=1.0), "cannot be used with"),
        (lambda: brinell.predict(SCENE, laws=["rubber"]), "unknown loading law `rubber`"),
        (lambda: brinell.curve(SCENE, to=-1.0), "to = -1"),
        (lambda: brinell.sweep(SCENE, {"sped": "1:2"}), "did you mean `speed`"),
    ],
)
def test_the_program_says_what_is_wrong(call, words):
    with pytest.raises(ProgramError, match=words) as error:
        call()
    assert not str(error.value).startswith(("brinell:", "building"))


@pytest.mark.parametrize(
    "call",
    [
        lambda: brinell.predict("nowhere.toml"),
        lambda: brinell.export("nowhere.toml"),
        lambda: brinell.curve("nowhere.toml"),
        lambda: brinell.sweep("nowhere.toml", {"speed": "1:2"}),
        lambda: brinell.study("nowhere.toml", {"speed": "1:2"}),
        lambda: brinell.Contact("nowhere.toml"),
        lambda: brinell.Contact("nowhere.fmu"),
        lambda: brinell.export(SCENE, "nowhere.toml/x.fmu"),
    ],
)
def test_a_file_that_is_missing_is_named(call):
    with pytest.raises(FileNotFoundError, match="there is no (scene|FMU|folder).*nowhere") as error:
        call()
    assert "nowhere" in error.value.filename


def test_what_the_program_doubts_is_a_warning_of_python_where_it_was_called(tmp_path):
    scene = tmp_path / "wide.toml"
    scene.write_text(
        'name = "wide"\nimpactor = { radius = 5 }\ntarget = { material = "mild steel" }\n'
        "[impact]\nmass = 4e-3\nspeed = 1.0\n"
    )
    calls = (
        lambda: brinell.export(scene, tmp_path / "wide.fmu"),
        lambda: brinell.predict(scene),
        lambda: brinell.sweep(scene, {"speed": "0.1:1"}),
        lambda: brinell.curve(scene),
        lambda: brinell.study(scene, {"speed": "0.1:1:2"}),
    )
    for call in calls:
        with pytest.warns(ProgramWarning, match="radius = 5 m; did you mean 5e-3") as told:
            call()
        assert len(told) == 1
        assert told[0].filename == __file__
    with pytest.warns(ProgramWarning):
        assert "did you mean 5e-3" in brinell.predict(scene).warnings[0]


def test_numbers_with_a_unit(tmp_path):
    plain = brinell.predict(SCENE, mass=4e-3, drop_height=0.05)
    assert brinell.predict(SCENE, mass="4 g", drop_height="5 cm") == plain
    swept = brinell.sweep(SCENE, {"speed": "10 mm/s:3.6 km/h:3"}, mass="4 g")
    assert swept["speed"].tolist() == brinell.sweep(SCENE, {"speed": "0.01:1:3"})["speed"].tolist()
    with pytest.raises(ProgramError, match="kg is a mass; a speed has a unit like"):
        brinell.predict(SCENE, speed="1 kg")
    scene = tmp_path / "scene.toml"
    scene.write_text(SCENE.read_text().replace("radius = 5e-3", 'radius = "5 mm"'))
    assert brinell.predict(scene) == brinell.predict(SCENE)


def test_wrong_types():
    with pytest.raises(TypeError, match="speed"):
        brinell.predict(SCENE, speed=True)
    with pytest.raises(TypeError, match="list of names"):
        brinell.predict(SCENE, laws="hertz")
    with pytest.raises(TypeError):
        brinell.sweep(SCENE, {"speed": 1.0})
    with pytest.raises(ValueError, match="a list has at most 1000, 'FROM:TO:COUNT'"):
        brinell.sweep(SCENE, {"speed": np.linspace(1.0, 2.0, 1001)})
    with pytest.raises(ValueError, match="nothing is varied"):
        brinell.sweep(SCENE, {})


def test_where_the_program_is_looked_for(monkeypatch, tmp_path):
    found = brinell.program()
    monkeypatch.setenv("BRINELL", str(tmp_path / "nothing"))
    with pytest.raises(ProgramError, match="BRINELL = .*nothing"):
        brinell.program()
    monkeypatch.delenv("BRINELL")
    (tmp_path / "brinell").symlink_to(found)
    monkeypatch.setenv("PATH", str(tmp_path))
    assert brinell.program() == tmp_path / "brinell"
