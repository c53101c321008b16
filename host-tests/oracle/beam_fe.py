"""Finite elements of a clamped beam with a tip body: bending (order 2 of the strain) or torsion (order 1).

Hermite elements of degree 7: unknowns of a node are w, h w', h² w'' and h³ w''' with the element's
length h. Element matrices are exact fractions, and systems are solved by L D Lᵀ of banded matrices.
Frequencies are bracketed by Sturm's count (the number of negative pivots of K - s M is the number
of frequencies below the root of s), then refined by Rayleigh's quotient.
"""

from fractions import Fraction
from functools import cache
from math import perm

from mpmath import mpf, sqrt

NODE = 4
HALF_BAND = 2 * NODE - 1


@cache
def element():
    """Coefficients of the shape functions by powers of s in (0, 1)."""
    size = 2 * NODE
    # Derivative k of the power p at s = 0 and at s = 1.
    ends = [[perm(p, k) * (p == k or end) for p in range(size)] for end in (0, 1) for k in range(NODE)]
    work = [[Fraction(x) for x in row] + [Fraction(int(i == j)) for j in range(size)] for i, row in enumerate(ends)]
    for i in range(size):
        pivot = next(r for r in range(i, size) if work[r][i])
        work[i], work[pivot] = work[pivot], work[i]
        work[i] = [x / work[i][i] for x in work[i]]
        for r in range(size):
            if r != i and work[r][i]:
                work[r] = [x - work[r][i] * y for x, y in zip(work[r], work[i])]
    return [[work[p][size + i] for p in range(size)] for i in range(size)]


@cache
def products(order):
    """Integrals over s of products of derivatives of the shape functions."""
    derived = [[perm(p, order) * c for p, c in enumerate(row)][order:] for row in element()]
    exact = [
        [sum(x * y / (i + j + 1) for i, x in enumerate(a) for j, y in enumerate(b)) for b in derived] for a in derived
    ]
    return [[mpf(x.numerator) / x.denominator for x in row] for row in exact]


class Elements:
    def __init__(self, link, count, order=2):
        self.link, self.count, self.order = link.exact(), count, order
        link, self.h = self.link, self.link.length / count
        self.clamped, n = order, NODE * (count + 1)
        density = link.rho_a if order == 2 else link.rho_iy + link.rho_iz
        stiffness = (link.ei if order == 2 else link.gj) / self.h ** (2 * order - 1)
        mass, bent = products(0), products(order)
        # Rows of the lower triangle: entry b of row i is of column i - HALF_BAND + b.
        self.m, self.k = ([[mpf(0)] * (HALF_BAND + 1) for _ in range(n)] for _ in range(2))
        for e in range(count):
            for i in range(2 * NODE):
                for j in range(i + 1):
                    self.m[e * NODE + i][HALF_BAND + j - i] += density * self.h * mass[i][j]
                    self.k[e * NODE + i][HALF_BAND + j - i] += stiffness * bent[i][j]
        self.tip = NODE * count
        self.m[self.tip][HALF_BAND] += link.tip_mass if order == 2 else link.tip_inertia
        if order == 2:
            self.m[self.tip + 1][HALF_BAND] += link.tip_inertia / self.h**2

    def times(self, matrix, x):
        answer = [mpf(0)] * len(x)
        for i, row in enumerate(matrix):
            for j in range(max(0, i - HALF_BAND), i + 1):
                answer[i] += row[HALF_BAND + j - i] * x[j]
                if j != i:
                    answer[j] += row[HALF_BAND + j - i] * x[i]
        return answer

    def factors(self, shift):
        """(L, D) of K - shift M over the unknowns that are free."""
        lower, pivots, c = {}, {}, self.clamped
        for i in range(c, len(self.k)):
            first, row = max(c, i - HALF_BAND), {}
            for j in range(first, i + 1):
                value = self.k[i][HALF_BAND + j - i] - shift * self.m[i][HALF_BAND + j - i]
                above = lower[j] if j < i else {p: x / pivots[p] for p, x in row.items()}
                row[j] = value - sum(x * above[p] for p, x in row.items() if p in above)
            pivots[i] = row.pop(i)
            lower[i] = {p: x / pivots[p] for p, x in row.items()}
        return lower, pivots

    def solve(self, factors, right):
        (lower, pivots), x = factors, [mpf(0)] * self.clamped + right[self.clamped :]
        for i, row in lower.items():
            x[i] -= sum(value * x[p] for p, value in row.items())
        for i, pivot in pivots.items():
            x[i] /= pivot
        for i, row in reversed(lower.items()):
            for p, value in row.items():
                x[p] -= value * x[i]
        return x

    def below(self, square):
        """Number of frequencies whose squares are below one."""
        return sum(pivot < 0 for pivot in self.factors(square)[1].values())

    def modes(self, count):
        """[(angular frequency, unknowns of unit modal mass with a positive displacement of the tip), ...]."""
        answer, high = [], mpf(1)
        for i in range(1, count + 1):
            low = mpf(0)
            while self.below(high) < i:
                low, high = high, 2 * high
            while self.below(low) != i - 1 or self.below(high) != i or high > low * mpf("1.02"):
                middle = (low + high) / 2
                low, high = (middle, high) if self.below(middle) < i else (low, middle)
            square, x = (low + high) / 2, [mpf(1)] * len(self.k)
            for step in range(12):
                # The quotient of a vector that is not near a mode yet leads to another mode.
                factors = self.factors(square) if step == 0 or step > 3 else factors
                x = self.solve(factors, self.times(self.m, x))
                size = sqrt(dot(x, self.times(self.m, x)))
                x = [a / size for a in x]
                before, square = square, dot(x, self.times(self.k, x)) if step > 2 else square
                if step > 3 and abs(square - before) < mpf(10) ** -30 * square:
                    break
            near = mpf(10) ** -20 * square
            assert (self.below(square - near), self.below(square + near)) == (i - 1, i), "a frequency between others"
            answer.append((sqrt(square), x if x[self.tip] > 0 else [-a for a in x]))
        return answer

    def slope(self, x, node):
        return x[NODE * node + 1] / self.h

    def field(self, function):
        """Unknowns of a polynomial from its derivatives 0 to 3 at a place."""
        nodes = [function(self.h * i) for i in range(self.count + 1)]
        return [value * self.h**k for node in nodes for k, value in enumerate(node)]

    def uniform(self):
        return self.field(lambda _: (mpf(1), mpf(0), mpf(0), mpf(0)))

    def lever(self):
        """The displacement x, of a turn of the hub."""
        return self.field(lambda x: (x, mpf(1), mpf(0), mpf(0)))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))
