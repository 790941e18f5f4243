"""FMUs with several contacts: their model description, and its agreement with the FMU."""

import zipfile
from pathlib import Path

import fmpy
import pytest
from ctypes import c_double
from fmpy import fmi2
from fmpy.validation import validate_fmu
from lxml import etree
from unit import OK, paths, unit

every_unit = pytest.mark.parametrize("name", sorted(paths()))


def variables(name):
    """Name, causality and start value of every variable, by its index, counted from 1."""
    with zipfile.ZipFile(paths()[name]) as archive:
        description = etree.fromstring(archive.read("modelDescription.xml"))
    found = description.find("ModelVariables")
    assert [int(variable.get("valueReference")) for variable in found] == list(range(len(found)))
    return description, {place: variable.attrib for place, variable in enumerate(found, start=1)}


def contact(variable_name):
    """The prefix of a contact's variable: `left.` or `row[3].`."""
    return variable_name.split(".")[0] + "."


@every_unit
def test_the_model_description_is_valid(name):
    schema = Path(fmpy.__file__).parent / "schema" / "fmi2" / "fmi2ModelDescription.xsd"
    etree.XMLSchema(file=str(schema)).assertValid(variables(name)[0])
    assert validate_fmu(paths()[name]) == []


@every_unit
def test_every_contact_has_its_variables_under_its_name(name):
    _, all_variables = variables(name)
    names = [variable["name"] for variable in all_variables.values()]
    assert len(set(names)) == len(names)
    inputs = [contact(text) for text in names if text.endswith("indentation_rate")]
    assert inputs == ["left.", *(f"row[{index}]." for index in range(1, 101)), "right."]
    assert inputs == [contact(text) for text in names if text.endswith(".force")]


@every_unit
def test_an_output_follows_the_input_of_its_own_contact_or_none(name):
    description, all_variables = variables(name)
    outputs = [place for place, variable in all_variables.items() if variable["causality"] == "output"]
    unknowns = description.findall("ModelStructure/Outputs/Unknown")
    assert [int(unknown.get("index")) for unknown in unknowns] == outputs
    for unknown in unknowns:
        output = all_variables[int(unknown.get("index"))]["name"]
        followed = [all_variables[int(place)]["name"] for place in unknown.get("dependencies").split()]
        follows = name == "several_damped" and output.endswith(".force")
        assert followed == ([contact(output) + "indentation_rate"] if follows else []), output


@every_unit
def test_before_the_first_step_an_output_follows_the_parameters_of_its_contact(name):
    description, all_variables = variables(name)
    unknowns = description.findall("ModelStructure/InitialUnknowns/Unknown")
    assert len(unknowns) == sum(variable["causality"] == "output" for variable in all_variables.values())
    for unknown in unknowns:
        output = all_variables[int(unknown.get("index"))]["name"]
        names = [all_variables[int(place)]["name"] for place in unknown.get("dependencies").split()]
        own = {text.removeprefix("right.") for text in names if text.startswith("right.")}
        # a value that a contact has for itself affects no other contact, and overrides the common value
        assert bool(own) == (contact(output) == "right."), (output, names)
        assert not own & set(names), (output, names)


@every_unit
def test_start_values_are_those_of_the_model_description(name):
    instance = unit(name).instance()
    instance.setup()
    instance.call("EnterInitializationMode")
    for key, variable in unit(name).variables.items():
        if variable.start is not None:
            assert instance.get(key) == float(variable.start), key


@every_unit
def test_all_forces_can_be_read_in_one_call(name):
    instance = unit(name).ready()
    _, all_variables = variables(name)
    names = [variable["name"] for variable in all_variables.values()]
    inputs = [place for place, text in enumerate(names) if text.endswith("indentation_rate")]
    forces = [place for place, text in enumerate(names) if text.endswith(".force")]
    count = len(inputs)
    references = fmi2.fmi2ValueReference * count
    rates = (c_double * count)(*(1.0 + 0.01 * index for index in range(count)))
    assert instance.try_("SetReal", references(*inputs), count, rates) == OK
    instance.call("DoStep", 0.0, 1e-6, True)
    values = (c_double * count)()
    assert instance.try_("GetReal", references(*forces), count, values) == OK
    assert list(values) == [instance.get(place) for place in forces]
    assert all(before < after for before, after in zip(values[1:100], values[2:101]))
