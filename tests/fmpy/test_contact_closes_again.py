"""After the bodies have separated, the contact closes again: at the remaining dent, or at 0 on a fresh surface."""

import fmpy
import numpy as np
import pytest
from unit import unit

DEPTH = 2e-6  # m, 34 times the indentation at first yield: a dent of some 0.7 um remains


def pressed_and_released(name):
    """An instance that was pressed to `DEPTH` and then moved to `DEPTH` above the surface; and the depth of the dent."""
    instance = unit(name).ready()
    instance.step(1e-3, DEPTH / 1e-3)
    residual = instance.get("residual_indentation")
    assert 0.2 * DEPTH < residual < 0.8 * DEPTH
    instance.step(2e-3, -DEPTH / 1e-3)
    assert instance.get("force") == 0.0 and instance.get("indentation") < 0.0 and instance.get("regime") == 0
    return instance, residual


def approach(instance, indentation):
    instance.step(1e-3, (indentation - instance.get("indentation")) / 1e-3)


def test_a_dented_surface_carries_again_from_the_residual_indentation_on():
    instance, residual = pressed_and_released("dented")
    assert instance.get("residual_indentation") == residual
    for part in (0.1, 0.5, 0.999999):
        approach(instance, part * residual)
        assert instance.get("force") == 0.0 and instance.get("regime") == 0
    approach(instance, 1.000001 * residual)
    assert instance.get("force") > 0.0 and instance.get("regime") == 5


def test_a_dented_surface_is_reloaded_along_the_unloading_path():
    instance, residual = pressed_and_released("dented")
    down = unit("dented").ready()
    down.step(1e-3, DEPTH / 1e-3)
    for part in (0.95, 0.7, 0.3, 0.05):
        approach(down, residual + part * (DEPTH - residual))
        up, _ = pressed_and_released("dented")
        approach(up, down.get("indentation"))
        # the same branch; the indentations differ by the rounding of a step, 1e-16 relative to 2 um with a recovery of 5 %
        assert up.get("force") == pytest.approx(down.get("force"), rel=1e-12)
        assert up.get("dissipated_energy") == down.get("dissipated_energy")


def test_a_fresh_surface_carries_from_zero_on():
    instance, residual = pressed_and_released("fresh")
    assert instance.get("residual_indentation") == 0.0 and instance.get("max_indentation") == 0.0
    first = unit("fresh").ready()
    for part in (1e-6, 0.01, 0.3, 0.99, 1.5):
        approach(instance, part * residual)
        approach(first, part * residual)
        assert instance.get("force") == pytest.approx(first.get("force"), rel=1e-9) and instance.get("force") > 0.0


def test_a_fresh_surface_forgets_only_when_the_bodies_part():
    # separated from the dent, but not from the surface: the spot is still the same
    instance = unit("fresh").ready()
    instance.step(1e-3, DEPTH / 1e-3)
    residual = instance.get("residual_indentation")
    approach(instance, 0.5 * residual)
    assert instance.get("force") == 0.0
    approach(instance, 0.9 * residual)
    assert instance.get("force") == 0.0 and instance.get("residual_indentation") == residual


@pytest.mark.parametrize("steps", [1, 7, 1000])
def test_on_a_fresh_surface_every_blow_costs_the_same_energy(steps):
    instance = unit("fresh").ready()
    losses = []
    for _ in range(3):
        before = instance.get("dissipated_energy")
        for speed in (DEPTH / 1e-3, -2.0 * DEPTH / 1e-3, DEPTH / 1e-3):
            for _ in range(steps):
                instance.step(1e-3 / steps, speed)
        losses.append(instance.get("dissipated_energy") - before)
    # the sum of steps ends within rounding of 0, and the energies agree within rounding
    assert losses[0] > 0.0 and losses == pytest.approx([losses[0]] * 3, rel=1e-9)


@pytest.mark.parametrize("name", ["dented", "fresh"])
@pytest.mark.parametrize("interval", [1e-4, 3.7e-5])
def test_a_signal_drives_it_through_simulate_fmu(name, interval):
    # in, out, and in again, as a step function of the rate: a point on each side of every change keeps it constant
    speed = DEPTH / 1e-3
    changes = [0.0, 1e-3, 3e-3, 6e-3]
    rates = [speed, -speed, speed]
    points = [(changes[i + k], rates[i]) for i in range(3) for k in (0, 1)]
    signal = np.array(points, dtype=[("time", np.float64), ("indentation_rate", np.float64)])
    result = fmpy.simulate_fmu(
        unit(name).path,
        input=signal,
        stop_time=6e-3,
        output_interval=interval,
        output=["force", "indentation", "residual_indentation"],
        validate=True,
    )
    assert result["time"][-1] == pytest.approx(6e-3)
    residual = unit(name).ready()
    residual.step(1e-3, speed)
    dent = residual.get("residual_indentation")
    # fmpy interpolates the signal across an event: within one interval the rate is not the prescribed one
    second = result[result["time"] > 3e-3 + 2.0 * interval]
    touching = second[second["force"] > 0.0]["indentation"]
    border = dent if name == "dented" else 0.0
    one_step = speed * interval
    assert len(touching) > 10
    assert border - 1e-12 < touching.min() < border + 1.001 * one_step
