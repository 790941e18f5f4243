"""The outcome of an impact."""

from __future__ import annotations

import html
import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .uncertainty import Bands

GRAVITY = 9.80665
"""Standard acceleration of free fall [m/s^2]."""
PREFIXES = {-15: "f", -12: "p", -9: "n", -6: "u", -3: "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"}
PREFIXED = ("m", "m/s", "N", "Pa", "s", "m/N", "J", "g")
"""Units that take a prefix."""


@dataclass(frozen=True)
class Prediction:
    """The outcome of an impact, from the energy balance. `print` shows it as text, a notebook as a
    table."""

    law: str
    mass: float
    """Effective mass [kg]."""
    speed: float
    """Closing speed [m/s]."""
    restitution: float
    kinetic_energy: float
    """Kinetic energy before the impact [J]."""
    energy_lost: float
    """Energy dissipated by the impact [J]."""
    largest_force: float
    """Largest force [N]."""
    largest_indentation: float
    """Largest indentation [m]."""
    largest_contact_radius: float
    """Contact radius at the largest indentation [m]."""
    loading_time: float
    """Time from first contact to the largest indentation [s]."""
    unloading_time: float
    """Time from the largest indentation to the end of the force [s]."""
    dent: float
    """Depth of the dent [m]; rate-dependent laws leave none."""
    regime: str
    """The regime at the largest indentation: "elastic", "fully plastic" ..."""
    regime_number: int
    """The same as the output `regime` of an FMU numbers it."""
    onsets: tuple[tuple[str, float], ...] = ()
    """Pairs: a regime, and the speed [m/s] at which it begins."""
    warnings: tuple[str, ...] = ()
    """What is doubtful: first numbers of the scene and of the call, then the validity of the law for
    this impact."""
    bands: Bands | None = field(default=None, repr=False)
    """The bands of the results, if an uncertainty was given."""
    notes: tuple[str, ...] = field(default=(), compare=False)
    """Remarks on the surface and on the accuracy of the laws that were asked for."""

    @property
    def contact_time(self) -> float:
        """Time from first contact to the end of the force [s]."""
        return self.loading_time + self.unloading_time

    @property
    def rebound_speed(self) -> float:
        """Speed after the impact [m/s]."""
        return self.restitution * self.speed

    @property
    def rebound_height(self) -> float:
        """Height [m] to which a body rises with the rebound speed against standard gravity."""
        return self.rebound_speed**2 / (2.0 * GRAVITY)

    def _rows(self) -> list[tuple[str, str]]:
        """The quantities in words."""
        rows = [
            ("restitution", quantity(self.restitution, "")),
            ("rebound speed", quantity(self.rebound_speed, "m/s")),
            ("rebound height", quantity(self.rebound_height, "m")),
            ("dent", quantity(self.dent, "m")),
            ("largest indentation", quantity(self.largest_indentation, "m")),
            ("largest contact radius", quantity(self.largest_contact_radius, "m")),
            ("largest force", quantity(self.largest_force, "N")),
            ("contact time", quantity(self.contact_time, "s")),
            ("kinetic energy", quantity(self.kinetic_energy, "J")),
            ("energy lost", quantity(self.energy_lost, "J")),
            ("regime", self.regime),
        ]
        return rows + [(f"{name} from", quantity(speed, "m/s")) for name, speed in self.onsets]

    def _title(self) -> str:
        return f"{quantity(self.mass, 'kg')} at {quantity(self.speed, 'm/s')}, by {self.law}"

    def __str__(self) -> str:
        rows = self._rows()
        wide = max(len(name) for name, _ in rows)
        lines = [self._title(), *(f"  {name:{wide}}  {value}" for name, value in rows)]
        return "\n".join(lines + [f"warning: {text}" for text in self.warnings])

    def _repr_html_(self) -> str:
        """A table for a notebook, with the warnings below it."""
        cells = (
            f"<tr><th style='text-align: left'>{html.escape(name)}</th>"
            f"<td style='text-align: left'>{html.escape(value)}</td></tr>"
            for name, value in self._rows()
        )
        doubts = (f"<p><b>warning:</b> {html.escape(text)}</p>" for text in self.warnings)
        title = f"<caption>{html.escape(self._title())}</caption>"
        return f"<table>{title}{''.join(cells)}</table>{''.join(doubts)}"


@dataclass(frozen=True)
class ObliquePrediction:
    """The outcome of an oblique impact with friction. Speeds and spin along the surface are positive in
    the direction of the ball's motion before it."""

    law: str
    mass: float
    """Effective mass [kg]."""
    speed: float
    """Speed along the path of the ball [m/s]."""
    angle: float
    """Angle of incidence from the normal [degrees]."""
    spin: float
    """Spin before the impact [rad/s]."""
    friction: float
    """Coefficient of friction."""
    inertia: float
    """Moment of inertia of the ball [kg.m^2]."""
    normal_restitution: float
    tangential_restitution: float
    """Speed of the centre along the surface, after over before."""
    contact_point_restitution: float
    """Minus the speed of the contact point along the surface, after over before."""
    rebound_angle: float
    """From the normal [degrees]."""
    rebound_speed: float
    """[m/s]"""
    normal_rebound_speed: float
    """[m/s]"""
    tangential_rebound_speed: float
    """Of the centre [m/s]."""
    rebound_spin: float
    """[rad/s]"""
    sliding_part: float
    """The part of the contact time in which the whole contact slides."""
    slides_throughout: bool
    largest_tangential_force: float
    """[N]"""
    friction_work: float
    """Energy lost by slip [J]."""
    energy_lost: float
    """Energy lost in all [J]."""
    contact_time: float
    """Time from first contact to the end of the force [s]."""
    stiffness_ratio: float
    """Tangential over normal stiffness of the contact."""
    warnings: tuple[str, ...] = ()
    """What is doubtful."""


def quantity(value: float, unit: str) -> str:
    """A number with four significant digits and its SI unit with a prefix: `12.82 um`; without one
    where the unit takes none."""
    if unit == "kg":
        value, unit = 1e3 * value, "g"
    rounded = float(f"{value:.3e}")
    power = 0
    if unit in PREFIXED and rounded != 0.0 and math.isfinite(rounded):
        power = 3 * (math.floor(math.log10(abs(rounded))) // 3)
        power = max(-15, min(power, 12))
    if unit == "g" and power >= 3:
        power, unit, value = power - 3, "kg", 1e-3 * value
    # no prefix makes a length, a speed or a time larger
    if unit not in ("N", "Pa", "J", "g"):
        power = min(power, 0)
    number = float(f"{value / 10.0**power:.3e}")
    is_plain = number == 0.0 or 1e-3 <= abs(number) < 1e6
    return f"{number:{'.12g' if is_plain else 'g'}} {PREFIXES[power]}{unit}".rstrip()
