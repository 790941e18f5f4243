"""Finite elements of a rigid sphere on a half-space that hardens and has any Poisson's ratio.

    python -m venv venv && venv/bin/pip install -r requirements.txt
    venv/bin/python finite_elements.py ../truth/both NU H [NU H ...]

Writes `loading_nuNU_H.csv` for each pair of Poisson's ratio and `H = H/E`: indentation and force in the units of
../truth (d_y and F_y from a mean pressure of 1.1 S), as computed and smoothed over the steps from node to node. A run
takes some minutes.

Small strain, a parabola without friction, von Mises' yield condition, linear isotropic hardening sigma = S + H eps_p.
Axisymmetric elements with four nodes and a mean volumetric strain (B-bar), radial return with consistent tangent.
The elements grow with the distance from the first contact, so that a contact radius always has some 30 of them; the outer
boundary is at 3000 times the largest one. The surface is in contact where it is pressed and below the sphere.

Unit of length: a_y = sqrt(R d_y); of stress: E*.
"""
import sys
from pathlib import Path
import numpy as np
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu

# Yield strength over E*; in small strain it changes nothing in the normalised curve.
STRENGTH = 1e-3
# d_y in units of a_y, and the radius of the sphere: a_y^2 = R d_y.
D_Y = 3.0 * np.pi * 1.1 * STRENGTH / 4.0
RADIUS = 1.0 / D_Y
F_Y = np.pi * 1.1 * STRENGTH
GAUSS = 1.0 / np.sqrt(3.0)
# Largest out-of-balance force, relative to that of the contact.
TOLERANCE = 1e-8
# Steps of the indentation.
FIRST, LAST, GROWTH = 0.4, 110.0, 1.05
# Width of the smoothing, in logarithms of the indentation.
WIDTH = 0.2


def grid(smallest, growth, fine_end, far_growth, end):
    """Coordinates whose distances grow with the coordinate, faster beyond `fine_end`."""
    points, step = [0.0], smallest
    while points[-1] < end:
        points.append(points[-1] + step)
        inside = points[-1] < fine_end
        step = max(step, smallest + growth * points[-1] - growth * smallest) if inside else step * far_growth
    return np.array(points)


class Mesh:
    def __init__(self):
        r = np.concatenate([np.linspace(0.0, 3.0, 31)[:-1], 3.0 * np.exp(np.arange(60) / 30.0)])
        r = r[r < 17.0]
        r = np.concatenate([r, r[-1] + np.cumsum(0.55 * 1.5 ** np.arange(30))])
        r = r[r < 45e3]
        z = grid(0.1, 0.05, 30.0, 1.5, 45e3)
        self.r, self.z = r, z
        columns, rows = len(r), len(z)
        node = np.arange(columns * rows).reshape(columns, rows)
        quads = [node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]]
        self.quads = np.stack([corner.ravel() for corner in quads], axis=1)
        self.place = np.stack(np.meshgrid(r, z, indexing="ij"), axis=-1).reshape(-1, 2)
        self.top = node[:, 0]
        self.count = 2 * columns * rows
        fixed = np.zeros((columns * rows, 2), bool)
        fixed[node[0], 0] = True
        fixed[node[-1]] = True
        fixed[node[:, -1]] = True
        self.fixed = fixed.ravel()
        self.dofs = np.stack([2 * self.quads, 2 * self.quads + 1], axis=2).reshape(len(self.quads), 8)
        self.strains()
        # the places of the elements' entries in the matrix, once
        rows = np.repeat(self.dofs, 8, axis=1).ravel()
        columns = np.tile(self.dofs, (1, 8)).ravel()
        places, self.slot = np.unique(columns.astype(np.int64) * self.count + rows, return_inverse=True)
        self.rows, entries = (places % self.count).astype(np.int32), places // self.count
        self.starts = np.searchsorted(entries, np.arange(self.count + 1)).astype(np.int32)

    def strains(self):
        """Matrices of the strains rr, zz, tt, rz at four points of each element, with the mean volumetric strain."""
        corners = self.place[self.quads]
        matrices, weights = [], []
        for xi, eta in [(-GAUSS, -GAUSS), (GAUSS, -GAUSS), (GAUSS, GAUSS), (-GAUSS, GAUSS)]:
            shape = 0.25 * np.array([(1 - xi) * (1 - eta), (1 + xi) * (1 - eta), (1 + xi) * (1 + eta), (1 - xi) * (1 + eta)])
            by_xi = 0.25 * np.array([-(1 - eta), 1 - eta, 1 + eta, -(1 + eta)])
            by_eta = 0.25 * np.array([-(1 - xi), -(1 + xi), 1 + xi, 1 - xi])
            jacobian = np.einsum("kn,eni->eki", np.stack([by_xi, by_eta]), corners)
            slopes = np.einsum("eik,kn->ein", np.linalg.inv(jacobian), np.stack([by_xi, by_eta]))
            radius = corners[:, :, 0] @ shape
            matrix = np.zeros((len(corners), 4, 8))
            matrix[:, 0, 0::2] = slopes[:, 0]
            matrix[:, 1, 1::2] = slopes[:, 1]
            matrix[:, 2, 0::2] = shape / radius[:, None]
            matrix[:, 3, 0::2] = slopes[:, 1]
            matrix[:, 3, 1::2] = slopes[:, 0]
            matrices.append(matrix)
            weights.append(2.0 * np.pi * radius * np.linalg.det(jacobian))
        matrix, self.weight = np.stack(matrices, axis=1), np.stack(weights, axis=1)
        volumetric = matrix[:, :, :3].sum(axis=2)
        mean = np.einsum("eg,egd->ed", self.weight, volumetric) / self.weight.sum(axis=1)[:, None]
        matrix[:, :, :3] += ((mean[:, None] - volumetric) / 3.0)[:, :, None]
        self.matrix = matrix


class Material:
    def __init__(self, poissons_ratio, hardening):
        # E* = 1 for a rigid sphere
        modulus = 1.0 - poissons_ratio**2
        self.shear = modulus / (2.0 * (1.0 + poissons_ratio))
        self.bulk = modulus / (3.0 * (1.0 - 2.0 * poissons_ratio))
        self.hardening = hardening * modulus

    def stress(self, strain, plastic, accumulated):
        """Stress, consistent tangent, plastic strain and accumulated plastic strain for a total strain."""
        shear, hardening = self.shear, self.hardening
        elastic = strain - plastic
        volume = elastic[..., :3].sum(axis=-1)
        deviator = 2.0 * shear * elastic
        deviator[..., :3] -= 2.0 * shear / 3.0 * volume[..., None]
        # the fourth strain is twice that of a tensor
        deviator[..., 3] *= 0.5
        norm = np.sqrt(np.sum(deviator[..., :3] ** 2, axis=-1) + 2.0 * deviator[..., 3] ** 2)
        trial = np.sqrt(1.5) * norm
        excess = trial - (STRENGTH + hardening * accumulated)
        yields = excess > 0.0
        more = np.where(yields, excess / (3.0 * shear + hardening), 0.0)
        safe = np.where(trial > 0.0, trial, 1.0)
        ratio = 1.0 - 3.0 * shear * more / safe
        stress = ratio[..., None] * deviator
        stress[..., :3] += self.bulk * volume[..., None]
        direction = deviator / np.where(norm > 0.0, norm, 1.0)[..., None]
        flow = np.sqrt(1.5) * direction * more[..., None]
        flow[..., 3] *= 2.0
        tangent = np.zeros(strain.shape + (4,))
        for i in range(3):
            tangent[..., i, i] += 2.0 * shear * ratio
            for j in range(3):
                tangent[..., i, j] += self.bulk - 2.0 * shear * ratio / 3.0
        tangent[..., 3, 3] += shear * ratio
        change = np.where(yields, 6.0 * shear**2 * (more / safe - 1.0 / (3.0 * shear + hardening)), 0.0)
        tangent += change[..., None, None] * direction[..., :, None] * direction[..., None, :]
        return stress, tangent, plastic + flow, accumulated + more


class Contact:
    def __init__(self, mesh, material):
        self.mesh, self.material = mesh, material
        self.shift = np.zeros(mesh.count)
        points = mesh.weight.shape
        self.plastic, self.accumulated = np.zeros(points + (4,)), np.zeros(points)
        self.pressed, self.depth = mesh.r < np.sqrt(FIRST), 0.0

    def balance(self, shift):
        mesh = self.mesh
        strain = np.einsum("egsd,ed->egs", mesh.matrix, shift[mesh.dofs])
        stress, tangent, plastic, accumulated = self.material.stress(strain, self.plastic, self.accumulated)
        weighted = mesh.matrix * mesh.weight[:, :, None, None]
        inner = np.einsum("egsd,egs->ed", weighted, stress)
        forces = np.bincount(mesh.dofs.ravel(), inner.ravel(), mesh.count)
        return forces, (weighted, tangent), (plastic, accumulated)

    def reach(self, indentation, cuts=6):
        """The same as `press`, in smaller steps where a step finds no balance."""
        last, pressed = self.depth, self.pressed.copy()
        try:
            force = self.press(indentation)
        except RuntimeError:
            if cuts == 0:
                raise
            self.pressed = pressed
            self.reach(0.5 * (last + indentation), cuts - 1)
            return self.reach(indentation, cuts - 1)
        self.depth = indentation
        return force

    def press(self, indentation):
        """Moves the sphere to this indentation; returns the force."""
        mesh = self.mesh
        vertical = 2 * mesh.top + 1
        goal = indentation - mesh.r**2 / (2.0 * RADIUS)
        shift = self.shift.copy()
        for _ in range(30):
            # the surface moves to the sphere together with the rest, from the last balance on
            jump = np.zeros(mesh.count)
            jump[vertical[self.pressed]] = goal[self.pressed] - shift[vertical[self.pressed]]
            forces, (weighted, tangent), state = self.balance(shift)
            held = mesh.fixed.copy()
            held[vertical[self.pressed]] = True
            rest = np.where(held, 0.0, -forces)
            force = forces[vertical[self.pressed]].sum()
            if not jump.any() and np.abs(rest).max() < TOLERANCE * abs(force):
                pulled = self.pressed & (forces[vertical] < 0.0)
                beneath = ~self.pressed & (shift[vertical] < goal)
                if not pulled.any() and not beneath.any():
                    self.shift, (self.plastic, self.accumulated) = shift, state
                    return force
                self.pressed = (self.pressed & ~pulled) | beneath
                continue
            stiff = np.einsum("egsd,egst,egtf->edf", weighted, tangent, mesh.matrix, optimize=True)
            data = np.bincount(mesh.slot, stiff.ravel(), len(mesh.rows))
            matrix = csc_matrix((data, mesh.rows, mesh.starts), shape=(mesh.count, mesh.count))
            free = np.flatnonzero(~held)
            right = (rest - matrix @ jump)[free]
            solver = splu(matrix[free][:, free], permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True},
                          diag_pivot_thresh=0.0)
            jump[free] = solver.solve(right)
            shift += jump
            shift[vertical[self.pressed]] = goal[self.pressed]
        raise RuntimeError(f"no balance at {indentation / D_Y} d_y")


def smooth(x, force):
    """A local parabola in logarithms, over the steps from node to node."""
    across, up = np.log(x), np.log(force)
    result = []
    for place in across:
        weight = np.clip(1.0 - ((across - place) / WIDTH) ** 2, 0.0, None)
        result.append(np.polyfit(across - place, up, 2, w=np.sqrt(weight))[2])
    return np.exp(result)


def run(poissons_ratio, hardening):
    contact = Contact(Mesh(), Material(poissons_ratio, hardening))
    x, force = [], []
    depth = FIRST
    while depth <= LAST:
        x.append(depth)
        force.append(contact.reach(depth * D_Y) / F_Y)
        depth *= GROWTH
    return np.array(x), np.array(force)


def main():
    folder, numbers = Path(sys.argv[1]), [float(text) for text in sys.argv[2:]]
    folder.mkdir(exist_ok=True)
    for poissons_ratio, hardening in zip(numbers[::2], numbers[1::2]):
        x, force = run(poissons_ratio, hardening)
        rows = np.stack([x, force, smooth(x, force)], axis=1)
        name = folder / f"loading_nu{poissons_ratio:g}_H{hardening:g}.csv"
        header = "delta_over_dy,F_over_Fy_raw,F_over_Fy"
        np.savetxt(name, rows, delimiter=",", fmt="%.8g", header=header, comments="")


if __name__ == "__main__":
    main()
