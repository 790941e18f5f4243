"""Bytes that are not a state of this FMU are rejected: with a message, without a crash, and the instance continues."""

import random
from ctypes import byref, c_char, c_size_t, c_void_p

import pytest
from unit import DISCARD, ERROR, paths, unit


@pytest.fixture
def pressed():
    instance = unit("steel_ball").ready()
    instance.step(1e-6, 3.0)
    return instance


def assert_refused(instance, data):
    status, pointer = instance.try_deserialize(data)
    assert status in (DISCARD, ERROR)
    assert pointer.value is None, "a refused call leaves the pointer alone"
    assert len(instance.log) == 1 and "state" in instance.log[0][3]


@pytest.mark.parametrize("flip", [0x01, 0x80, 0xFF])
def test_a_changed_byte_anywhere(pressed, flip):
    saved = pressed.state()
    for position in range(len(saved)):
        damaged = bytearray(saved)
        damaged[position] ^= flip
        instance = unit("steel_ball").instance()
        assert_refused(instance, bytes(damaged))


def test_bytes_that_are_cut_off_or_appended(pressed):
    saved = pressed.state()
    for length in range(1, len(saved)):
        assert_refused(unit("steel_ball").instance(), saved[:length])
    for more in (b"\0", saved, b"\xff" * 10_000):
        assert_refused(unit("steel_ball").instance(), saved + more)


def test_no_bytes_at_all():
    instance = unit("steel_ball").instance()
    status, pointer = instance.try_deserialize(b"")
    assert status in (DISCARD, ERROR) and pointer.value is None


def test_bytes_in_another_order(pressed):
    saved = pressed.state()
    assert_refused(unit("steel_ball").instance(), saved[::-1])
    # two numbers exchanged
    assert_refused(unit("steel_ball").instance(), saved[:64] + saved[72:80] + saved[64:72] + saved[80:])


def test_noise():
    source = random.Random(1)
    length = len(unit("steel_ball").instance().state())
    for _ in range(200):
        assert_refused(unit("steel_ball").instance(), source.randbytes(length))
    assert_refused(unit("steel_ball").instance(), b"\0" * length)


def test_the_state_of_another_unit():
    other = unit("everything").ready().state()
    assert_refused(unit("steel_ball").instance(), other)
    own_length = len(unit("steel_ball").instance().state())
    assert_refused(unit("steel_ball").instance(), other[:own_length].ljust(own_length, b"\0"))


def test_after_a_refusal_a_good_state_can_still_be_set(pressed):
    saved = pressed.state()
    force = pressed.get("force")
    assert pressed.try_deserialize(saved[:-1])[0] in (DISCARD, ERROR)
    assert pressed.get("force") == force
    pressed.restore(saved)
    pressed.step(1e-6, 1.0)
    assert pressed.get("force") > force


def test_a_buffer_that_is_too_short_is_not_written_to(pressed):
    pointer, size = c_void_p(), c_size_t()
    pressed.call("GetFMUstate", byref(pointer))
    pressed.call("SerializedFMUstateSize", pointer, byref(size))
    buffer = (c_char * size.value).from_buffer_copy(b"\xaa" * size.value)
    assert pressed.try_("SerializeFMUstate", pointer, buffer, size.value - 1) in (DISCARD, ERROR)
    assert buffer.raw == b"\xaa" * size.value


def test_null_states_are_refused(pressed):
    saved = pressed.state()
    assert pressed.try_("SetFMUstate", None) == ERROR
    pressed.restore(saved)
    assert pressed.try_("GetFMUstate", None) == ERROR
    pressed.restore(saved)


def test_the_scenes_are_two_different_units():
    # otherwise the test with the bytes of another FMU would test nothing
    assert paths()["steel_ball"] != paths()["everything"]
    assert unit("steel_ball").description.guid != unit("everything").description.guid
