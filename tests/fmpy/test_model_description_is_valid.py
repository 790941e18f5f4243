"""The model description conforms to the schema and to the further rules of the standard."""

import re
import struct
import zipfile
from pathlib import Path

import fmpy
import pytest
from fmpy.validation import validate_fmu
from lxml import etree
from unit import paths, unit

every_unit = pytest.mark.parametrize("name", sorted(paths()))

# unit: SI exponents, display units with the factor of FMI 2.0 (display value = factor * value in base units)
UNITS = {
    "m": ({"m": 1}, {"mm": 1e3, "um": 1e6}),
    "m2": ({"m": 2}, {"mm2": 1e6}),
    "m/s": ({"m": 1, "s": -1}, {}),
    "m/s2": ({"m": 1, "s": -2}, {}),
    "N": ({"kg": 1, "m": 1, "s": -2}, {"kN": 1e-3}),
    "Pa": ({"kg": 1, "m": -1, "s": -2}, {"MPa": 1e-6, "GPa": 1e-9}),
    "N/m": ({"kg": 1, "s": -2}, {}),
    "N.s": ({"kg": 1, "m": 1, "s": -1}, {}),
    "N.s2": ({"kg": 1, "m": 1}, {}),
    "1/kg": ({"kg": -1}, {}),
    "kg": ({"kg": 1}, {}),
    "J": ({"kg": 1, "m": 2, "s": -2}, {}),
}


def xml(name):
    with zipfile.ZipFile(paths()[name]) as archive:
        return etree.fromstring(archive.read("modelDescription.xml"))


@every_unit
def test_the_xml_obeys_the_official_schema_and_fmpy_finds_no_problem(name):
    schema = Path(fmpy.__file__).parent / "schema" / "fmi2" / "fmi2ModelDescription.xsd"
    etree.XMLSchema(file=str(schema)).assertValid(xml(name))
    assert validate_fmu(paths()[name]) == []
    # the strictest checkers require the final Z; omitting the time makes FMUs reproducible
    moment = xml(name).get("generationDateAndTime")
    assert moment is None or re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", moment)


@every_unit
def test_library_and_icon_are_where_importers_look_for_them(name):
    identifier = xml(name).find("CoSimulation").get("modelIdentifier")
    with zipfile.ZipFile(paths()[name]) as archive:
        libraries = [entry for entry in archive.namelist() if entry.startswith("binaries/")]
        icon = archive.read("model.png")
    assert libraries and all(Path(library).stem == identifier for library in libraries)
    assert icon[:8] == b"\x89PNG\r\n\x1a\n" and icon[12:16] == b"IHDR" and icon[-8:-4] == b"IEND"
    width, height = struct.unpack(">II", icon[16:24])
    assert width == height == 128 and len(icon) < 2000


@every_unit
def test_every_unit_of_measurement_is_defined_by_its_si_exponents(name):
    description = xml(name)
    defined = {element.get("name"): element for element in description.iter("Unit")}
    used = {real.get("unit") for real in description.iter("Real")} - {None}
    assert used <= defined.keys()
    for unit_name, element in defined.items():
        exponents, display = UNITS[unit_name]
        assert {key: int(value) for key, value in element.find("BaseUnit").items()} == exponents
        shown = {entry.get("name"): float(entry.get("factor")) for entry in element.iter("DisplayUnit")}
        assert display.items() <= shown.items()
    for real in description.iter("Real"):
        shown = [entry.get("name") for entry in defined[real.get("unit")].iter("DisplayUnit")] if real.get("unit") else []
        assert real.get("displayUnit") in [None, *shown]


def outputs(description):
    variables = description.find("ModelVariables")
    return [index for index, v in enumerate(variables, start=1) if v.get("causality") == "output"]


def quantity(name):
    """The name of a variable without its contact and its direction."""
    return name.split(".")[-1].split("[")[0]


def contact(name):
    """The contact of a variable: `left` or `row[3]`."""
    return name.rpartition(".")[0]


@every_unit
def test_an_output_depends_on_nothing_unless_it_follows_the_rate_of_its_contact(name):
    # a missing attribute would mean a dependency on everything, and importers would find algebraic loops
    damped = {"force", "mean_pressure", "stiffness"} if name in ("damped", "several_damped") else set()
    description = xml(name)
    unknowns = description.find("ModelStructure/Outputs")
    assert [int(unknown.get("index")) for unknown in unknowns] == outputs(description)
    names = [variable.get("name") for variable in description.find("ModelVariables")]
    assert quantity(names[0]) == "indentation_rate" and len(set(names)) == len(names)
    for unknown in unknowns:
        output = names[int(unknown.get("index")) - 1]
        followed = {"predicted_tangential_force": ["indentation_rate", "tangential_rate"]}.get(quantity(output), [])
        followed = ["indentation_rate"] if quantity(output) in {"predicted_force"} | damped else followed
        own = [place for place, known in enumerate(names, 1) if contact(known) == contact(output) and quantity(known) in followed]
        assert unknown.get("dependencies") == " ".join(map(str, own)), output


@every_unit
def test_initial_unknowns_are_complete_and_name_parameters_of_their_contact_only(name):
    description = xml(name)
    unknowns = description.find("ModelStructure/InitialUnknowns")
    assert [int(unknown.get("index")) for unknown in unknowns] == outputs(description)
    variables = description.find("ModelVariables")
    for unknown in unknowns:
        output = variables[int(unknown.get("index")) - 1].get("name")
        knowns = [variables[int(index) - 1] for index in unknown.get("dependencies").split()]
        # a speed before the first step is the given one, and so is the rate that a force follows
        follows = quantity(output) in ("closing_speed", "tangential_speed") or name in ("damped", "stack", "slope")
        follows = follows or name == "several_damped"
        assert all(known.get("causality") == "parameter" or follows and known.get("causality") == "input" for known in knowns)
        if name.startswith("several"):
            # a value that a contact has for itself affects no other contact, and overrides the common value
            names = [known.get("name") for known in knowns]
            own = {text.removeprefix("right.") for text in names if text.startswith("right.") and quantity(text) != "indentation_rate"}
            assert bool(own) == (contact(output) == "right") and not own & set(names), (output, names)


@every_unit
def test_kinds_of_variables_are_those_of_the_standard(name):
    expected = {"input": ("continuous", None), "parameter": ("fixed", "exact"), "output": (None, "calculated")}
    for variable in xml(name).find("ModelVariables"):
        variability, initial = expected[variable.get("causality")]
        if variable.get("name").split(".")[-1] == "effective_mass" and unit(name).moves_bodies():
            # it may change from step to step
            variability = {"parameter": "tunable"}.get(variable.get("causality"), variability)
        if variable.get("causality") == "output":
            # an importer that smooths continuous signals must not smooth a force that belongs to a whole step
            held = ("mean_force", "mean_tangential_force", "impulse_moment", "tangential_impulse_moment")
            is_held = quantity(variable.get("name")) in held
            variability = "discrete" if is_held or variable.find("Enumeration") is not None else "continuous"
        assert (variable.get("variability"), variable.get("initial")) == (variability, initial), variable.get("name")
        starts = variable[0].get("start") is not None
        assert starts == (variable.get("causality") != "output"), "start: input and parameters have one, outputs none"


@every_unit
def test_an_enumeration_has_its_values_in_the_order_of_their_numbers(name):
    description = xml(name)
    types = {element.get("name"): element for element in description.iter("SimpleType")}
    declared = [variable.find("Enumeration").get("declaredType") for variable in description.iter("ScalarVariable")
                if variable.find("Enumeration") is not None]
    assert set(declared) == types.keys()
    for element in types.values():
        items = element.findall("Enumeration/Item")
        last = {"Regime": "below_largest", "Sliding": "sliding"}[element.get("name")]
        assert [int(item.get("value")) for item in items] == list(range({"Regime": 6, "Sliding": 4}[element.get("name")]))
        assert items[0].get("name") == "apart" and items[-1].get("name") == last
        assert all(item.get("name").isidentifier() and item.get("description") for item in items)


@every_unit
def test_names_are_flat_unless_there_are_several_contacts_or_directions(name):
    description = xml(name)
    names = {variable.get("name") for variable in description.iter("ScalarVariable")}
    # a name with an index is a structured one
    is_structured = "indentation_rate" not in names or "tangential_rate[1]" in names
    expected = {"flat_names": "flat", "structured_names": "structured"}.get(name, "structured" if is_structured else "flat")
    assert description.get("variableNamingConvention") == expected


@every_unit
def test_memory_functions_of_the_importer_are_not_used_and_states_can_be_saved(name):
    capabilities = xml(name).find("CoSimulation").attrib
    for capability in (
        "canNotUseMemoryManagementFunctions",
        "canGetAndSetFMUstate",
        "canSerializeFMUstate",
        "canHandleVariableCommunicationStepSize",
    ):
        assert capabilities[capability] == "true", capability
    assert capabilities.get("canBeInstantiatedOnlyOncePerProcess", "false") == "false"


@every_unit
def test_times_of_the_experiment_suit_each_other(name):
    experiment = xml(name).find("DefaultExperiment")
    start, stop, step = (float(experiment.get(key)) for key in ("startTime", "stopTime", "stepSize"))
    assert start == 0.0 and 0.0 < step
    # an impact needs some hundred steps; millions would be an error
    assert 500 <= (stop - start) / step * (1 + 1e-12) < 1e5
    if unit(name).knows_mass():
        assert step >= 1e-5, "such a unit is right at any step"
