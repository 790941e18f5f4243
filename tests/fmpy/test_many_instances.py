"""Instances share nothing: a thousand at once, or eight threads, give the same bits as a single one."""

import threading

from unit import bits, unit

STEPS = 100


def advance(instance, number, index):
    # different for each instance, so that reading another's memory would be noticed
    instance.step(1e-7, (1.0 + 0.01 * number) * (1.0 if index % 7 < 4 else -0.9))


def result(instance):
    return {key: bits(value) for key, value in instance.outputs().items()}


def alone(number):
    instance = unit("steel_ball").ready()
    for index in range(STEPS):
        advance(instance, number, index)
    return result(instance)


def test_a_thousand_instances_side_by_side_some_of_which_are_freed():
    instances = dict(enumerate(unit("steel_ball").ready() for _ in range(1000)))
    for index in range(STEPS):
        for number, instance in instances.items():
            advance(instance, number, index)
        if index == STEPS // 2:
            instances = {number: instance for number, instance in instances.items() if number % 2}
    assert len({result(instance)["force"] for instance in instances.values()}) > 450, "each has a run of its own"
    assert all(result(instances[number]) == alone(number) for number in range(1, 1000, 74))


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
    assert results == [[result] * 20 for result in expected]
