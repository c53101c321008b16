"""Machines with kinematic loops in fifty digits, and the linear algebra of loops_precise.py.

Bodies are followed in base coordinates; every coordinate is a screw there, about or along an axis
through a place.
"""

import sys

from mpmath import mp, mpf, norm
from precise import about, cross, square, symmetric, vector

mp.dps = 50
ZERO = mpf(10) ** -35  # what counts as zero
SIZES = {"revolute": (1, 1), "prismatic": (1, 1), "universal": (2, 2), "free": (7, 6)}


def dot(a, b):
    return sum((x * y for x, y in zip(a, b)), mpf(0))


def transposed(rows):
    return [list(column) for column in zip(*rows)]


def apply(rows, x):
    return [dot(row, x) for row in rows]


def attitude_of(quaternion):
    x, y, z, w = quaternion
    k = mp.matrix([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return mp.eye(3) + 2 * w * k + 2 * (k * k)


def eliminated(rows, pivots, right, zero=ZERO):
    """Gauss-Jordan with complete pivoting: the pivots' (row, column), and the reduced rows and right sides."""
    rows, right, done, left = [list(r) for r in rows], [list(r) for r in right], [], set(pivots)
    scale = max((abs(x) for row in rows for x in row), default=mpf(0))
    while True:
        used = {row for row, _ in done}
        open_ = [(abs(rows[i][j]), i, j) for i in range(len(rows)) if i not in used for j in left]
        size, i, j = max(open_, default=(mpf(0), 0, 0))
        if size <= zero * scale:
            return done, rows, right
        done.append((i, j))
        left.remove(j)
        by = rows[i][j]
        rows[i], right[i] = [x / by for x in rows[i]], [x / by for x in right[i]]
        for m in range(len(rows)):
            if m != i and rows[m][j] != 0:
                f = rows[m][j]
                rows[m] = [x - f * y for x, y in zip(rows[m], rows[i])]
                right[m] = [x - f * y for x, y in zip(right[m], right[i])]


def solved(rows, right, zero=ZERO):
    """x of rows x = right, or nothing if it is not determined."""
    n = len(rows[0])
    done, _, right = eliminated(rows, range(n), [[r] for r in right], zero)
    if len(done) < n:
        return None
    x = [mpf(0)] * n
    for i, j in done:
        x[j] = right[i][0]
    return x


def explicit(rows, right, free):
    """G and g of x = G x[free] + g with rows x = right; nothing if x[free] does not determine x."""
    n = len(rows[0])
    done, rows, right = eliminated(rows, [j for j in range(n) if j not in free], [[r] for r in right])
    if len(done) + len(free) < n:
        return None
    pivots = {i for i, _ in done}
    assert all(abs(r[0]) < mpf(10) ** -25 for i, r in enumerate(right) if i not in pivots), "contradiction"
    g, bias = [[mpf(j == f) for f in free] for j in range(n)], [mpf(0)] * n
    for i, j in done:
        g[j], bias[j] = [-rows[i][f] for f in free], right[i][0]
    return g, bias


class Machine:
    def __init__(self, problem):
        self.bodies, self.loops = problem["robot"]["bodies"], problem["loops"]
        self.gravity = vector(problem["gravity"])
        self.first, nq, nv = [], 0, 0
        for body in self.bodies:
            self.first.append((nq, nv))
            nq, nv = nq + SIZES[body["joint"]][0], nv + SIZES[body["joint"]][1]
        self.nv = nv

    def pose(self, q):
        """Attitude and origin of every body; every coordinate's (turns, axis, place) in base coordinates."""
        self.at, self.columns = [], []
        for body, (at, _) in zip(self.bodies, self.first):
            r, p = self.at[body["parent"]] if body["parent"] >= 0 else (mp.eye(3), mp.zeros(3, 1))
            p = p + r * vector(body["placement"]["position"])
            r = r * square(body["placement"]["rotation"])
            kind, axis = body["joint"], vector(body["axis"])
            if kind == "free":
                p, r = p + r * vector(q[at + 4 : at + 7]), r * attitude_of(q[at : at + 4])
                self.columns += [(turns, r[:, k], p) for turns in (True, False) for k in range(3)]
            elif kind == "prismatic":
                along = r * (axis / norm(axis))
                p = p + along * q[at]
                self.columns.append((False, along, p))
            else:
                for k, axis in enumerate([axis] + ([vector(body["axis2"])] if kind == "universal" else [])):
                    self.columns.append((True, r * (axis / norm(axis)), p))
                    r = r * about(axis, q[at + k])
            self.at.append((r, p))

    def of(self, i):
        """The coordinates of a body's own joint."""
        first = self.first[i][1]
        return range(first, first + SIZES[self.bodies[i]["joint"]][1])

    def move(self, qd, qdd):
        """ω, α and acceleration of the origin of every body."""
        self.moving = []
        rest = (mp.zeros(3, 1),) * 3
        for i, (body, (_, p)) in enumerate(zip(self.bodies, self.at)):
            before = body["parent"]
            w, al, a = self.moving[before] if before >= 0 else rest
            d = p - (self.at[before][1] if before >= 0 else mp.zeros(3, 1))
            a = a + cross(al, d) + cross(w, cross(w, d))
            slide = mp.zeros(3, 1)
            for j in self.of(i):
                turns, u, _ = self.columns[j]
                if not turns:
                    # The axes of a free joint turn with the body, those of a slide with its parent:
                    # w is either's.
                    factor = 1 if body["joint"] == "free" else 2
                    a = a + u * qdd[j] + cross(w, u) * (factor * qd[j])
                elif body["joint"] == "free":
                    al, w = al + u * qdd[j], w + u * qd[j]
                else:
                    al = al + u * qdd[j] + cross(w, u) * qd[j]
                    w = w + u * qd[j]
            self.moving.append((w, al, a))

    def torques(self, qd, qdd, gravity=True):
        self.move(qd, qdd)
        tau = [mpf(0)] * self.nv
        for i, (body, (r, p), (w, al, a)) in enumerate(zip(self.bodies, self.at, self.moving)):
            com, inertia = r * vector(body["com"]), r * symmetric(body["inertia_com"]) * r.T
            accel = a + cross(al, com) + cross(w, cross(w, com)) - (self.gravity if gravity else mp.zeros(3, 1))
            force, moment = mpf(body["mass"]) * accel, inertia * al + cross(w, inertia * w)
            while i >= 0:
                for j in self.of(i):
                    turns, u, at = self.columns[j]
                    tau[j] += dot(u, moment + cross(p + com - at, force)) if turns else dot(u, force)
                i = self.bodies[i]["parent"]
        return tau

    def mass_matrix(self):
        still = [mpf(0)] * self.nv
        return [self.torques(still, [mpf(i == j) for i in range(self.nv)], gravity=False) for j in range(self.nv)]

    def ends(self):
        """By loops: body and place of predecessor and successor."""
        for loop in self.loops:
            both = []
            for body, placement in zip(loop["bodies"], loop["placements"]):
                r, p = self.at[body] if body >= 0 else (mp.eye(3), mp.zeros(3, 1))
                both.append((body, p + r * vector(placement["position"])))
            yield both

    def gap(self):
        return [x for (_, p), (_, s) in self.ends() for x in s - p]

    def rows(self):
        """K of the gap."""
        rows = []
        for both in self.ends():
            block = [[mpf(0)] * self.nv for _ in range(3)]
            for sign, (i, place) in zip((-1, 1), both):
                while i >= 0:
                    for j in self.of(i):
                        turns, u, at = self.columns[j]
                        moved = cross(u, place - at) if turns else u
                        for k in range(3):
                            block[k][j] += sign * moved[k]
                    i = self.bodies[i]["parent"]
            rows += block
        return rows

    def bias(self, qd):
        """k of K q'' = k."""
        self.move(qd, [mpf(0)] * self.nv)
        out = []
        for both in self.ends():
            accelerations = []
            for i, place in both:
                if i < 0:
                    accelerations.append(mp.zeros(3, 1))
                    continue
                (w, al, a), d = self.moving[i], place - self.at[i][1]
                accelerations.append(a + cross(al, d) + cross(w, cross(w, d)))
            out += list(accelerations[0] - accelerations[1])
        return out

    def step(self, q, dq):
        """q moved by dq."""
        q = list(q)
        for i, (body, (at, first)) in enumerate(zip(self.bodies, self.first)):
            if body["joint"] != "free":
                for k in range(SIZES[body["joint"]][0]):
                    q[at + k] += dq[first + k]
                continue
            x, y, z, w = q[at : at + 4]
            a, b, c = (d / 2 for d in dq[first : first + 3])
            new = [x + w * a + y * c - z * b, y + w * b + z * a - x * c]
            new += [z + w * c + x * b - y * a, w - x * a - y * b - z * c]
            if any(dq[first : first + 3]):
                new = [n / mp.sqrt(dot(new, new)) for n in new]
            slide = self.at[i][0] * mp.matrix(dq[first + 3 : first + 6])
            q[at : at + 7] = new + [q[at + 4 + k] + slide[k] for k in range(3)]
        return q

    def close(self, q, held):
        """Newton's method in the coordinates that are not held; quaternions at length one."""
        q = list(q)
        for body, (at, _) in zip(self.bodies, self.first):
            if body["joint"] == "free":
                length = mp.sqrt(dot(q[at : at + 4], q[at : at + 4]))
                q[at : at + 4] = [x / length for x in q[at : at + 4]]
        for _ in range(40):
            self.pose(q)
            gap = self.gap()
            if max(abs(x) for x in gap) < mpf(10) ** -45:
                return q
            others = [j for j in range(self.nv) if j not in held]
            done, _, right = eliminated(self.rows(), others, [[-x] for x in gap])
            dq = [mpf(0)] * self.nv
            for i, j in done:
                dq[j] = right[i][0]
            most = max(abs(x) for x in dq)
            q = self.step(q, [x * min(1, mpf("0.5") / most) for x in dq])
        sys.exit(f"a loop does not close: {mp.nstr(max(abs(x) for x in gap), 3)} m")


class Gamma(Machine):
    """q as sums of polynomials of y, which are its first coordinates' places in the state."""

    def __init__(self, problem):
        super().__init__(problem)
        self.gamma = problem["gamma"]  # by coordinates of q and of y: coefficients

    def maps(self, y, yd):
        at = lambda coefficients, y, d: mp.fsum(
            mp.ff(k, d) * mpf(c) * y ** (k - d) for k, c in enumerate(coefficients) if k >= d
        )
        q = [mp.fsum(at(c, y[k], 0) for k, c in enumerate(row)) for row in self.gamma]
        g = [[at(c, y[k], 1) for k, c in enumerate(row)] for row in self.gamma]
        bias = [mp.fsum(at(c, y[k], 2) * yd[k] ** 2 for k, c in enumerate(row)) for row in self.gamma]
        return q, g, bias
