"""Flexible links of beam.py: data, quadrature, and shapes of clamped-free beams with a tip body in closed form.

Bending: EI w'''' = rhoA w2 w, with EI w''(L) = w2 J w'(L) and EI w'''(L) = -w2 m w(L), where w2 is
the squared angular frequency. Torsion: GJ t'' = -w2 rhoIp t, with GJ t'(L) = w2 J t(L). Scaled to 1
at L.
"""

from dataclasses import dataclass
from functools import cache

from mpmath import cos, cosh, findroot, mp, mpf, pi, sin, sinh, sqrt

mp.dps = 50


@dataclass(frozen=True)
class Link:
    """A uniform beam along x, with a tip body of isotropic inertia whose centre is at x = L."""

    length: float
    rho_a: float
    ei: float
    gj: float = 0.0
    rho_iy: float = 0.0
    rho_iz: float = 0.0
    tip_mass: float = 0.0
    tip_inertia: float = 0.0

    def exact(self):
        """The f64 numbers, which the library computes with, in 50 digits."""
        return Link(*(mpf(x) for x in vars(self).values()))


@cache
def gauss(n):
    """Points and weights of Gauss and Legendre on (0, 1)."""
    answer = []
    for k in range(n):
        x = cos(pi * (k + mpf("0.75")) / (n + mpf("0.5")))
        for _ in range(8):
            before, value = mpf(1), x
            for j in range(2, n + 1):
                before, value = value, ((2 * j - 1) * x * value - (j - 1) * before) / j
            slope = n * (x * value - before) / (x * x - 1)
            x -= value / slope
        answer.append(((1 + x) / 2, 1 / ((1 - x * x) * slope * slope)))
    assert abs(sum(w for _, w in answer) - 1) < mpf(10) ** -45
    return answer


def roots(f, count, step):
    """The first roots of f on the positive axis, from changes of sign on a grid."""
    answer, x = [], step / 2
    here = f(x)
    while len(answer) < count:
        there = f(x + step)
        if here * there < 0:
            answer.append(findroot(f, (x, x + step), solver="anderson", tol=mpf(10) ** -90, maxsteps=200))
        x, here = x + step, there
    return answer


def derivative(beta, x, order):
    """Derivatives of cosh - cos and of sinh - sin, of b x."""
    z, even, odd = beta * x, (cosh, sinh)[order % 2], (sinh, cosh)[order % 2]
    # Derivatives of -cos and of -sin, by a quarter of a turn each.
    c = (-cos(z), sin(z), cos(z), -sin(z))[order % 4]
    s = (-sin(z), -cos(z), sin(z), cos(z))[order % 4]
    return beta**order * (even(z) + c), beta**order * (odd(z) + s)


@cache
def bending(link, count):
    """[(angular frequency, w(x, order of derivative)), ...] of the first shapes."""
    link = link.exact()
    length, m, j = link.length, link.tip_mass / link.rho_a, link.tip_inertia / link.rho_a

    def conditions(beta):
        d = [derivative(beta, length, k) for k in range(4)]
        return [(d[2][i] - j * beta**4 * d[1][i], d[3][i] + m * beta**4 * d[0][i]) for i in range(2)]

    def singular(z):
        (a, b), (c, d) = conditions(z / length)
        return (a * d - b * c) / (z / length) ** 5 / cosh(z)

    def shape(beta):
        (a, _), (c, _) = conditions(beta)
        first, second = c, -a
        ends = derivative(beta, length, 0)
        scale = first * ends[0] + second * ends[1]

        def w(x, order=0):
            pair = derivative(beta, x, order)
            return (first * pair[0] + second * pair[1]) / scale

        return w

    betas = [z / length for z in roots(singular, count, mpf("0.04"))]
    return [(b * b * sqrt(link.ei / link.rho_a), shape(b)) for b in betas]


@cache
def torsion(link, count):
    """[(angular frequency, t(x)), ...] of the first shapes."""
    link = link.exact()
    length, polar = link.length, link.rho_iy + link.rho_iz
    j = link.tip_inertia / (polar * length)
    found = roots(lambda z: cos(z) - j * z * sin(z), count, mpf("0.04"))
    return [
        (z / length * sqrt(link.gj / polar), lambda x, z=z: sin(z * x / length) / sin(z))
        for z in found
    ]


def modal(link, w, n=64):
    """Integrals of a bending shape: (mass of the mode, its stiffness, force of unit acceleration along it)."""
    link = link.exact()
    rule = [(link.length * x, link.length * weight) for x, weight in gauss(n)]
    mass = link.rho_a * sum(dx * w(x) ** 2 for x, dx in rule)
    mass += link.tip_mass + link.tip_inertia * w(link.length, 1) ** 2
    stiffness = link.ei * sum(dx * w(x, 2) ** 2 for x, dx in rule)
    return mass, stiffness, link.rho_a * sum(dx * w(x) for x, dx in rule) + link.tip_mass
