"""A flexible link whose hub turns by 1 rad about y, from rest to rest, under gravity and without damping.

Transverse displacements u of the finite elements obey M (u'' - a'² u - a'' x) + K u = -g cos(a) M
1, with the hub's angle a, its lever x and uniform displacement 1. Modes of unit mass decouple them:
e'' + (w² - a'²) e = a'' (e.M x) - g cos(a) (e.M 1), solved by Taylor polynomials step by step, and
in closed form once the hub is at rest. The full model adds to its first modes the displacement
without inertia of all others. The first modes and the hub's torque are held against D'Alembert's
principle over material points.
"""

from beam_fe import Elements, dot
from beam_points import Chain
from beam_shapes import bending, modal
from mpmath import cos, mp, mpf, sin

G, DURATION, TIMES, ORDER = mpf("9.81"), mpf("0.4"), [mpf(i) / 25 for i in range(1, 21)], 44
FEW, MANY, ELEMENTS = 6, 20, 60


def hub(t):
    """Taylor coefficients of the angle's polynomial 10 s³ - 15 s⁴ + 6 s⁵, s = t / duration, about a time."""
    if t >= DURATION:
        return [mpf(1)]
    s, c = t / DURATION, [0, 0, 0, 10, -15, 6]
    rows = [[c[p] * mp.binomial(p, k) * s ** (p - k) for p in range(k, 6)] for k in range(6)]
    return [sum(row) / DURATION**k for k, row in enumerate(rows)]


def derived(c):
    return [k * x for k, x in enumerate(c)][1:] or [mpf(0)]


def product(a, b, size):
    answer = [mpf(0)] * size
    for i, x in enumerate(a):
        for j, y in enumerate(b[: max(0, size - i)]):
            answer[i + j] += x * y
    return answer


def motion(t):
    """Angle, rate and acceleration of the hub."""
    c = hub(t) + [mpf(0)] * 3
    return c[0], c[1], 2 * c[2]


def coefficient(a, b, n):
    """Coefficients of the product of a short and a long polynomial."""
    return sum(x * b[n - i] for i, x in enumerate(a) if i <= n)


def terms(t):
    """Polynomials of a'², a'' and cos(a) about a time."""
    angle = hub(t)
    rate = derived(angle)
    c, s = [cos(angle[0])], [sin(angle[0])]
    for n in range(ORDER):
        c, s = [*c, -coefficient(rate, s, n) / (n + 1)], [*s, coefficient(rate, c, n) / (n + 1)]
    return product(rate, rate, 2 * len(rate) - 1), derived(rate), c


def mode(omega, lever, uniform, reach=4):
    """[(amplitude, rate, acceleration), ...] at TIMES from static equilibrium; steps turn a mode by `reach` at most."""
    count = 10 * (1 + int(DURATION * max(omega / reach, 50) / 10))
    h, answer = DURATION / count, []
    value, rate = -G * uniform / omega**2, mpf(0)
    for k in range(count):
        square, acceleration, cosine = terms(h * k)
        e = [value, rate]
        for n in range(ORDER - 2):
            force = (lever * acceleration[n] if n < len(acceleration) else 0) - G * uniform * cosine[n]
            e.append((force - omega**2 * e[n] + coefficient(square, e, n)) / ((n + 1) * (n + 2)))
        value, rate, acceleration = (mp.polyval(c[::-1], h) for c in (e, derived(e), derived(derived(e))))
        if (k + 1) % (count // 10) == 0:
            answer.append((value, rate, acceleration))
    rest = -G * cos(1) * uniform / omega**2
    for t in TIMES[10:]:
        s, c = sin(omega * (t - DURATION)), cos(omega * (t - DURATION))
        away = (value - rest) * c + rate / omega * s
        answer.append((rest + away, rate * c - omega * (value - rest) * s, -(omega**2) * away))
    return answer


def torque(link, t, states, levers, uniforms):
    """Torque of the hub, N·m: inertia of the turned points, Coriolis' force, reaction of the modes and gravity."""
    e, (angle, rate, acceleration) = link.exact(), motion(t)
    line = e.rho_a * e.length
    inertia = line * e.length**2 / 3 + e.rho_iy * e.length + e.tip_mass * e.length**2 + e.tip_inertia
    answer = acceleration * inertia - G * cos(angle) * (line * e.length / 2 + e.tip_mass * e.length)
    for (x, v, a), lever, uniform in zip(states, levers, uniforms):
        answer += acceleration * x * x + 2 * rate * x * v - lever * a - G * sin(angle) * uniform * x
    return answer


def against_points(link, basis, histories, torques):
    """Holds the first modes and the hub's torque against the forces on the link's material points."""
    chain, shapes = Chain([(1, link, [("bend_z", i + 1) for i in range(FEW)])], 40), bending(link, FEW)
    for k in (2, 9, 16):
        t = TIMES[k]
        scaled = [[x[basis.tip] * s for s in history[k]] for x, history in histories]
        states = zip(motion(t), *scaled)
        tau, *forces = chain.forces(*(list(state) for state in states))[0]
        assert abs(tau - torques[k]) < mpf(10) ** -17 * abs(tau), "the hub's torque against points"
        for force, (_, w), (x, *_) in zip(forces, shapes, scaled):
            elastic = modal(link, w)[1] * x
            assert abs(force + elastic) < mpf(10) ** -15 * abs(elastic), "the modes' equations against points"


def forced(link):
    """(recording, largest error of the tip's displacement relative to its largest, by number of modes)."""
    basis = Elements(link, ELEMENTS)
    ones, lever = basis.times(basis.m, basis.uniform()), basis.times(basis.m, basis.lever())
    compliance = basis.factors(mpf(0))
    static = [basis.solve(compliance, v)[basis.tip] for v in (lever, ones)]
    histories, left, sums = [], [list(static) for _ in TIMES], [mpf(0)] * len(TIMES)
    constants, tips, full = [], [], []
    for i, (omega, x) in enumerate(basis.modes(MANY)):
        a, b, tip = dot(x, lever), dot(x, ones), x[basis.tip]
        path = mode(omega, a, b)
        if i < FEW:
            finer = mode(omega, a, b, 2)
            error = max(abs(p - q) for (p, *_), (q, *_) in zip(path, finer)) / max(abs(p) for p, *_ in path)
            assert error < mpf(10) ** -18, "steps of Taylor polynomials"
            histories.append((x, path))
            constants.append((a, b))
        sums = [s + tip * e for s, (e, *_) in zip(sums, path)]
        left = [[r[0] - tip * a / omega**2, r[1] - tip * b / omega**2] for r in left]
        tips.append(sums)
        parts = [(motion(t), r) for t, r in zip(TIMES, left)]
        full.append([s + m[2] * r[0] - G * cos(m[0]) * r[1] for s, (m, r) in zip(sums, parts)])
    size = max(abs(u) for u in full[-1])
    converged = [max(abs(p - q) for p, q in zip(other, full[-1])) / size for other in full[:-1]]
    assert converged[-5] < mpf(10) ** -12, "modes of the full model"
    hubs = []
    for m in range(1, FEW + 1):
        levers, uniforms = zip(*constants[:m])
        rows = [[history[k] for _, history in histories[:m]] for k in range(len(TIMES))]
        hubs.append([torque(link, t, row, levers, uniforms) for t, row in zip(TIMES, rows)])
    against_points(link, basis, histories, hubs[-1])
    errors = [max(abs(p - q) for p, q in zip(tip, full[-1])) / size for tip in tips[:FEW]]
    return full[-1], tips[:FEW], hubs, errors, converged
