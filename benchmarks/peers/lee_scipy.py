#!/usr/bin/python3
"""Lee's frame with NumPy and SciPy, as one would write it there: all elements at once, one sparse LU an iteration.

    lee_scipy.py ELEMENTS

The same elements, metric and steps as chain_yardstick.cpp; prints figures as that does.
"""

import sys
import time

import numpy as np
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu

SIDE, EA, EI = 120.0, 4320.0, 1440.0  # [cm], [kN], [kN cm²]
END_DOWN = 90.0  # [cm]
TOLERANCE, LONGEST, MOST_ITERATIONS = 1e-8, 0.05, 8


def wrapped(angle):
    return angle - 2.0 * np.pi * np.rint(angle / (2.0 * np.pi))


def outer(a, b):
    return a[:, :, None] * b[:, None, :]


class Frame:
    def __init__(self, elements):
        column = elements // 2
        beam = elements - column
        self.elements, self.size = elements, 3 * (elements + 1)
        self.loaded = 3 * (column + beam // 5) + 1
        upright = np.arange(elements) < column
        self.dx0 = np.where(upright, 0.0, SIDE / beam)
        self.dz0 = np.where(upright, SIDE / column, 0.0)
        self.length = np.hypot(self.dx0, self.dz0)
        self.unknowns = 3 * np.arange(elements)[:, None] + np.arange(6)
        self.pins = np.array([0, 1, self.size - 3, self.size - 2])
        self.load = np.zeros(self.size)
        self.load[self.loaded] = -1.0
        self._lay_out()

    def _lay_out(self):
        """Where each entry of each element goes among the values of K; rows of pins are those of a unit matrix."""
        held = np.isin(np.arange(self.size), self.pins)
        rows, columns = np.repeat(self.unknowns, 6, axis=1).ravel(), np.tile(self.unknowns, (1, 6)).ravel()
        self.free = ~(held[rows] | held[columns])
        keys = np.r_[columns[self.free], self.pins] * self.size + np.r_[rows[self.free], self.pins]
        places, self.slots = np.unique(keys, return_inverse=True)
        self.rows = (places % self.size).astype(np.int32)
        self.starts = np.r_[0, np.cumsum(np.bincount(places // self.size, minlength=self.size))].astype(np.int32)

    def linearized(self, u, lam):
        q = u[self.unknowns]
        dx, dz = self.dx0 + q[:, 3] - q[:, 0], self.dz0 + q[:, 4] - q[:, 1]
        L, L0 = np.hypot(dx, dz), self.length
        c, s, one, zero = dx / L, dz / L, np.ones_like(L), np.zeros_like(L)
        turn = np.arctan2(self.dx0 * s - self.dz0 * c, self.dx0 * c + self.dz0 * s)
        t1, t2 = wrapped(q[:, 2] - turn), wrapped(q[:, 5] - turn)
        k = 2.0 * EI / L0
        M1, M2 = k * (2.0 * t1 + t2), k * (t1 + 2.0 * t2)
        N, h = EA * (L * L - L0 * L0) / ((L + L0) * L0), (M1 + M2) / (L * L)
        r, z = np.stack([-c, -s, zero, c, s, zero], 1), np.stack([s, -c, zero, -s, c, zero], 1)
        b1 = np.stack([-s / L, c / L, one, s / L, -c / L, zero], 1)
        b2 = np.stack([-s / L, c / L, zero, s / L, -c / L, one], 1)
        force = N[:, None] * r + M1[:, None] * b1 + M2[:, None] * b2
        at = (slice(None), None, None)
        K = ((EA / L0)[at] * outer(r, r) + (N / L)[at] * outer(z, z) + h[at] * (outer(r, z) + outer(z, r))
             + k[at] * (2.0 * outer(b1, b1) + outer(b1, b2) + outer(b2, b1) + 2.0 * outer(b2, b2)))
        F = np.bincount(self.unknowns.ravel(), force.ravel(), self.size) - lam * self.load
        F[self.pins] = 0.0
        values = np.bincount(self.slots, np.r_[K.ravel()[self.free], np.ones(4)], self.rows.size)
        return F, csc_matrix((values, self.rows, self.starts), shape=(self.size, self.size))

    def line(self, u, lam):
        F, K = self.linearized(u, lam)
        x = splu(K).solve(np.stack([-F, self.load], 1))
        return x[:, 0], x[:, 1]


def trace(frame):
    weight = 1.0 / ((frame.elements + 1) * SIDE * SIDE)
    u, last, lam, last_lam, length = np.zeros(frame.size), np.zeros(frame.size), 0.0, 1.0, 0.005
    steps, iterations, limit, turned = 0, 1, 0.0, False
    _, along = frame.line(u, lam)
    while -u[frame.loaded] < END_DOWN:
        sense = 1.0 if weight * along.dot(last) + last_lam >= 0.0 else -1.0
        tangent_lam = sense / np.sqrt(weight * along.dot(along) + 1.0)
        tangent, start, start_lam, arrived = tangent_lam * along, u, lam, False
        while not arrived:
            u, lam = start + length * tangent, start_lam + length * tangent_lam
            for used in range(1, MOST_ITERATIONS + 1):
                step, along = frame.line(u, lam)
                iterations += 1
                dlam = -weight * tangent.dot(step) / (weight * tangent.dot(along) + tangent_lam)
                step = step + dlam * along
                u, lam = u + step, lam + dlam
                size = np.sqrt(weight * step.dot(step) + dlam * dlam)
                arrived = size < TOLERANCE
                if arrived or not size < 1.0:
                    break
            if not arrived:
                length *= 0.5
        steps += 1
        last, last_lam = u - start, lam - start_lam
        turned = turned or last_lam < 0.0
        if not turned:
            limit = lam
        if used <= 3:
            length = min(1.5 * length, LONGEST)
        elif used > 5:
            length *= 0.7
    return steps, iterations, limit


def main():
    elements = int(sys.argv[1])
    frame = Frame(elements)
    start = time.process_time()
    steps, iterations, limit = trace(frame)
    used = time.process_time() - start
    for figure, unit, value in (("path", "s", used), ("points", "", steps), ("iterations", "", iterations),
                                ("first limit", "kN", limit),
                                ("per iteration and element", "us", 1e6 * used / (iterations * elements))):
        print(f"lee,{elements},{figure},{unit},{value:.10g}")


if __name__ == "__main__":
    main()
