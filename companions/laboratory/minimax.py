#!/usr/bin/env python3
"""Minimax coefficients of the f32 sine and cosine kernels (dynamics-core/src/trig/minimax.rs).

sin r = r + r^3 P(r^2), cos r = 1 - r^2/2 + r^4 Q(r^2) on |r| <= pi/4 plus the slack that a
reduction by rounding in f32 leaves. Coefficients come from Remez exchange in 50 digits and
are rounded to f32 from the lowest order up, each rounding being repaired by the later ones.
Needs mpmath (see host-tests/oracle/requirements.txt).
"""
from mpmath import mp, mpf, cos, sin, pi, matrix, lu_solve
import struct

mp.dps = 50
HALF = pi / 4 * (1 + mpf(2) ** -12)


def f32(x):
    return mpf(struct.unpack("f", struct.pack("f", float(x)))[0])


def remez(g, weight, degree, lo, hi, fixed):
    """Minimax of weight(u)*(g(u) - p(u)); `fixed` holds coefficients already rounded."""
    free = degree + 1 - len(fixed)
    n = free + 1
    nodes = [(lo + hi) / 2 - (hi - lo) / 2 * cos(pi * k / (n - 1)) for k in range(n)]
    powers = range(len(fixed), degree + 1)
    known = lambda u: sum(c * u**k for k, c in enumerate(fixed))
    for _ in range(12):
        a = matrix(n, n)
        b = matrix(n, 1)
        for i, u in enumerate(nodes):
            for j, k in enumerate(powers):
                a[i, j] = weight(u) * u**k
            a[i, n - 1] = (-1) ** i
            b[i] = weight(u) * (g(u) - known(u))
        x = lu_solve(a, b)
        coeffs = list(fixed) + [x[j] for j in range(free)]
        err = lambda u: weight(u) * (g(u) - sum(c * u**k for k, c in enumerate(coeffs)))
        grid = [lo + (hi - lo) * mpf(i) / 800 for i in range(801)]
        values = [err(u) for u in grid]
        ext = [i for i in range(801) if (i == 0 or abs(values[i]) >= abs(values[i - 1]))
               and (i == 800 or abs(values[i]) >= abs(values[i + 1]))]
        picked = []
        for i in ext:
            if picked and (values[picked[-1]] > 0) == (values[i] > 0):
                if abs(values[i]) > abs(values[picked[-1]]):
                    picked[-1] = i
            else:
                picked.append(i)
        while len(picked) > n:
            picked.pop(0 if abs(values[picked[0]]) < abs(values[picked[-1]]) else -1)
        if len(picked) < n:
            break
        nodes = [grid[i] for i in picked]
    return coeffs, max(abs(v) for v in values)


def rounded(g, weight, degree, hi):
    fixed = []
    for _ in range(degree + 1):
        coeffs, _ = remez(g, weight, degree, mpf("1e-12"), hi, fixed)
        fixed.append(f32(coeffs[len(fixed)]))
    err = max(abs(weight(u) * (g(u) - sum(c * u**k for k, c in enumerate(fixed))))
              for u in [hi * mpf(i) / 2000 + mpf("1e-12") for i in range(2001)])
    return fixed, err


from mpmath import sqrt

hi = HALF**2
for terms in (1, 2, 3):
    p, e = rounded(lambda u: (sin(sqrt(u)) / sqrt(u) - 1) / u, lambda u: u * sqrt(u), terms - 1, hi)
    print(f"sin degree {2 * terms + 1}: {[float(c) for c in p]}  absolute error {float(e):.2e}")
for terms in (1, 2, 3):
    q, e = rounded(lambda u: (cos(sqrt(u)) - 1 + u / 2) / u**2, lambda u: u**2, terms - 1, hi)
    print(f"cos degree {2 * terms + 2}: {[float(c) for c in q]}  absolute error {float(e):.2e}")
# pi/2 in three parts; the first two have trailing zero bits, so that k * part is exact.
x = pi / 2
for bits in (11, 11, 24):
    e = 0
    scale = mpf(2) ** (bits - 1 - int(mp.floor(mp.log(x, 2))))
    part = mp.nint(x * scale) / scale
    print("part", float(part).hex(), repr(float(f32(part))))
    x -= part
