"""Steps: wrong steps are rejected, but not the rounding errors of a correct importer."""

import math
from ctypes import byref, c_double

import pytest
from unit import ERROR, OK, unit


def ready(start=0.0, stop=None):
    return unit("steel_ball").ready(start, stop)


@pytest.mark.parametrize("start", [0.0, 1.0, -3.0, 1e5, -1e5])
@pytest.mark.parametrize("step", [1e-3, 1e-6 / 3.0, 0.1])
def test_both_ways_of_counting_time_are_taken(start, step):
    # at 1e5, a third of a microsecond is about 20,000 ulps: the kind of rounding matters, and half a step is still far off
    summed, counted, mixed = ready(start), ready(start), ready(start)
    time = start
    for index in range(1000):
        point = start + index * step
        assert summed.try_step(time, step) == OK, (index, summed.log)
        assert counted.try_step(point, step) == OK, (index, counted.log)
        # the step as the difference of two points, as in importers with events
        assert mixed.try_step(point, (start + (index + 1) * step) - point) == OK, (index, mixed.log)
        time += step


@pytest.mark.parametrize("start", [0.0, 1.0, 1e5])
@pytest.mark.parametrize("off", [0.5, -0.5, 1.0, -1.0, 2.0, 100.0])
def test_a_communication_point_off_by_half_a_step_is_refused(start, off):
    instance = ready(start)
    for _ in range(10):
        instance.step(1e-3)
    assert instance.try_step(instance.time + off * 1e-3, 1e-3) == ERROR
    assert "currentCommunicationPoint" in instance.log[0][3]


def last_successful_time(instance):
    value = c_double()
    instance.call("GetRealStatus", 2, byref(value))
    return value.value


def test_errors_of_time_do_not_pile_up():
    # the FMU uses the given points, not its own sum
    instance = ready()
    for index in range(20_000):
        instance.call("DoStep", index * 1e-4, 1e-4, True)
    assert last_successful_time(instance) == 19_999 * 1e-4 + 1e-4


@pytest.mark.parametrize("step", [1e-3, 1.1e-3, 7e-4, 1e-4, 1e-3 / 3.0])
@pytest.mark.parametrize("start", [0.0, 10.0])
def test_a_sum_of_steps_may_end_a_rounding_behind_the_stop_time(start, step):
    points = [start]
    for _ in range(1999):
        points.append(points[-1] + step)
    # the stop time as computed by another importer, and as far before the end of the sum as a sum of 1999 steps can
    # deviate: half an ulp of the largest point per step
    furthest = points[-1] - 1999 * 0.5 * math.ulp(points[-1])
    for stop in (start + 1999 * step, furthest):
        instance = ready(start, stop)
        for point in points[:-1]:
            assert instance.try_step(point, step) == OK, instance.log


def test_far_from_zero_the_rounding_of_time_itself_is_no_mistake():
    # at 1e5 s a nanosecond is 68.7 ulps and each sum makes it 69: ten steps end 3 ulps late, 4 % of a step
    start, step = 1e5, 1e-9
    stop = start + 10 * step
    instance = ready(start, stop)
    for _ in range(10):
        instance.step(step)
    assert stop < instance.time < stop + 0.1 * step


def test_the_last_experiment_before_initialization_counts_and_may_end_where_it_starts():
    made = unit("steel_ball").instance()
    for start, stop in ((0.0, 1.0), (1.0, 1.0), (5.0, 6.0)):
        made.setup(start, stop)
    made.call("EnterInitializationMode")
    made.call("ExitInitializationMode")
    made.call("DoStep", 5.0, 1.0, True)
    assert made.try_step(6.0, 1e-6) == ERROR and "stop time" in made.log[0][3]


def test_a_tiny_step_changes_next_to_nothing():
    instance = ready()
    instance.step(1e-6, 1.0)
    before = instance.outputs()
    instance.step(1e-15, 1.0)
    after = instance.outputs()
    assert after["indentation"] == pytest.approx(before["indentation"] + 1e-15, rel=1e-12)
    # 1e-15 m compared with 1e-6 m
    assert after["force"] == pytest.approx(before["force"], rel=1e-8)


def test_many_small_increments_add_up_exactly():
    # each is 6e7 times smaller than the indentation: a plain sum loses digits in each step, 1e-12 of the total in the end
    instance = ready()
    instance.step(1e-3, 1e-2)
    increment = 1e-6 * 1.7e-7
    for _ in range(30_000):
        instance.step(1e-6, 1.7e-7)
    assert instance.get("indentation") == pytest.approx(1e-5 + 30_000 * increment, rel=4e-16)
