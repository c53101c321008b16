"""Generalised forces of a chain of flexible links from D'Alembert's principle over its material points.

Every point P of a beam, of its sections and of a tip body is a function of joint angles q and
amplitudes of modes e: the link's frame times r + sum phi_k(r) e_k. Accelerations come from Taylor
polynomials in time, derivatives of P with respect to a coordinate from a complex step, and no
integral of a shape is formed.
"""

from beam_shapes import bending, gauss, torsion
from mpmath import cos, mp, mpc, mpf, sin, sqrt

STEP = mpf(10) ** -60
GRAVITY = (mpf(0), mpf(0), mpf("-9.81"))
X, Y, Z = (tuple(mpf(i == j) for j in range(3)) for i in range(3))


class Taylor:
    """c0 + c1 t + c2 t²."""

    __slots__ = ("c",)

    def __init__(self, *c):
        self.c = c

    def __add__(self, other):
        if not isinstance(other, Taylor):
            return Taylor(self.c[0] + other, self.c[1], self.c[2])
        return Taylor(*(x + y for x, y in zip(self.c, other.c)))

    def __mul__(self, other):
        if not isinstance(other, Taylor):
            return Taylor(*(x * other for x in self.c))
        (a, b, c), (x, y, z) = self.c, other.c
        return Taylor(a * x, a * y + b * x, a * z + b * y + c * x)

    def __neg__(self):
        return self * -1

    __radd__, __rmul__ = __add__, __mul__


def sine_cosine(x):
    if not isinstance(x, Taylor):
        return sin(x), cos(x)
    s, c, (_, v, a) = sin(x.c[0]), cos(x.c[0]), x.c
    return Taylor(s, c * v, c * a - s * v * v / 2), Taylor(c, -s * v, -s * a - c * v * v / 2)


def dot(a, b):
    return sum((x * y for x, y in zip(a, b)), mpf(0))


def cross(a, b):
    return (a[1] * b[2] + -(a[2] * b[1]), a[2] * b[0] + -(a[0] * b[2]), a[0] * b[1] + -(a[1] * b[0]))


def turned(attitude, axis, angle):
    """The attitude after a rotation about one of its own axes: 0, 1 or 2."""
    s, c = sine_cosine(angle)
    j, k = (axis + 1) % 3, (axis + 2) % 3
    rows = []
    for row in attitude:
        new = list(row)
        new[j], new[k] = row[j] * c + row[k] * s, row[k] * c + -(row[j] * s)
        rows.append(new)
    return rows


def reciprocal(x):
    if not isinstance(x, Taylor):
        return 1 / x
    a, b, c = x.c
    return Taylor(1 / a, -b / a**2, b * b / a**3 - c / a**2)


def rodrigues(angles):
    """Rows of the rotation of which the angles are twice the Rodrigues parameters g: 1 + 2 (g× + g×²) / (1 + g²)."""
    g = [angle * mpf("0.5") for angle in angles]
    scale = reciprocal(1 + dot(g, g)) * 2
    columns = []
    for unit in (X, Y, Z):
        once = cross(g, unit)
        columns.append([u + (a + b) * scale for u, a, b in zip(unit, once, cross(g, once))])
    return [[column[k] for column in columns] for k in range(3)]


def shape(link, kind, index):
    """(displacement of a point of the section at x, displacement of the end, rotation of the end)."""
    length = mpf(link.length)
    if kind == "twist":
        t = torsion(link, index)[index - 1][1]
        return lambda r: (mpf(0), -t(r[0]) * r[2], t(r[0]) * r[1]), (mpf(0),) * 3, X
    w = bending(link, index)[index - 1][1]
    along = {"bend_y": Y, "bend_z": Z}[kind]
    end = tuple(w(length) * x for x in along)
    return lambda r: tuple(w(r[0]) * x for x in along), end, tuple(w(length, 1) * x for x in cross(X, along))


def points(link, modes, n):
    """[(mass, place, displacements of the modes), ...], and of each mode the end's displacement and rotation."""
    shapes, link = [shape(link, *mode) for mode in modes], link.exact()
    answer = []
    a, b = sqrt(2 * link.rho_iz / link.rho_a), sqrt(2 * link.rho_iy / link.rho_a)
    for s, weight in gauss(n):
        for y, z in ((a, 0), (-a, 0), (0, b), (0, -b)):
            place = (link.length * s, mpf(y), mpf(z))
            answer.append((link.rho_a * link.length * weight / 4, place, [field(place) for field, _, _ in shapes]))
    arm = sqrt(mpf("1.5") * link.tip_inertia / link.tip_mass)
    for axis in (X, Y, Z):
        for sign in (1, -1):
            d = tuple(sign * arm * x for x in axis)
            moved = [tuple(u + v for u, v in zip(end, cross(turn, d))) for _, end, turn in shapes]
            answer.append((link.tip_mass / 6, (link.length + d[0], d[1], d[2]), moved))
    return answer, [(end, turn) for _, end, turn in shapes]


class Chain:
    """Links = [(axis of the joint, link, [(kind, index), ...]), ...]; coordinates = angles, then amplitudes."""

    def __init__(self, links, n=28):
        self.links, self.points, self.ends, self.first = links, [], [], [len(links)]
        for _, link, modes in links:
            inside, ends = points(link, modes, n)
            self.points.append(inside)
            self.ends.append(ends)
            self.first.append(self.first[-1] + len(modes))

    def frames(self, coordinates):
        """Origin and attitude of every link."""
        origin, attitude, answer = [mpf(0)] * 3, [list(X), list(Y), list(Z)], []
        for i, (axis, link, _) in enumerate(self.links):
            attitude = turned(attitude, axis, coordinates[i])
            answer.append((origin, attitude))
            amplitudes = coordinates[self.first[i] : self.first[i + 1]]
            end = [sum((u[k] * e for (u, _), e in zip(self.ends[i], amplitudes)), mpf(0)) for k in range(3)]
            end[0] = end[0] + mpf(link.length)
            origin = [o + dot(row, end) for o, row in zip(origin, attitude)]
            turns = [sum((turn[k] * e for (_, turn), e in zip(self.ends[i], amplitudes)), mpf(0)) for k in range(3)]
            columns = list(zip(*rodrigues(turns)))
            attitude = [[dot(row, column) for column in columns] for row in attitude]
        return answer

    def positions(self, coordinates):
        """Positions of all points, in the base frame."""
        answer = []
        for i, (origin, attitude) in enumerate(self.frames(coordinates)):
            amplitudes = coordinates[self.first[i] : self.first[i + 1]]
            for _, place, moved in self.points[i]:
                r = [place[k] + sum((u[k] * e for u, e in zip(moved, amplitudes)), mpf(0)) for k in range(3)]
                answer.append([o + dot(row, r) for o, row in zip(origin, attitude)])
        return answer

    def forces(self, x, rate, acceleration):
        """(generalised forces without elastic ones, kinetic energy, potential energy of gravity)."""
        masses = [mass for inside in self.points for mass, _, _ in inside]
        paths = self.positions([Taylor(a, b, c / 2) for a, b, c in zip(x, rate, acceleration)])
        velocities = [[p.c[1] for p in path] for path in paths]
        inertial = [[m * (2 * p.c[2] - g) for p, g in zip(path, GRAVITY)] for m, path in zip(masses, paths)]
        answer = []
        for j in range(len(x)):
            moved = self.positions([mpc(a, STEP if i == j else 0) for i, a in enumerate(x)])
            answer.append(sum(dot(f, [p.imag / STEP for p in point]) for f, point in zip(inertial, moved)))
        power = sum(dot(f, v) for f, v in zip(inertial, velocities))
        other = dot(answer, rate)
        size = sum(abs(a * b) for f, v in zip(inertial, velocities) for a, b in zip(f, v)) + mp.eps
        assert abs(power - other) < mpf(10) ** -35 * size, "power of the forces on points and on coordinates"
        kinetic = sum(m * dot(v, v) for m, v in zip(masses, velocities)) / 2
        potential = -sum(m * dot([p.c[0] for p in path], GRAVITY) for m, path in zip(masses, paths))
        return answer, kinetic, potential
