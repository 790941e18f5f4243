"""Fits the effect of hardening and Poisson's ratio in the contact law `brinell` to the curves in ../truth/materials.

    python -m venv venv && venv/bin/pip install -r requirements.txt && venv/bin/python fit_materials.py

Writes materials_law.json next to this file. Prints the residuals, those of a cross-validation that leaves out one
curve at a time, and the checks, which are assertions. `fit_brinell.py` fits the law
itself.

Everything is normalised by the yield point of the material: k = d/d_Y, phi = F/F_Y, alpha = a^2/(R d_Y). The yield
indentation is that of the law `brinell` (x = d/d_y = 1 for a mean pressure of 1.1 S) times s0^2. The strength at first
yield, relative to nu = 0.3, is s0 = exp(a1 (nu - 0.3) + a2 (nu - 0.3)^2), from the theoretical first yield 0.825, 0.955,
1.110 and 1.198 for nu = 0.2, 0.3, 0.4 and 0.45, over 0.955 (K. L. Johnson, Contact Mechanics, section 6.2). Phi and A are
force and area of the law itself. eta = H/E* is the hardening modulus over the effective modulus: (1 - nu^2) H/E for a
rigid sphere.

Loading.  phi = t^3 Phi(k/t^2) with one effective strength t = t_nu t_H:
    t_nu = 1 + (1/s0 - 1) D(k; decay_scale, decay_power): the effect of Poisson's ratio decays far from yield
    t_H = 1 + rise h s0^(2 rise_power) (k^rise_power - 1) with h = eta/(1 + saturation eta)
    D(k; scale, power) = w/(1 + w), w = s0^decay_shift (k^power - 1)/scale
The law has the values and slopes of this form at the knots, and is c0 + c1 k + c2 k^1.5 + c3 k^2 between them. Beyond
the last knot it is a straight line.
Contact radius.  alpha = phi_nu (Phi(k)/A(k))^-b (phi/phi_nu)^-radius_power with the force phi_nu without hardening; alpha >= k as
by Hertz. b = 1 - ln s0/ln p, where p is the mean pressure of deep dents over that at first yield for nu = 0.3: the mean pressure
phi/alpha then rises with k to that of deep dents for each nu.
Dent.  k_f = (k - u^2 recovery(k/u^2))/(1 + dent_fall h) with the strength
u = 1 + (1/s0 - 1) D(k; dent_decay_scale, dent_decay_power) and the recovery of the law itself.
Unloading.  The form of the law, (1 + g) s^1.5 - g s^2 with the initial slope 2 E* a: g = 3 (1 - recovery sqrt(beta)/phi),
limited to the range from 0 to LARGEST_G, which no fitted curve reaches. The radius sqrt(beta) depends on the force more
than the contact radius does: beta = u^2 A(k/u^2) (phi/(u^3 Phi(k/u^2)))^-slope_power.
"""
import json
from pathlib import Path
import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import least_squares
import fit_brinell as plain

HERE = Path(__file__).parent
MATERIALS = HERE.parent / "truth" / "materials"
# Theoretical first yield for these Poisson's ratios over that for 0.3.
FIRST_YIELD = {0.2: 0.825 / 0.955, 0.4: 1.110 / 0.955, 0.45: 1.198 / 0.955}
# The knots of the law and additional ones, because the strength also changes between the knots.
KNOTS = np.array([1.0, 2.0, 5.0, 12.0, 30.0, 80.0, 160.0, 250.0, 500.0, 700.0, 1000.0, 2000.0])
HARDENING = {"H0.005": 0.005, "H0.02": 0.02, "H0.05": 0.05, "H0.1": 0.1}
RATIOS = {"nu0.2": 0.2, "nu0.4": 0.4, "nu0.45": 0.45}
NAMES = ["decay_scale", "decay_power", "decay_shift", "rise", "rise_power", "saturation", "radius_power", "dent_fall",
         "dent_decay_scale", "dent_decay_power", "slope_power"]
START = [22.0, 0.6, 3.0, 0.95, 0.39, 1.3, 0.86, 1.6, 6.0, 0.46, 1.1]
# Without this bound, materials far from the fitted ones would return more energy than they received.
LARGEST_G = 0.75
# Digits of the constants: more would not change the fourth digit of a force.
SIGNIFICANT = 4


def law_itself():
    """The law `brinell` with the constants from `fit_brinell.py`."""
    constants = json.loads((HERE / "brinell_law.json").read_text())
    shape = [constants["unloading_height"], constants["unloading_onset"]]
    return plain.Law(constants["force_slopes"], constants["area_slopes"], shape)


LAW = law_itself()


def near_law():
    """The law without its far end, to which the constants are fitted. The curves end at k = 500, and both laws are the same up
    to 250. With the far end, the constants would be up to 4 % different, but the errors of the force only 0.03 %."""
    x, f, a = plain.read_loading()
    return plain.fit_near(x, f, a, plain.read_unloadings(x, f))


def strength_at_yield():
    """a1 and a2 of s0, from the theoretical first yields."""
    shift = np.array([ratio - 0.3 for ratio in FIRST_YIELD])
    logarithm = 0.5 * np.log(list(FIRST_YIELD.values()))
    return np.linalg.lstsq(np.array([shift, shift**2]).T, logarithm)[0].round(3)


GROWTH = strength_at_yield()


class Material:
    """The law for a Poisson's ratio and eta = H/E*."""

    def __init__(self, ratio, eta, constants):
        self.__dict__.update(zip(NAMES, constants))
        shift = ratio - 0.3
        self.s0 = np.exp(GROWTH[0] * shift + GROWTH[1] * shift**2)
        self.h = eta / (1 + self.saturation * eta) if np.isfinite(eta) else 1 / self.saturation
        f, slope = self.exact(KNOTS)
        rows = [(0.0, 0.0, 1.0, 0.0)]
        for i in range(len(KNOTS) - 1):
            a, b = KNOTS[i], KNOTS[i + 1]
            matrix = [[1, z, z**1.5, z**2] for z in (a, b)] + [[0, 1, 1.5 * z**0.5, 2 * z] for z in (a, b)]
            rows.append(np.linalg.solve(matrix, [f[i], f[i + 1], slope[i], slope[i + 1]]))
        rows.append((f[-1] - slope[-1] * KNOTS[-1], slope[-1], 0.0, 0.0))
        self.table = np.array(rows)
        whole = self._antiderivative(KNOTS, range(len(KNOTS)))
        whole -= self._antiderivative(np.r_[0, KNOTS[:-1]], range(len(KNOTS)))
        self.before = np.r_[0, np.cumsum(whole)]

    def fading(self, k, scale, power):
        """1 + (1/s0 - 1) D, and its slope."""
        scale = scale / self.s0**self.decay_shift
        w = (k**power - 1) / scale
        slope = power * k ** (power - 1) / scale
        return 1 + (1 / self.s0 - 1) * w / (1 + w), (1 / self.s0 - 1) * slope / (1 + w) ** 2

    def strength(self, k):
        one, one_slope = self.fading(k, self.decay_scale, self.decay_power)
        rise = self.rise * self.h * self.s0 ** (2 * self.rise_power)
        other, other_slope = 1 + rise * (k**self.rise_power - 1), rise * self.rise_power * k ** (self.rise_power - 1)
        return one * other, one_slope * other + one * other_slope

    def exact(self, k):
        """The form itself; the law has its values and slopes at the knots."""
        t, t_slope = self.strength(k)
        scaled = k / t**2
        force, slope = LAW.force(scaled), LAW.force.slope(scaled)
        return t**3 * force, t_slope * (3 * t**2 * force - 2 * k * slope) + t * slope

    def _antiderivative(self, k, index):
        c0, c1, c2, c3 = self.table[index].T
        return c0 * k + c1 * k**2 / 2 + 0.4 * c2 * k**2.5 + c3 * k**3 / 3

    def _rows(self, k):
        return self.table[np.searchsorted(KNOTS, k, side="right")].T

    def force(self, k):
        c0, c1, c2, c3 = self._rows(k)
        return c0 + c1 * k + c2 * k**1.5 + c3 * k**2

    def slope(self, k):
        _, c1, c2, c3 = self._rows(k)
        return c1 + 1.5 * c2 * k**0.5 + 2 * c3 * k

    def work(self, k):
        index = np.searchsorted(KNOTS, k, side="right")
        return self.before[index] + self._antiderivative(k, index) - self._antiderivative(np.r_[0, KNOTS][index], index)

    def area(self, k):
        t, _ = self.fading(k, self.decay_scale, self.decay_power)
        soft = np.where(k < 1, k**1.5, t**3 * LAW.force(k / t**2))  # the force without hardening
        exponent = 1 - np.log(self.s0) / np.log(LAW.force.slopes[-1] / LAW.area.slopes[-1])
        area = soft * (LAW.force(k) / LAW.area(k)) ** -exponent * (self.force(k) / soft) ** -self.radius_power
        return np.maximum(area, k)

    def dent_strength(self, k):
        return self.fading(k, self.dent_decay_scale, self.dent_decay_power)[0]

    def dent(self, k):
        u = self.dent_strength(k)
        return (k - u**2 * LAW.recovery(k / u**2)) / (1 + self.dent_fall * self.h)

    def g(self, k):
        u = self.dent_strength(k)
        scaled = k / u**2
        beta = u**2 * LAW.area(scaled) * (self.force(k) / (u**3 * LAW.force(scaled))) ** -self.slope_power
        return np.clip(3 * (1 - (k - self.dent(k)) * np.sqrt(beta) / self.force(k)), 0, LARGEST_G)

    def recovered_work(self, k):
        return self.force(k) * (k - self.dent(k)) * (0.4 + self.g(k) / 15)

    def unloading(self, k_m, k):
        s = np.clip((k - k_m) / (k_m - self.dent(k_m)) + 1, 0, 1)
        g = self.g(k_m)
        return self.force(k_m) * ((1 + g) * s**1.5 - g * s**2)


class Curve:
    """A finite-element curve with its unloadings."""

    def __init__(self, name):
        self.name, self.h, self.ratio = name, HARDENING.get(name, 0.0), RATIOS.get(name, 0.3)
        data = np.genfromtxt(MATERIALS / f"loading_{name}.csv", delimiter=",", names=True)
        x, f, a = data["delta_over_dy"], data["F_over_Fy"], data["a_over_ay"]
        smooth = CubicSpline(np.r_[0, x], np.r_[1, f / x**1.5])
        part = (x >= 1.2) & (x <= 500)
        self.x, self.f, self.a, self.unloadings = x[part], f[part], a[part], []
        for path in sorted(MATERIALS.glob(f"unloading_{name}_from_*.csv"), key=lambda path: float(path.stem.split("_")[-1])):
            rows = [row.split(",")[1:3] for row in path.read_text().splitlines() if row.startswith("unload,")]
            x_m, (d, force) = float(rows[0][0]), np.array(rows[::-1], float).T
            grid = np.linspace(0, x_m, 20001)
            work, back = np.trapezoid(smooth(grid) * grid**1.5, grid), np.trapezoid(force, d)
            self.unloadings.append((x_m, d, force, np.sqrt(back / work)))

    def material(self, constants):
        return Material(self.ratio, (1 - self.ratio**2) * self.h, constants)

    def errors(self, constants):
        """Errors of force and radius, and of each unloading: (depth, path over F_m, restitution, dent over recovery)."""
        law = self.material(constants)
        unit = law.s0**2
        force = law.s0**3 * law.force(self.x / unit) / self.f - 1
        radius = law.s0 * np.sqrt(law.area(self.x / unit)) / self.a - 1
        back = []
        for x_m, x, f, restitution in self.unloadings:
            k = np.float64(x_m / unit)
            path = (law.s0**3 * law.unloading(k, x / unit) - f) / f[-1]
            rebound = np.sqrt(law.recovered_work(k) / law.work(k)) / restitution - 1
            back.append((x_m, path, rebound, (law.dent(k) * unit - x[0]) / (x_m - x[0])))
        return force, radius, back


def fit(curves, start):
    """Fits all constants at once. Scales of the residuals: force 0.07 %, radius 0.5 %, paths 0.3 % of F_m, restitution 0.2 %,
    recovery 0.3 %."""
    def residuals(constants):
        out = []
        for curve in curves:
            force, radius, back = curve.errors(constants)
            out += [force / 0.0007 / np.sqrt(len(force)), radius / 0.005 / np.sqrt(len(radius))]
            for _, path, rebound, dent in back:
                out += [path / 0.003 / np.sqrt(len(path)), [rebound / 0.002, dent / 0.003]]
        return np.concatenate(out)
    return least_squares(residuals, start, x_scale=np.abs(start)).x


def rounded(constants):
    return [float(f"{value:.{SIGNIFICANT}g}") for value in constants]


def line(curve, constants):
    force, radius, back = curve.errors(constants)
    worst = np.abs(force).argmax()
    text = (f"  {curve.name:7} force {100 * np.sqrt(np.mean(force**2)):.2f} {100 * force[worst]:+.2f} at {curve.x[worst]:5.1f}"
            f"  radius {100 * np.sqrt(np.mean(radius**2)):.2f} {100 * np.abs(radius).max():.2f}  from")
    for x_m, path, rebound, _ in back:
        text += f"  {x_m:g}: {100 * np.abs(path).max():.2f} {100 * rebound:+.2f}"
    return text


def report(curves, constants):
    title = "force in % (rms, worst, where), radius (rms, worst), unloadings (worst of F_m, restitution)"
    print(f"errors: {title}")
    for curve in curves:
        print(line(curve, constants))
    print("the same, each with its curve left out of the fit")
    for curve in curves:
        others = [other for other in curves if other is not curve]
        print(line(curve, fit(others, constants)))


def check(constants):
    """Checks the guarantees of the law for every material up to 1e8 yield indentations; returns the smallest margins."""
    k = 1 + np.geomspace(1e-4, 1e8, 20_001)
    s = np.linspace(0, 1, 101)[1:-1]
    margins = {}

    def note(name, value, where):
        if value < margins.get(name, (np.inf, None))[0]:
            margins[name] = (value, where)

    for ratio in (-0.99, -0.5, 0.0, 0.1, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5):
        for eta in (0.0, 1e-3, 0.01, 0.03, 0.1, 0.3, 1.0, 10.0, np.inf):
            law, where = Material(ratio, eta, constants), (ratio, eta)
            f, slope, w, back, dent, g = law.force(k), law.slope(k), law.work(k), law.recovered_work(k), law.dent(k), law.g(k)
            share = (k / (k - 1)) ** 2
            note("loading below Hertz", ((1 - f / k**1.5) * k / (k - 1)).min(), where)
            note("W_rec < W", ((1 - back / w) * share).min(), where)
            note("W - W_rec grows", (np.diff(w - back) / np.diff(k) / f[1:] * (k / (k - 1))[1:]).min(), where)
            note("dent grows", (np.diff(dent) / np.diff(k) * (k / (k - 1))[1:]).min(), where)
            note("dent above zero", dent.min(), where)
            note("unloading steeper than loading", (f * (1.5 - 0.5 * g) / (k - dent) / slope - 1).min(), where)
            note("loading slope above zero", slope.min(), where)
            note("contact area grows", (np.diff(law.area(k)) / np.diff(k)).min(), where)
            for k_m in 1 + np.geomspace(1e-2, 1e6, 60):
                way = k_m - (k_m - law.dent(k_m)) * (1 - s)
                note("unloading below loading", ((law.force(way) - law.unloading(k_m, way)) / law.force(k_m)).min(), where)
    print("smallest margins over all materials, and the nu and eta of each (all must be above zero)")
    for name, (value, where) in margins.items():
        print(f"  {name}: {value:.3e} at nu = {where[0]}, eta = {where[1]}")
    return margins


def main():
    global LAW
    curves = [Curve(name) for name in (*HARDENING, *RATIOS)]
    itself, LAW = LAW, near_law()
    constants = rounded(fit(curves, START))
    LAW = itself
    print(dict(zip(NAMES, constants)), "growth", *GROWTH)
    written = dict(zip(NAMES, constants)) | {"growth": GROWTH.tolist(), "knots": KNOTS.tolist(), "largest_g": LARGEST_G}
    (HERE / "materials_law.json").write_text(json.dumps(written, indent=2) + "\n")
    report(curves, constants)
    margins = check(constants)
    print("test numbers: nu | eta | k | phi | work | alpha | dent | g")
    for ratio, eta in ((0.3, 0.05), (0.2, 0.0), (0.45, 0.0), (0.4, 0.1)):
        law = Material(ratio, eta, constants)
        for k in (1.5, 10.0, 100.0, 600.0, 5000.0):
            k = np.float64(k)
            row = (law.force(k), law.work(k), law.area(k), law.dent(k), law.g(k))
            print(f"  {ratio} {eta} {k:g} " + " ".join(f"{value:.9e}" for value in row))
    assert all(value > 0 for value, _ in margins.values())


if __name__ == "__main__":
    main()
