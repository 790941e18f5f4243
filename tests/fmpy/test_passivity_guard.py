"""An FMU whose scene requests the passivity guard logs a message when it first acts, and only then."""

import fmpy
from unit import OK, WARNING, unit

# the guard acts at largest indentations of 1 to 11.2 yield indentations of 7.55e-8 m
WITHIN, BEYOND = 3e-7, 3e-6


def dent(instance, depth):
    """Indentation to `depth` and back, in steps of a hundredth of the distance."""
    for rate in (1.0, -1.0):
        for _ in range(100):
            instance.step(depth / 100, rate)


def warnings(instance):
    assert all(status == WARNING for _, status, _, _ in instance.log), instance.log
    return [message for _, _, category, message in instance.log if category == "logStatusWarning"]


def ready(**arguments):
    instance = unit("guarded").instance(**arguments)
    instance.initialize()
    return instance


def test_it_is_told_once_when_it_first_acts():
    instance = ready(logging=True)
    dent(instance, 5e-8)
    assert warnings(instance) == [], "nothing has yielded"
    dent(instance, WITHIN)
    dent(instance, WITHIN)
    assert len(warnings(instance)) == 1, instance.log
    assert "passivity guard acts at largest indentations from 1.0000 to 11.18" in warnings(instance)[0]


def test_a_rebound_in_a_single_step_is_told_too():
    instance = ready(logging=True)
    instance.step(1.0, WITHIN)
    instance.step(1.0, -1.0)
    assert len(warnings(instance)) == 1, instance.log


def test_it_is_told_where_it_acts_only():
    instance = ready(logging=True)
    dent(instance, BEYOND)
    assert instance.log == []


def test_the_category_is_declared_and_can_be_switched():
    categories = fmpy.read_model_description(unit("guarded").path).logCategories
    assert [category.name for category in categories] == [
        "logStatusWarning", "logStatusDiscard", "logStatusError", "logAll"
    ]
    instance = ready(logging=False)
    names = (fmpy.fmi2.fmi2String * 1)(b"logStatusWarning")
    assert instance.try_("SetDebugLogging", False, 1, names) == OK
    dent(instance, WITHIN)
    assert instance.log == []
    assert instance.try_("SetDebugLogging", True, 1, names) == OK
    dent(instance, WITHIN)
    assert len(warnings(instance)) == 1, instance.log


def test_the_guarded_contact_gives_back_what_was_put_in():
    instance = ready()
    dent(instance, WITHIN)
    work, lost = instance.get("work"), instance.get("dissipated_energy")
    assert abs(lost) <= 1e-14 * 1e-6 and work >= -1e-20, (work, lost)
