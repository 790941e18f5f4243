"""Saved states, many contacts at once, threads and processes."""

import pickle
import threading
from concurrent.futures import ThreadPoolExecutor
from multiprocessing import get_context

import pytest
from brinell import Contact, ContactError, State
from units import UNITS, bits, contact


def course(made, steps=40):
    """Forces along a motion in and out, with changes of branch."""
    forces = []
    for index in range(steps):
        force = made.step(3e-7, [1.0, -0.8][index % 10 > 6], -1e3)
        forces.append(float(force))
    return bits(forces) + bits([made["indentation"], made.time])


@pytest.mark.parametrize("name", ["steel_ball", "coupled", "mass_known", "damped", "oblique"])
def test_a_restored_state_goes_on_with_the_same_bits(name):
    accelerated = name in ("coupled", "mass_known")
    slips = {"tangential_rate": 0.01} if name == "oblique" else {}
    go = course if accelerated else lambda made: bits([made.step(3e-7, 1.0, **slips) for _ in range(40)])
    with contact(name) as made, contact(name) as other:
        go(made)
        state = made.save()
        expected = go(made)
        for again in (made, other, made):
            again.restore(pickle.loads(pickle.dumps(state)))
            assert again.time == state.time
            assert go(again) == expected


def test_a_state_brings_a_contact_back_after_a_refusal():
    with contact("coupled") as made:
        made.step(1e-6, 1.0)
        state = made.save()
        with pytest.raises(ContactError):
            made.step(-1.0, 1.0)
        made.restore(state)
        made.step(1e-6, 1.0)
        assert made["indentation"] == 2e-6


@pytest.mark.parametrize("wrong", [b"", b"bytes", None, 3, "state"])
def test_what_is_no_state_is_refused(wrong):
    with contact("coupled") as made, pytest.raises(TypeError, match="save"):
        made.restore(wrong)


def test_states_of_other_units_and_damaged_ones_are_refused():
    with contact("coupled") as made, contact("mass_known") as other:
        good = made.save()
        for data in (other.save().data, good.data[:-1], b"", bytes(len(good.data))):
            with pytest.raises(ContactError):
                made.restore(State(0.0, data))
            made.restore(good)
        assert made.step(1e-6, 1.0) > 0.0


def test_a_hundred_contacts_at_once():
    expected = course(contact("coupled"))
    made = [contact("coupled", name=f"contact {index}") for index in range(100)]
    results = [[] for _ in made]
    for index in range(40):
        for one, result in zip(made, results, strict=True):
            result.append(float(one.step(3e-7, [1.0, -0.8][index % 10 > 6], -1e3)))
    assert all(bits(result) == expected[:40] for result in results)
    for one in made[::2]:
        one.close()
    assert all(one.step(1e-7, 0.0) >= 0.0 for one in made[1::2])


def test_each_contact_hears_its_own_errors():
    made = [contact("coupled", name=f"contact {index}") for index in range(5)]
    for index, one in enumerate(made):
        with pytest.raises(ContactError, match=f"-{index + 1} s"):
            one.step(-1.0 - index, 1.0)


def test_threads_with_contacts_of_their_own():
    expected = course(contact("coupled"))

    def work(_):
        with contact("coupled") as made:
            return course(made)

    with ThreadPoolExecutor(8) as pool:
        assert list(pool.map(work, range(64))) == [expected] * 64


def test_threads_that_share_a_contact_wait_for_each_other():
    made, start = contact("coupled"), threading.Barrier(8)

    def work():
        start.wait()
        for _ in range(500):
            made.step(2.0**-30, 2.0**-10)

    threads = [threading.Thread(target=work) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert made["indentation"] == 4000 * 2.0**-40 and made.time == 4000 * 2.0**-30


def in_another_process(state):
    with Contact(UNITS["coupled"]) as made:
        made.restore(state)
        return course(made)


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_a_state_goes_to_another_process(method):
    made = contact("coupled")
    course(made)
    state = made.save()
    expected = course(made)
    with get_context(method).Pool(1) as pool:
        assert pool.apply(in_another_process, (state,)) == expected
