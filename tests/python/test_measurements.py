"""Measurements for fits: files of any dialect, recognised columns, units, and what is refused."""

import warnings

import brinell
import numpy as np
import pandas
import pytest
from brinell.fits.measured import measured
from units import SCENES

DATA = SCENES.parent / "data/experiment"


def read(tmp_path, text, **more):
    path = tmp_path / "m.csv"
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return measured(path, **more)


def said(found):
    return " ".join(found.notes)


@pytest.mark.parametrize(
    "text",
    [
        "speed,restitution\n2,0.5\n1,0.6\n",
        "Machine X\nDate;2024\nspeed;restitution\nmm/s;-\n2000;0,50\n1000;0,60\n",
        "drop height [mm],rebound height [mm]\n203.943243,50.985811\n50.985811,18.354892\n",
        "speed,rebound speed [mm/s]\n2,1000\n1,600\n",
    ],
)
def test_rebounds_are_the_same_however_they_were_measured(tmp_path, text):
    found = read(tmp_path, text)
    assert found.kind == "impacts"
    assert found.arguments["speed"] == pytest.approx([1.0, 2.0], rel=1e-8)
    assert found.results["restitution"] == pytest.approx([0.6, 0.5], rel=1e-8)


def test_a_number_that_may_be_thousands_is_asked_about(tmp_path):
    text = "depth [um];force\n1;1.082\n2;2.164\n"
    with pytest.raises(ValueError, match="is ambiguous: .* Pass decimal="):
        read(tmp_path, text)
    assert read(tmp_path, text, decimal=".").results["force"].min() == pytest.approx(1.082)


def test_what_is_read_and_what_is_not_is_said(tmp_path):
    found = read(tmp_path, "Report 7\nspeed [mm/s];drop height [m];e;operator;force\n1000;1;0,5;ann;3\n")
    words = said(found)
    for expected in (
        "Before the heading in line 2, 1 line was passed over",
        "separated by semicolons, with a decimal comma",
        "`speed [mm/s]` is speed in mm/s",
        "`e` is restitution",
        "The column `operator` is unknown and was not used",
        "The column `drop height [m]` was not used",
        "The column `force` was not used",
    ):
        assert expected in words


def test_excel_parquet_and_frames_are_read_alike(tmp_path):
    frame = pandas.DataFrame({"depth [um]": [8.0, 12.0], "force [kN]": [0.2, 0.3]})
    frame.to_parquet(tmp_path / "m.parquet")
    with pandas.ExcelWriter(tmp_path / "m.xlsx") as book:
        pandas.DataFrame({"x": [1]}).to_excel(book, sheet_name="notes")
        above = pandas.DataFrame([["Machine X", None], ["depth", "force"], ["um", "kN"]])
        table = pandas.concat([above, pandas.DataFrame([[8.0, 0.2], [12.0, 0.3]])])
        table.to_excel(book, sheet_name="data", header=False, index=False)
    for source in (
        frame,
        {name: frame[name].to_numpy() for name in frame},
        tmp_path / "m.parquet",
        tmp_path / "m.xlsx",
    ):
        found = measured(source)
        assert found.arguments["depth"] == pytest.approx([8e-6, 12e-6])
        assert found.results["force"] == pytest.approx([200.0, 300.0])
    assert "The sheet data was read; others: notes." in said(found)


@pytest.mark.parametrize(
    "text",
    [
        "time [s],bounce interval [s]\n0.0,0.2501\n0.2501,0.2484\n0.4985,0.2468\n0.7453,0.2452\n",
        "flight time [ms]\n250.1\n248.4\n246.8\n245.2\n",
        "bounce time [s]\n0\n0.2501\n0.4985\n0.7453\n0.9905\n",
        # two drops
        "n,interval [s]\n1,0.2501\n2,0.2484\n3,\n1,0.2484\n2,0.2468\n3,0.2452\n",
    ],
)
def test_the_flights_of_a_ball_that_bounces_are_impacts(tmp_path, text):
    """v = g T/2, e = T'/T."""
    found = read(tmp_path, text)
    flights = np.array([0.2468, 0.2484, 0.2501])
    assert found.arguments["speed"] == pytest.approx(0.5 * 9.80665 * flights)
    assert found.results["restitution"] == pytest.approx([0.99352, 0.99356, 0.99320], abs=1e-5)


def test_a_tensile_test_in_a_workbook_is_that_of_its_text(tmp_path):
    rows = [
        ["Cross-section", 7.5, "mm2", None], ["Gage length", 30, "mm", None],
        ["Time", "Standard travel", "Standard force", "remark"], ["s", "mm", "N", None],
    ]  # fmt: skip
    for step in range(60):
        plastic = 2e-4 * 1.1**step
        stress = 1000.0 * plastic**0.2
        strain = plastic + stress / 210e3
        rows.append([step, 30.0 * np.expm1(strain), 7.5 * stress * np.exp(-strain), "a"])
    pandas.DataFrame(rows).to_excel(tmp_path / "test.xlsx", header=False, index=False)
    text = "\n".join(";".join("" if it is None else str(it) for it in row) for row in rows)
    (tmp_path / "test.csv").write_text(text)
    found = []
    for ending in ("csv", "xlsx"):
        scene = tmp_path / f"{ending}.toml"
        scene.write_text(
            'name = "t"\nimpactor = { radius = "5 mm", density = 7850 }\nimpact = { speed = 2.0 }\n'
            "[target]\nyoungs_modulus = 210e9\npoissons_ratio = 0.3\n"
            f'tensile_test = {{ curve = "test.{ending}" }}\n'
        )
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            found.append(brinell.predict(scene))
    assert found[0].dent == pytest.approx(found[1].dent, rel=1e-12) and found[0].dent > 1e-6


def test_several_results_of_an_impact_may_have_gaps(tmp_path):
    found = read(
        tmp_path,
        "speed,restitution,dent depth [um],dent diameter [mm],contact time [us],peak force\n"
        "1,0.5,10,,30,340\n2,,20,0.8,,\n",
    )
    assert np.isnan(found.results["restitution"]).tolist() == [False, True]
    assert found.results["dent_depth"] == pytest.approx([1e-5, 2e-5])
    assert found.results["contact_time"][0] == pytest.approx(3e-5)
    assert found.results["largest_force"][0] == 340.0
    with pytest.raises(ValueError, match=":3: no result is given: restitution or dent_depth"):
        read(tmp_path, "speed,restitution,dent depth [um]\n1,0.5,1\n2,,\n")


def test_readings_of_hardness_have_their_scale(tmp_path):
    found = read(tmp_path, "hardness\n58 HRC\n640 HV10\n")
    assert (found.kind, found.readings) == ("hardness", ("58 HRC", "640 HV10"))


def test_a_given_name_makes_a_column_known(tmp_path):
    text = "E2,F7 [N],depth\n1,2,7\n"
    found = read(tmp_path, text, columns={"E2": "depth [mm]", "F7 [N]": "force [N]", "depth": "x"})
    assert found.arguments["depth"] == pytest.approx([1e-3])
    with pytest.raises(ValueError, match="columns names `E3`, which is no heading"):
        read(tmp_path, text, columns={"E3": "depth"})
    with pytest.raises(ValueError, match="calls `E2` `deepth .mm.`, .*did you mean `depth`. Expected .*force"):
        read(tmp_path, text, columns={"E2": "deepth [mm]", "depth": "x"})


# records


@pytest.mark.parametrize(
    "points", ["1,2\n2,5\n3,9", "3,9\n2,5\n1,2", "2,5\n1,2\n3,9", "1,2\n2,5\n3,9\n1,2.1\n2,4.8\n3,8.9"]
)
def test_a_first_loading_in_any_order_and_of_several_specimens_is_kept(tmp_path, points):
    found = read(tmp_path, f"depth [um],force\n{points}\n")
    assert not found.part.any() and found.count == points.count(",")


def test_unloadings_of_a_record_are_found_with_their_reloading(tmp_path):
    found = read(tmp_path, "depth [um],force\n1,2\n2,5\n3,9\n2.5,4\n2.9,8\n4,14\n3.7,7\n")
    assert found.part.tolist() == [0, 0, 0, 1, 1, 0, 2]
    assert "The record has 2 unloadings: 3 of 7 points are used as such" in said(found)


def test_the_unloadings_of_a_machines_record_are_found():
    """Eleven partial unloadings and the last one, as the forces of the file show them."""
    found = measured(DATA / "indentation_record.csv")
    force, part = found.arguments["force"], found.part
    assert found.count == 1082 and part.max() == 12
    for number in range(1, 13):
        inside = np.flatnonzero(part == number)
        assert np.all(np.diff(inside) == 1)
        top = force[: inside[0]].max()
        assert force[inside].min() < 0.61 * top and force[inside].max() < 1.001 * top


def test_points_without_a_force_are_left_out_and_said(tmp_path):
    found = read(tmp_path, "depth [um],force\n-1,-0.1\n1,2\n2,5\n")
    assert found.count == 2 and "1 of 3 points have no positive force" in said(found)


# mistakes


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", ": the file is empty; expected a heading such as `speed [m/s], restitution`"),
        ("speed,restitution\n", ": there are no numbers"),
        ("sped,rest\n1,0.5\n", ":1, column 1: no quantity is called `sped` (speed?) or `rest` ("),
        ("depth,force\n12.5,300\n", ":1, column 1: `depth` has no unit, and numbers up to 12.5, too large for m"),
        ("speed,force\n1,1", ":1: speed and force: a record needs a depth, too"),
        ("speed,mass\n0.5,1", ":1: speed and mass: impacts need a result"),
        ("restitution,mass\n0.5,1", ":1: restitution and mass: impacts need a speed or a drop height"),
        ("speed,e_t\n1,0.5", ":1: oblique impacts need a column `angle [deg]`"),
        ("speed,restitution\n1,0.5\n2,half\n", ":3, column 2: restitution = `half` is no number"),
        ("speed,restitution\n1,0.5\n\n2,1.2\n", ":4, column 2: restitution = 1.2 must be above 0 and at most 1"),
        ("# one\r\nspeed,restitution\r\n\r\n# two\r\n1,0.5\r\n\r\n2,2\r\n", ":7, column 2: restitution"),
        ("speed,restitution\n0,0.5\n", ":2, column 1: speed = 0 must be positive and finite"),
        ("speed,restitution\nNaN,0.5\n", ":2, column 1: speed = `NaN` is no number"),
        ("speed,restitution\ninf,0.5\n", ":2, column 1: speed = `inf` is no number"),
        ("speed,rebound speed\n1,0.5\n1,1.2\n", ":3: the impactor rebounds faster than it came"),
        ("depth,force\n1e-6,-3\n", ": no force is positive; compression counts positive"),
        ("depth,force\n,3\n", ":2, column 1: depth = `` is no number"),
        ("HV10\nhard\n", ":2, column 1: HV10 = `hard` is no reading: a hardness is a number with its scale"),
        ("time [s],bounce interval [s]\n0,0.25\n0.25,0.3\n", ":3: the impactor rebounds faster than it came"),
        ("bounce time\n0\n0.25\n0.2\n", ":4: the bounces are not in the order of their times"),
        ("flight time [ms]\n250\n", ": an impact needs the flight before it and the one after it"),
        ("speed,return hight\n1,0.5\n", ":1: speed: impacts need a result, such as restitution or dent depth. Unknown: `return hight` (return height?)"),
        ("strain [%];stress [MPa]\n1;200\n", ":1: strain [%] and stress [MPa]: a tensile test belongs into the scene"),
        ("depth,force\n" + "1,1\n" * 100_001, ":100002: there are more than 100000 rows"),
    ],
)  # fmt: skip
def test_errors_name_the_line_and_the_column(tmp_path, text, words):
    with pytest.raises(ValueError) as error:
        read(tmp_path, text)
    assert str(error.value).startswith(f"{tmp_path / 'm.csv'}{words}")


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ({"depth": [1e-6], "force": [1.0, 2.0]}, "All arrays must be of the same length"),
        ({"depth": [], "force": []}, "has 0 rows; allowed is 1 to"),
        ({"depth": [1e-6, 2e-6], "force": [1.0, "two"]}, "row 1, column 2: force = `two` is no number"),
        ({"depth": [1e-6]}, "impacts need"),
    ],
)  # fmt: skip
def test_mistakes_in_a_table_name_the_row(table, words):
    with pytest.raises(ValueError) as error:
        measured(table)
    assert words in str(error.value) or "Expected" in str(error.value)


def test_what_is_no_measurement_is_told(tmp_path):
    with pytest.raises(ValueError, match="m.csv: the file is no text"):
        read(tmp_path, b"\0\1\2")
    with pytest.raises(FileNotFoundError):
        measured(tmp_path / "nowhere.csv")
    with pytest.raises(TypeError, match="a DataFrame or a mapping"):
        measured(3)
