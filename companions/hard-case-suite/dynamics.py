"""Dynamics of a tree of rigid bodies in 50 digits, in plain mpmath and without any library of
dynamics.

Inverse dynamics is the recursive Newton-Euler algorithm (Featherstone, "Rigid Body Dynamics
Algorithms", 2008, table 5.1), written with vectors of three numbers in the frame of each link. The
mass matrix is a column a unit acceleration, and forward dynamics is Cholesky's factorisation of it.
"""

from mpmath import mp, mpf

DIGITS = 50
mp.dps = 90  # Cancellation may cost 40 digits before an answer has less than fifty.


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def add(a, b):
    return [a[0] + b[0], a[1] + b[1], a[2] + b[2]]


def times(s, a):
    return [s * a[0], s * a[1], s * a[2]]


def apply(m, a):
    return [dot(row, a) for row in m]


def transposed(m):
    return [list(column) for column in zip(*m)]


def product(a, b):
    return transposed([apply(a, column) for column in transposed(b)])


def length(a):
    return mp.sqrt(dot(a, a))


def nearest_rotation(m):
    """The rotation that the f64 numbers of `m` stand for, by Newton's iteration."""
    m = mp.matrix(m)
    for _ in range(8):
        m = (m + (m**-1).T) / 2
    return [[m[i, j] for j in range(3)] for i in range(3)]


def about(axis, angle):
    """The rotation by an angle about an axis of length 1 (Rodrigues)."""
    s, c = mp.sin(angle), mp.cos(angle)
    x, y, z = axis
    skew = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
    return [[(1 - c) * axis[i] * axis[j] + s * skew[i][j] + (c if i == j else 0) for j in range(3)] for i in range(3)]


def gyroscopic(inertia, w):
    """|ω × I ω| without cancellation in the link's own axes."""
    spin = [abs(x) for x in w]
    momentum = apply([[abs(x) for x in row] for row in inertia], spin)
    x, y, z = [(spin[i], momentum[i]) for i in range(3)]
    pairs = [(y, z), (z, x), (x, y)]
    return length([a[0] * b[1] + b[0] * a[1] for a, b in pairs])


class Link:
    def __init__(self, link):
        exact = lambda row: [mpf(x) for x in row]
        self.parent, self.slides = link["parent"], link["joint"] == "prismatic"
        axis = exact(link["axis"])
        self.axis = times(1 / length(axis), axis)
        self.rotation = nearest_rotation([exact(row) for row in link["rotation"]])
        self.translation, self.com = exact(link["translation"]), exact(link["com"])
        self.mass, self.armature = mpf(link["mass"]), mpf(link["armature"])
        xx, xy, xz, yy, yz, zz = exact(link["inertia"])
        self.inertia = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
        self.norm = mp.sqrt(sum(dot(row, row) for row in self.inertia))


class Tree:
    """A robot in a configuration."""

    def __init__(self, robot, q):
        self.links = [Link(link) for link in robot["links"]]
        self.gravity = [mpf(x) for x in robot["gravity"]]
        self.n, self.attitude, self.place, self.world = len(self.links), [], [], []
        for link, turn in zip(self.links, q):
            turn = mpf(turn)
            e, p = link.rotation, link.translation
            if link.slides:
                p = add(p, apply(e, times(turn, link.axis)))
            else:
                e = product(e, about(link.axis, turn))
            self.attitude.append(e)  # of the link in its parent
            self.place.append(p)
            up, at = self.world[link.parent] if link.parent >= 0 else (None, None)
            self.world.append((product(up, e), add(at, apply(up, p))) if up else (e, p))

    def torques(self, qd, qdd, gravity=True):
        """Inverse dynamics, and the size of what adds up to each torque: the same sums of norms, so
        that no term cancels."""
        zero, motion, loads, norms, own = [mpf(0)] * 3, [], [], [], []
        for i, link in enumerate(self.links):
            down = transposed(self.attitude[i])
            if link.parent >= 0:
                (w, dw, a), (dw_size, a_size) = motion[link.parent], norms[link.parent]
            else:
                w, dw, a = zero, zero, times(-1, self.gravity) if gravity else zero
                dw_size, a_size = mpf(0), length(a)
            r = self.place[i]
            a_size += (dw_size + dot(w, w)) * length(r)
            a = apply(down, add(a, add(cross(dw, r), cross(w, cross(w, r)))))
            w, dw = apply(down, w), apply(down, dw)
            rate, accel = times(qd[i], link.axis), times(qdd[i], link.axis)
            if link.slides:
                a = add(a, add(accel, times(2, cross(w, rate))))
                a_size += abs(qdd[i]) + 2 * length(w) * abs(qd[i])
            else:
                dw = add(dw, add(accel, cross(w, rate)))
                dw_size += abs(qdd[i]) + length(w) * abs(qd[i])
                w = add(w, rate)
            motion.append((w, dw, a))
            c = link.com
            force = times(link.mass, add(a, add(cross(dw, c), cross(w, cross(w, c)))))
            couple = add(apply(link.inertia, dw), cross(w, apply(link.inertia, w)))
            norms.append((dw_size, a_size))
            turning = dw_size + dot(w, w)
            own.append((link.mass * (a_size + turning * length(c)), dw_size * link.norm + gyroscopic(link.inertia, w)))
            loads.append([force, add(couple, cross(c, force))])
        tau = [None] * self.n
        for i in reversed(range(self.n)):
            link, (force, moment) = self.links[i], loads[i]
            tau[i] = dot(link.axis, force if link.slides else moment) + link.armature * qdd[i]
            if link.parent >= 0:
                force, moment = apply(self.attitude[i], force), apply(self.attitude[i], moment)
                to = loads[link.parent]
                to[0], to[1] = add(to[0], force), add(to[1], add(moment, cross(self.place[i], force)))
        return tau, self.sizes(own, qdd)

    def sizes(self, own, qdd):
        """For each joint, the sum over the bodies it moves of |couple| + |arm| |force|; |force| if
        it slides."""
        sums = [link.armature * abs(x) for link, x in zip(self.links, qdd)]
        for j, (force, couple) in enumerate(own):
            attitude, at = self.world[j]
            centre, i = add(at, apply(attitude, self.links[j].com)), j
            while i >= 0:
                arm = length(add(centre, times(-1, self.world[i][1])))
                sums[i] += force if self.links[i].slides else couple + arm * force
                i = self.links[i].parent
        return sums

    def mass_matrix(self):
        """M and the sizes of what adds up to its entries: columns of torques of unit
        accelerations."""
        still, one = [mpf(0)] * self.n, lambda j: [mpf(i == j) for i in range(self.n)]
        columns, sizes = zip(*[self.torques(still, one(j), gravity=False) for j in range(self.n)])
        return columns, [[max(sizes[i][j], sizes[j][i]) for i in range(self.n)] for j in range(self.n)]


def cholesky(m):
    """L of M = L Lᵀ by rows, or None if M is singular."""
    rows = []
    for i in range(len(m)):
        row = []
        for j in range(i):
            row.append((m[i][j] - sum(row[k] * rows[j][k] for k in range(j))) / rows[j][j])
        pivot = m[i][i] - sum(x * x for x in row)
        if pivot <= mpf(10) ** -60 * m[i][i]:
            return None
        rows.append(row + [mp.sqrt(pivot)])
    return rows


def solve(l, b):
    n, y = len(l), []
    for i in range(n):
        y.append((b[i] - sum(l[i][k] * y[k] for k in range(i))) / l[i][i])
    for i in reversed(range(n)):
        y[i] = (y[i] - sum(l[k][i] * y[k] for k in range(i + 1, n))) / l[i][i]
    return y


def inverse(l):
    return [solve(l, [mpf(i == j) for i in range(len(l))]) for j in range(len(l))]
