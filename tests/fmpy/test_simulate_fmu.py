"""fmpy.simulate_fmu, the most widely used function, works with its defaults."""

import fmpy
import numpy as np
import pytest
from unit import paths, unit

every_unit = pytest.mark.parametrize("name", sorted(paths()))
every_unit_with_held_rate = pytest.mark.parametrize("name", [name for name in sorted(paths()) if not unit(name).knows_mass()])


@every_unit
@pytest.mark.parametrize("logging", [False, True])
def test_with_defaults(name, logging):
    messages = []
    result = fmpy.simulate_fmu(paths()[name], debug_logging=logging, logger=lambda *message: messages.append(message))
    assert messages == []
    experiment = unit(name).description.defaultExperiment
    assert result["time"][0] == 0.0
    assert result["time"][-1] == pytest.approx(float(experiment.stopTime), rel=1e-9)
    # the input starts at 0: the bodies are at rest
    assert np.all(result["force"] == 0.0)


@every_unit_with_held_rate
@pytest.mark.parametrize("start", [0.0, 100.0])
def test_a_constant_input_presses_from_the_start_time_of_the_caller(name, start):
    # a constant rate is a wrong coupling of some units, which warn; without a logger of this call, fmpy calls one that is gone
    result = fmpy.simulate_fmu(
        paths()[name], start_time=start, stop_time=start + 1e-3, output_interval=1e-5,
        start_values={"indentation_rate": 1e-3}, output=unit(name).outputs, logger=lambda *message: None,
    )
    assert set(unit(name).outputs) <= set(result.dtype.names)
    assert len(result["time"]) == 101 and np.all(np.diff(result["force"]) > 0.0)
    assert result["time"][-1] == pytest.approx(start + 1e-3, rel=1e-12)
    # at 100 s a time is known to 1e-14 s, a thousandth of a ppm of a step
    instance = unit(name).ready()
    instance.step(1e-3, 1e-3)
    assert result["force"][-1] == pytest.approx(instance.get("force"), rel=1e-9)


def test_parameters_can_be_given():
    forces = []
    for strength in (200e6, 400e6):
        result = fmpy.simulate_fmu(
            paths()["steel_ball"], stop_time=1e-5,
            start_values={"target.yield_strength": strength, "indentation_rate": 1.0}, output=["force"],
        )
        forces.append(result["force"][-1])
    assert 1.5 < forces[1] / forces[0] < 2.5, "in the plastic range the force is close to proportional to the strength"


def test_a_contact_with_friction_takes_both_rates_as_a_table():
    stop, step = 4e-6, 1e-7
    dtype = [("time", float), ("indentation_rate", float), ("tangential_rate", float)]
    signals = np.array([(0.0, 2.0, 0.1), (stop, 2.0, 0.1)], dtype=dtype)
    result = fmpy.simulate_fmu(
        paths()["oblique"], stop_time=stop, step_size=step, output_interval=step, input=signals,
        output=["force", "tangential_force", "sliding"],
    )  # fmt: skip
    assert result["tangential_force"][-1] > 0.0
    assert all(result["tangential_force"] <= 0.092 * result["force"] * (1.0 + 1e-12))
    # a constant ratio of the rates below the coefficient: no part slips
    assert list(result["sliding"][2:]) == [1] * (len(result) - 2)
