"""The elastic waves that a force on a small area of a half-space radiates: the coefficients of `Waves` in crates/contact/src/losses.

A harmonic force on the surface moves it, besides in phase, by `Q w F/(rho c_s^3)` in quadrature. Q is the imaginary part of
Lamb's integral at the point of the force: body waves below the wave number of shear waves, and the residue of the Rayleigh
pole. Two thirds of Q at nu = 0.25 belong to the pole, as G. F. Miller and H. Pursey found (Proc. R. Soc. A 233 (1955) 55-69).

Run it with the packages of data/fit/requirements.txt: python data/fit/fit_waves.py
"""

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq


def radiation(nu):
    """Q by body waves, and by Rayleigh waves."""
    pressure = np.sqrt((1 - 2 * nu) / (2 * (1 - nu)))  # wave number of pressure waves over that of shear waves

    def integrand(q):
        one = np.sqrt(q * q - pressure**2) if q > pressure else -1j * np.sqrt(pressure**2 - q * q)
        other = -1j * np.sqrt(1 - q * q)
        return (-q * one / ((2 * q * q - 1) ** 2 - 4 * q * q * one * other)).imag

    def rayleigh(q):
        return (2 * q * q - 1) ** 2 - 4 * q * q * np.sqrt(q * q - pressure**2) * np.sqrt(q * q - 1)

    body = sum(quad(integrand, *ends, limit=400)[0] for ends in ((0, pressure), (pressure, 1)))
    pole = brentq(rayleigh, 1 + 1e-9, 3)
    slope = (rayleigh(pole + 1e-6) - rayleigh(pole - 1e-6)) / 2e-6
    residue = -np.pi * pole * np.sqrt(pole**2 - pressure**2) / slope
    return body / (2 * np.pi), residue / (2 * np.pi)


def main():
    body, pole = radiation(0.25)
    print(f"nu = 0.25: Q = {body + pole:.6f}, Rayleigh waves {pole / (body + pole):.4f}")
    low, high = -0.99, 0.4999
    ratios = 0.5 * (low + high) + 0.5 * (high - low) * np.cos(np.linspace(0, np.pi, 80))
    numbers = np.array([sum(radiation(nu)) for nu in ratios])
    fitted = np.polynomial.Polynomial.fit(ratios, numbers, 5).convert()
    print("coefficients:", ", ".join(f"{coefficient:.6f}" for coefficient in fitted.coef))
    print(f"largest error: {np.max(np.abs(fitted(ratios) / numbers - 1)):.2%}")


if __name__ == "__main__":
    main()
