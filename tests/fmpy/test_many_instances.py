"""Instances share nothing: a thousand at once, or eight threads, give the same bits as a single one."""

import threading

from unit import bits, unit

STEPS = 200


def rate(number, index):
    """Different for each instance, so that reading another's memory would be noticed."""
    return (1.0 + 0.01 * number) * (1.0 if index % 7 < 4 else -0.9)


def advance(instance, number, index):
    instance.step(1e-7, rate(number, index))


def result(instance):
    return {key: bits(value) for key, value in instance.outputs().items()}


def alone(number):
    instance = unit("steel_ball").ready()
    for index in range(STEPS):
        advance(instance, number, index)
    return result(instance)


def test_a_thousand_instances_side_by_side():
    instances = [unit("steel_ball").ready() for _ in range(1000)]
    assert len({instance.component for instance in instances}) == 1000
    for index in range(STEPS):
        for number, instance in enumerate(instances):
            advance(instance, number, index)
    for number in range(0, 1000, 37):
        assert result(instances[number]) == alone(number), number
    assert len({result(instance)["force"] for instance in instances}) > 900, "each has a run of its own"


def test_freed_instances_leave_the_others_alone():
    instances = [unit("steel_ball").ready() for _ in range(100)]
    for index in range(STEPS):
        for number, instance in enumerate(instances):
            if instance is not None:
                advance(instance, number, index)
        # every other instance is freed in the middle of the run
        if index == STEPS // 2:
            instances = [instance if number % 2 else None for number, instance in enumerate(instances)]
    for number in (1, 41, 99):
        assert result(instances[number]) == alone(number)


def test_eight_threads_at_once():
    # ctypes releases Python's lock during a call, so the calls do run at the same time
    expected = [alone(number) for number in range(8)]
    results, start = [[] for _ in range(8)], threading.Barrier(8)

    def work(number):
        start.wait()
        for _ in range(20):
            results[number].append(alone(number))

    threads = [threading.Thread(target=work, args=(number,)) for number in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for number in range(8):
        assert results[number] == [expected[number]] * 20


def test_an_instance_may_wander_from_thread_to_thread():
    instance = unit("steel_ball").ready()
    for index in range(STEPS):
        thread = threading.Thread(target=advance, args=(instance, 3, index))
        thread.start()
        thread.join()
    assert result(instance) == alone(3)
