"""`brinell ssp`: packages are valid for the schemas of SSP 1.0, agree with their FMU, and run in fmpy."""

import os
import subprocess
import xml.etree.ElementTree as ElementTree
import zipfile
from pathlib import Path

import fmpy.ssp.ssd
import pytest
from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import read_ssd, read_ssv
from lxml import etree
from unit import paths, unit

SCHEMAS = Path(fmpy.ssp.ssd.__file__).parent / "schema"
SPACES = {name: f"http://ssp-standard.org/SSP1/SystemStructure{rest}" for name, rest in (
    ("ssd", "Description"), ("ssc", "Common"), ("ssv", "ParameterValues"))}


def brinell(folder, *arguments):
    command = [os.environ["BRINELL"], "ssp", *map(str, arguments)]
    run = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr


@pytest.fixture(scope="module", params=list(paths()))
def package(request, tmp_path_factory):
    """The name of a scene, and its package."""
    folder = tmp_path_factory.mktemp(request.param)
    brinell(folder, Path(unit(request.param).folder) / "resources" / "scene.toml")
    return request.param, folder / f"{request.param}.ssp"


def part(package, name):
    return zipfile.ZipFile(package).read(name)


def validate(xml, schema):
    etree.XMLSchema(etree.parse(str(SCHEMAS / schema))).assertValid(etree.fromstring(xml))


def test_both_files_are_valid_against_the_schemas(package):
    name, path = package
    validate(part(path, "SystemStructure.ssd"), "SystemStructureDescription.xsd")
    validate(part(path, f"resources/{name}.ssv"), "SystemStructureParameterValues.xsd")


def test_the_unit_in_it_is_the_exported_one(package):
    name, path = package
    assert part(path, f"resources/{name}.fmu") == Path(paths()[name]).read_bytes()
    assert len(zipfile.ZipFile(path).namelist()) == 3


def test_connectors_are_the_inputs_and_outputs_with_their_units(package):
    name, path = package
    root = ElementTree.fromstring(part(path, "SystemStructure.ssd"))
    expected = {
        (variable.name, variable.causality, variable.unit)
        for variable in unit(name).variables.values() if variable.causality in ("input", "output")
    }
    for element in (".//ssd:Component", "./ssd:System"):
        connectors = root.findall(f"{element}/ssd:Connectors/ssd:Connector", SPACES)
        found = [(c.get("name"), c.get("kind"), c[0].get("unit")) for c in connectors]
        assert set(found) == expected and len(found) == len(expected)
    ends = {(c.get("startElement"), c.get("endElement"), c.get("endConnector"))
            for c in root.iterfind(".//ssd:Connection", SPACES)}
    assert ends == {((None, "contact") if kind == "input" else ("contact", None)) + (name,) for name, kind, _ in expected}
    defined = {u.get("name") for u in root.iterfind("./ssd:Units/ssc:Unit", SPACES)}
    assert {used for _, _, used in expected if used} <= defined
    enumerations = {e.get("name"): [(i.get("name"), int(i.get("value"))) for i in e]
                    for e in root.iterfind("./ssd:Enumerations/ssc:Enumeration", SPACES)}
    for connector in root.iterfind(".//ssc:Enumeration[@name]/..", SPACES):
        if connector.get("kind"):
            items = unit(name).variables[connector.get("name")].declaredType.items
            assert enumerations[connector[0].get("name")] == [(item.name, int(item.value)) for item in items]


def test_parameters_are_those_of_the_unit_with_the_values_of_the_scene(package):
    name, path = package
    root = ElementTree.fromstring(part(path, f"resources/{name}.ssv"))
    found = {p.get("name"): (float(p[0].get("value")), p[0].get("unit"))
             for p in root.iterfind("./ssv:Parameters/ssv:Parameter", SPACES)}
    variables = unit(name).variables
    assert found == {f"contact.{p}": (float(variables[p].start), variables[p].unit) for p in unit(name).parameters}
    defined = {u.get("name") for u in root.iterfind("./ssv:Units/ssc:Unit", SPACES)}
    assert {used for _, used in found.values() if used} == defined


def forces(name, path, parameters):
    rates = [c.name for c in read_ssd(path).system.connectors if c.name.split(".")[-1] == "indentation_rate"]
    result = simulate_ssp(path, stop_time=49.5e-6, step_size=1e-6, parameter_set=parameters,
                          input={rate: lambda _time: 0.3 for rate in rates})
    force = next(n for n in result.dtype.names if n.split(".")[-1] == "force")
    return result[force]


def test_the_system_runs_as_its_unit_does(package):
    name, path = package
    if name == "many_contacts":
        pytest.skip("fmpy sets thousands of connectors one by one")
    if name == "inverse_masses":
        pytest.skip("fmpy makes the first step with all inputs at zero, and zero is no inverse mass")
    parameters = read_ssv(path, resource=f"resources/{name}.ssv")
    system = forces(name, str(path), parameters)
    instance = unit(name).ready()
    rates = [n for n in unit(name).variables if n.split(".")[-1] == "indentation_rate"]
    force = next(n for n in unit(name).outputs if n.split(".")[-1] == "force")
    alone = []
    # an input of the system reaches the FMU one step later
    for step in range(len(system)):
        instance.set(**{rate: 0.3 if step else 0.0 for rate in rates})
        instance.step(1e-6)
        alone.append(instance.get(force))
    assert max(alone) > 1.0
    assert max(abs(a - b) for a, b in zip(system, alone)) <= 1e-12 * max(alone)
    for parameter in parameters.parameters:
        if parameter.name.split(".")[-1] == "youngs_modulus" and ".target." in parameter.name:
            parameter.value = 0.5 * float(parameter.value)
            assert abs(forces(name, str(path), parameters)[-1] / system[-1] - 1.0) > 1e-3
            break
