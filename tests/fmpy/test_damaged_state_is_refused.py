"""Bytes that are not a state of this FMU are rejected: with a message, without a crash, and the instance continues."""

import pytest
from unit import DISCARD, ERROR, unit


@pytest.mark.parametrize("flip", [0x01, 0xFF])
def test_a_changed_byte_anywhere(flip):
    pressed = unit("steel_ball").ready()
    pressed.step(1e-6, 3.0)
    saved, force = pressed.state(), pressed.get("force")
    for position in range(len(saved)):
        damaged = bytearray(saved)
        damaged[position] ^= flip
        pressed.log.clear()
        status, pointer = pressed.try_deserialize(bytes(damaged))
        assert status in (DISCARD, ERROR) and pointer.value is None
        assert len(pressed.log) == 1 and "state" in pressed.log[0][3]
    assert pressed.get("force") == force
    pressed.restore(saved)
    pressed.step(1e-6, 1.0)
    assert pressed.get("force") > force
