"""After the bodies have separated, the contact closes again: at the remaining dent, or at 0 on a fresh surface."""

import fmpy
import numpy as np
import pytest
from unit import unit

DEPTH = 2e-6  # m, 34 times the indentation at first yield: a dent of some 0.7 um remains
SPEED = DEPTH / 1e-3


@pytest.mark.parametrize("name", ["dented", "fresh"])
@pytest.mark.parametrize("interval", [1e-4, 3.7e-5])
def test_a_signal_drives_it_through_simulate_fmu(name, interval):
    # in, out, and in again, as a step function of the rate: a point on each side of every change keeps it constant
    changes, rates = [0.0, 1e-3, 3e-3, 6e-3], [SPEED, -SPEED, SPEED]
    points = [(changes[i + k], rates[i]) for i in range(3) for k in (0, 1)]
    signal = np.array(points, dtype=[("time", np.float64), ("indentation_rate", np.float64)])
    output = ["force", "indentation", "residual_indentation", "regime", "dissipated_energy"]
    result = fmpy.simulate_fmu(
        unit(name).path, input=signal, stop_time=6e-3, output_interval=interval, output=output, validate=True
    )
    assert result["time"][-1] == pytest.approx(6e-3)
    pressed = unit(name).ready()
    pressed.step(1e-3, SPEED)
    dent = pressed.get("residual_indentation")
    assert 0.2 * DEPTH < dent < 0.8 * DEPTH
    # fmpy interpolates the signal across an event: within one interval the rate is not the prescribed one
    second = result[result["time"] > 3e-3 + 2.0 * interval]
    touching = second["force"] > 0.0
    assert np.count_nonzero(touching) > 10 and np.all((second["regime"] == 0) == ~touching)
    border = dent if name == "dented" else 0.0
    lowest = second[touching]["indentation"].min()
    assert border - 1e-12 < lowest < border + 1.001 * SPEED * interval
    # the way in again is the one out of the dent, or that of a new surface, which costs energy once more
    last, again = second[-1], unit(name).ready()
    again.step(1e-3, last["indentation"] / 1e-3)
    assert last["force"] == pytest.approx(again.get("force"), rel=1e-9)
    assert (last["dissipated_energy"] > 1.1 * again.get("dissipated_energy")) == (name == "fresh")
    assert (second[touching]["regime"][0] == 5) == (name == "dented")
