"""The model description conforms to the schema and to the rules of the standard, as fmpy checks them, and to further ones."""

import re
import struct
import zipfile
from pathlib import Path

import pytest
from fmpy.validation import validate_fmu
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
EXPONENTS = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")
DAMPED = ("damped", "several_damped")


@every_unit
def test_fmpy_finds_no_problem(name):
    assert validate_fmu(paths()[name]) == []
    description = unit(name).description
    # the strictest checkers require the final Z; omitting the time makes FMUs reproducible
    moment = description.generationDateAndTime
    assert moment is None or re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", moment)
    with zipfile.ZipFile(paths()[name]) as archive:
        libraries = [entry for entry in archive.namelist() if entry.startswith("binaries/")]
        icon = archive.read("model.png")
    assert libraries and all(Path(library).stem == description.coSimulation.modelIdentifier for library in libraries)
    assert icon[:8] == b"\x89PNG\r\n\x1a\n" and icon[12:16] == b"IHDR" and icon[-8:-4] == b"IEND"
    width, height = struct.unpack(">II", icon[16:24])
    assert width == height == 128 and len(icon) < 2000


@every_unit
def test_every_unit_of_measurement_is_defined_by_its_si_exponents(name):
    for defined in unit(name).description.unitDefinitions:
        exponents, display = UNITS[defined.name]
        base = {key: getattr(defined.baseUnit, key) for key in EXPONENTS}
        assert {key: value for key, value in base.items() if value} == exponents
        assert display.items() <= {shown.name: shown.factor for shown in defined.displayUnits}.items()


def quantity(name):
    """The name of a variable without its contact and its direction."""
    return name.split(".")[-1].split("[")[0]


def contact(name):
    """The contact of a variable: `left` or `row[3]`."""
    return name.rpartition(".")[0]


@every_unit
def test_an_output_depends_on_nothing_unless_it_follows_the_rate_of_its_contact(name):
    damped = {"force", "mean_pressure", "stiffness"} if name in DAMPED else set()
    names = list(unit(name).variables)
    assert quantity(names[0]) == "indentation_rate"
    for unknown in unit(name).description.outputs:
        output = unknown.variable.name
        followed = {"predicted_tangential_force": ["indentation_rate", "tangential_rate"]}.get(quantity(output), [])
        followed = ["indentation_rate"] if quantity(output) in {"predicted_force"} | damped else followed
        own = [known for known in names if contact(known) == contact(output) and quantity(known) in followed]
        # a missing attribute would mean a dependency on everything, and importers would find algebraic loops
        assert unknown.dependencies is not None and [known.name for known in unknown.dependencies] == own, output


@every_unit
def test_initial_unknowns_name_parameters_of_their_contact_only(name):
    for unknown in unit(name).description.initialUnknowns:
        output, knowns = unknown.variable.name, unknown.dependencies
        # a speed before the first step is the given one, and so is the rate that a force follows
        follows = quantity(output) in ("closing_speed", "tangential_speed") or name in (*DAMPED, "stack", "slope")
        assert all(known.causality == "parameter" or follows and known.causality == "input" for known in knowns)
        if name.startswith("several"):
            # a value that a contact has for itself affects no other contact, and overrides the common value
            names = [known.name for known in knowns]
            own = {text.removeprefix("right.") for text in names if text.startswith("right.") and quantity(text) != "indentation_rate"}
            assert bool(own) == (contact(output) == "right") and not own & set(names), (output, names)


@every_unit
def test_variables_change_as_an_importer_may_assume(name):
    for variable in unit(name).variables.values():
        expected = {"input": "continuous", "parameter": "fixed"}.get(variable.causality)
        if quantity(variable.name) == "effective_mass" and variable.causality == "parameter" and unit(name).moves_bodies():
            # it may change from step to step
            expected = "tunable"
        if variable.causality == "output":
            # an importer that smooths continuous signals must not smooth a force that belongs to a whole step
            held = ("mean_force", "mean_tangential_force", "impulse_moment", "tangential_impulse_moment")
            expected = "discrete" if quantity(variable.name) in held or variable.type == "Enumeration" else "continuous"
        assert variable.variability == expected, variable.name


@every_unit
def test_an_enumeration_has_its_values_in_the_order_of_their_numbers(name):
    types = {it.name: it.items for it in unit(name).description.typeDefinitions if it.items}
    variables = unit(name).variables.values()
    assert {it.declaredType.name for it in variables if it.type == "Enumeration"} == types.keys()
    for kind, items in types.items():
        count, last = {"Regime": (6, "below_largest"), "Sliding": (4, "sliding")}[kind]
        assert [int(item.value) for item in items] == list(range(count))
        assert (items[0].name, items[-1].name) == ("apart", last)
        assert all(item.name.isidentifier() and item.description for item in items)


@every_unit
def test_names_are_flat_unless_there_are_several_contacts_or_directions(name):
    names = unit(name).variables
    # a name with an index is a structured one
    is_structured = "indentation_rate" not in names or "tangential_rate[1]" in names
    expected = {"flat_names": "flat", "structured_names": "structured"}.get(name, "structured" if is_structured else "flat")
    assert unit(name).description.variableNamingConvention == expected


@every_unit
def test_memory_functions_of_the_importer_are_not_used_and_states_can_be_saved(name):
    can = unit(name).description.coSimulation
    assert can.canNotUseMemoryManagementFunctions and can.canHandleVariableCommunicationStepSize
    assert can.canGetAndSetFMUstate and can.canSerializeFMUstate and not can.canBeInstantiatedOnlyOncePerProcess


@every_unit
def test_times_of_the_experiment_suit_each_other(name):
    experiment = unit(name).description.defaultExperiment
    start, stop, step = (float(it) for it in (experiment.startTime, experiment.stopTime, experiment.stepSize))
    assert start == 0.0 and 0.0 < step
    # an impact needs some hundred steps; millions would be an error
    assert 500 <= (stop - start) / step * (1 + 1e-12) < 1e5
    if unit(name).knows_mass():
        assert step >= 1e-5, "such a unit is right at any step"
