"""Fifty-digit answers to the hard cases, from the very bits that the library computes with.

    cargo run -p host-reports --bin hard_inputs | python host-tests/oracle/hard.py

writes host-tests/recordings/hard/CASE.json. Nothing here is the library's way: bodies are followed in base
coordinates, torques are moments of Newton's and Euler's forces about each axis, M is a column per unit
acceleration, and mobility is J M^-1 J^T by Cholesky's method.
"""

import struct

import mpmath
import numpy as np
from mpmath import mp, mpf
from recorded import of_cases

mp.dps = 50


def exact(bits):
    return mpf(struct.unpack(">f", bytes.fromhex(bits))[0])


def numbers(row):
    return [exact(bits) for bits in row]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def add(*vectors):
    return [sum(parts) for parts in zip(*vectors)]


def times(s, v):
    return [s * x for x in v]


def apply(m, v):
    return [dot(row, v) for row in m]


def product(a, b):
    columns = list(zip(*b))
    return [[dot(row, column) for column in columns] for row in a]


def rotation(columns):
    """The rotation nearest to what rounding left of one, by Newton's iteration; rows."""
    m = mpmath.matrix([columns[0:3], columns[3:6], columns[6:9]]).T
    for _ in range(8):
        m = (m + (m**-1).T) / 2
    return [[m[i, j] for j in range(3)] for i in range(3)]


def symmetric(six):
    xx, xy, xz, yy, yz, zz = six
    return [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]


class Body:
    def __init__(self, link):
        self.parent, self.slides = link["parent"], link["kind"] == "prismatic"
        # Given is the rotation of coordinates from the parent's frame: its transpose is the
        # attitude.
        self.attitude = [list(row) for row in zip(*rotation(numbers(link["rot"])))]
        self.place = numbers(link["pos"])
        self.mass, self.moment = exact(link["mass"]), numbers(link["moment"])
        nine = numbers(link["inertia"])
        self.inertia = [nine[0:3], nine[3:6], nine[6:9]]

    def carry(self, mass, com, six):
        """Adds a load, given about its centre of mass."""
        cc = dot(com, com)
        self.mass += mass
        self.moment = add(self.moment, times(mass, com))
        about = symmetric(six)
        self.inertia = [
            [self.inertia[i][j] + about[i][j] + mass * ((cc if i == j else 0) - com[i] * com[j]) for j in range(3)]
            for i in range(3)
        ]


class Arm:
    def __init__(self, problem):
        self.bodies = [Body(link) for link in problem["links"]]
        self.bodies[-1].carry(exact(problem["payload"]), numbers(problem["payload_at"]), numbers(problem["payload_inertia"]))
        self.gravity, self.rotors = numbers(problem["gravity"]), numbers(problem["rotors"])
        self.tip_frame = rotation(numbers(problem["tip_frame"]))  # described to aligned coordinates

    def pose(self, q):
        """Attitude, origin and axis of every body in base coordinates; the joints' axes are z."""
        self.at = []
        for body, turn in zip(self.bodies, q):
            r, p = (self.at[body.parent][:2]) if body.parent >= 0 else ([[mpf(i == j) for j in range(3)] for i in range(3)], [mpf(0)] * 3)
            here, attitude = add(p, apply(r, body.place)), product(r, body.attitude)
            axis = [row[2] for row in attitude]
            if body.slides:
                here = add(here, times(turn, axis))
            else:
                c, s = mp.cos(turn), mp.sin(turn)
                attitude = product(attitude, [[c, -s, 0], [s, c, 0], [0, 0, 1]])
            self.at.append((attitude, here, axis))
        self.loads = []
        for body, (r, _, _) in zip(self.bodies, self.at):
            turned = product(product(r, body.inertia), [list(row) for row in zip(*r)])
            self.loads.append((body.mass, apply(r, body.moment), turned))

    def torques(self, qd, qdd, gravity=True):
        """Newton and Euler in base coordinates, all moments about the base's origin."""
        zero, moving, forces = [mpf(0)] * 3, [], []
        for body, (_, p, axis), rate, accel, (mass, h, inertia) in zip(self.bodies, self.at, qd, qdd, self.loads):
            p0 = self.at[body.parent][1] if body.parent >= 0 else zero
            w, al, a = moving[body.parent] if body.parent >= 0 else (zero, zero, zero)
            d = add(p, times(-1, p0))
            a = add(a, cross(al, d), cross(w, cross(w, d)))
            if body.slides:
                a = add(a, times(accel, axis), times(2 * rate, cross(w, axis)))
            else:
                al = add(al, times(accel, axis), times(rate, cross(w, axis)))
                w = add(w, times(rate, axis))
            moving.append((w, al, a))
            felt = add(a, times(-1, self.gravity)) if gravity else a
            force = add(times(mass, felt), cross(al, h), cross(w, cross(w, h)))
            couple = add(apply(inertia, al), cross(w, apply(inertia, w)), cross(h, felt))
            forces.append([force, add(couple, cross(p, force))])
        tau = [mpf(0)] * len(self.bodies)
        for i in reversed(range(len(self.bodies))):
            body, (_, p, axis), (force, moment) = self.bodies[i], self.at[i], forces[i]
            tau[i] = dot(axis, force) if body.slides else dot(axis, add(moment, times(-1, cross(p, force))))
            tau[i] += self.rotors[i] * qdd[i]
            if body.parent >= 0:
                forces[body.parent] = [add(x, y) for x, y in zip(forces[body.parent], forces[i])]
        return tau

    def matrix(self):
        n, still = len(self.bodies), [mpf(0)] * len(self.bodies)
        return [self.torques(still, [mpf(i == j) for i in range(n)], gravity=False) for j in range(n)]

    def tip_rows(self):
        """The rows of the Jacobian of the last body's origin, along that body's own axes as described."""
        r, tip, _ = self.at[-1]
        own = product(r, self.tip_frame)
        carried, at = set(), len(self.bodies) - 1
        while at >= 0:
            carried.add(at)
            at = self.bodies[at].parent
        columns = []
        for i, (body, (_, p, axis)) in enumerate(zip(self.bodies, self.at)):
            moved = axis if body.slides else cross(axis, add(tip, times(-1, p)))
            columns.append(moved if i in carried else [mpf(0)] * 3)
        return [[dot([own[0][k], own[1][k], own[2][k]], column) for column in columns] for k in range(3)]


def cholesky(m):
    """L of M = L L^T by rows, or nothing."""
    n, rows = len(m), []
    for i in range(n):
        row = []
        for j in range(i + 1):
            rest = m[i][j] - sum(row[k] * (rows[j][k] if j < i else row[k]) for k in range(j))
            if j < i:
                row.append(rest / rows[j][j])
            elif rest > mpf(10) ** -35 * m[i][i]:
                row.append(mp.sqrt(rest))
            else:
                return None
        rows.append(row)
    return rows


def solve(l, b):
    n, y = len(l), []
    for i in range(n):
        y.append((b[i] - sum(l[i][k] * y[k] for k in range(i))) / l[i][i])
    for i in reversed(range(n)):
        y[i] = (y[i] - sum(l[k][i] * y[k] for k in range(i + 1, n))) / l[i][i]
    return y


def single(x):
    return struct.pack(">f", float(np.float32(float(x)))).hex()


def record(problem):
    arm, states, worst = Arm(problem), [], 0.0
    for state in problem["states"]:
        q, qd, qdd = numbers(state["q"]), numbers(state["qd"]), numbers(state["qdd"])
        arm.pose(q)
        still = [mpf(0)] * len(q)
        told = arm.torques(qd, qdd)
        tau = [single(x) for x in told]  # what forward dynamics is given
        m = arm.matrix()
        l = cholesky(m)
        row = {"rnea": [float(x) for x in told], "tau": tau, "qdd": None, "mobility": None}
        if l is not None:
            bias = arm.torques(qd, still)
            row["qdd"] = [float(x) for x in solve(l, [t - b for t, b in zip(numbers(tau), bias)])]
            rows = arm.tip_rows()
            columns = [solve(l, r) for r in rows]
            row["mobility"] = [float(sum(a * b for a, b in zip(r, c))) for r in rows for c in columns]
            scaled = np.array([[float(m[i][j]) for j in range(len(q))] for i in range(len(q))])
            worst = max(worst, float(np.linalg.cond(scaled)))
        states.append(row)
    return {"name": problem["name"], "inputs": problem["inputs"], "condition": worst or None, "states": states}


if __name__ == "__main__":
    of_cases("hard", record)
