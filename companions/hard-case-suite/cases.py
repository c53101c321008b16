"""The cases: a robot, its states, and why it is hard. Numbers up to 70 are those of
docs/hard-cases.md."""

import math
import random
from dataclasses import dataclass, field

from robots import (
    DOWN,
    X,
    chain,
    changed,
    general,
    link,
    neighbour,
    points,
    quarters,
    rod,
    scaled,
    single,
    sized,
    tree,
    ur5e,
)


@dataclass
class Case:
    number: int
    name: str
    title: str
    reason: str
    links: list
    states: list  # of (q, q̇, q̈)
    gravity: list = field(default_factory=lambda: DOWN)
    # The amount that underflow may add to the bound, in f32 and in f64.
    underflow: tuple = (0.0, 0.0)
    # The scalars in which forward dynamics may be refused.
    refusal: list = field(default_factory=list)
    # Whether f32 has the numbers of the states, and can be asked at all.
    in_f32: bool = True


COMMON = [
    (
        [-1.092, -2.165, 0.936, -2.651, 0.222, -0.833],
        [-2.652, 0.045, -2.775, -0.398, -2.581, -2.456],
        [-1.51, 6.537, -7.524, -5.535, 2.549, 8.954],
    ),
    (
        [0.478, -0.641, 2.953, -2.811, 2.223, -1.304],
        [-2.134, -2.293, -1.149, 1.897, -1.916, 0.49],
        [2.778, -2.552, 0.955, -8.744, -8.808, -5.881],
    ),
    (
        [1.118, -0.449, -1.152, 0.53, -0.29, -1.241],
        [1.766, 1.194, -1.535, 0.447, 0.151, 2.251],
        [4.589, -4.241, 9.603, -7.639, -1.638, 5.143],
    ),
    (
        [-2.158, -0.068, -2.857, 1.043, 1.64, 0.453],
        [2.253, -1.118, 1.172, 0.566, 0.479, -0.263],
        [6.799, 8.894, -0.518, 3.283, -8.787, 4.03],
    ),
]
COMMON = [tuple([single(x) for x in row] for row in state) for state in COMMON]


def moved(change_q=None, change_qd=None, change_qdd=None, states=COMMON):
    """The states, each of their numbers changed by a function of state, joint and number."""
    changes = (change_q, change_qd, change_qdd)
    each = lambda k, row, change: [single(change(k, i, x)) if change else x for i, x in enumerate(row)]
    return [tuple(each(k, row, change) for row, change in zip(state, changes)) for k, state in enumerate(states)]


def paced(by):
    return moved(None, lambda k, i, x: x * by, lambda k, i, x: x * by * by)


def drawn(n, seed, count=4, straight=False):
    """Joints anywhere, within 3 rad/s and 10 rad/s²."""
    numbers = random.Random(seed)
    row = lambda bound: [single(numbers.uniform(-bound, bound)) for _ in range(n)]
    states = [(row(math.pi), row(3.0), row(10.0)) for _ in range(count)]
    return [([0.0] * n, qd, qdd) for _, qd, qdd in states] if straight else states


def at(angles):
    """Each list of angles with the speeds and accelerations of a common state."""
    return [([single(x) for x in row], COMMON[k % 4][1], COMMON[k % 4][2]) for k, row in enumerate(angles)]


def beside(angles):
    """Each list of angles, and the same a unit in the last place further out and further in."""
    return at([[neighbour(single(x), step) if x else 0.0 for x in row] for row in angles for step in (0, 1, -1)])


def remainder(k, i):
    """The rest of 10⁶ rad on an encoder of 4096 counts a turn, after whole turns."""
    counts = (651_898_647 + 7919 * (6 * k + i)) * (-1) ** i
    return ((counts + 2048) % 4096 - 2048) * single(math.tau / 4096)


def still(n):
    return [0.0] * n


def existing():
    """Those of docs/hard-cases.md that are rigid trees in given states."""
    plain = lambda number, name, title, reason, links, states=COMMON, **more: Case(
        number, name, title, reason, links, states, **more
    )
    yield plain(
        1, "tip-heavy", "UR5e, last link × 10⁶", "M is ill-conditioned where a heavy body is outward of light ones.",
        scaled(ur5e(), 5, 1e6)
    )
    yield plain(
        2, "tip-light", "UR5e, last link × 10⁻⁶",
        "An absolute lower bound on pivots treats the last link as much heavier than it is.", scaled(ur5e(), 5, 1e-6)
    )
    yield plain(
        3, "base-heavy", "UR5e, first link × 10⁶", "One row and column of M is 10⁶ times the others.",
        scaled(ur5e(), 0, 1e6)
    )
    yield plain(
        4, "massless-wrist", "UR5e, first two wrist links without mass",
        "Division by the inertia of a single link fails; only that of all that a joint moves counts.",
        scaled(scaled(ur5e(), 3, 0), 4, 0)
    )
    yield plain(
        5, "massless-tip", "UR5e, last link without mass",
        "M is singular: inverse dynamics exists, forward dynamics does not and is to be refused.",
        scaled(ur5e(), 5, 0)
    )
    for power in (-8, -6, -4, -2):
        yield plain(
            6, f"armature-1e{power}", f"UR5e, last link without mass on a rotor of 1e{power} kg·m²",
            "The armature alone makes M regular; its size is of scaling only.",
            changed(scaled(ur5e(), 5, 0), 5, armature=single(10.0**power))
        )
    for number, n in ((7, 8), (8, 16), (9, 32), (10, 64)):
        yield plain(
            number, "straight", f"chain of {n} rods, stretched", "The condition of M grows as n⁴.",
            chain([1.0] * n, 0.25, False), drawn(n, number, 2, True)
        )
        yield plain(
            number, "random", f"chain of {n} rods in space", "Roundings add up along the chain.",
            chain([1.0] * n, 0.25, True), drawn(n, number, 2)
        )
    turn = single(math.radians(75))
    yield plain(
        11, "zigzag", "six rods folded at ±75°", "A folded chain has a condition of 725.",
        [rod(i, 1.0, 1.0) for i in range(6)],
        at([[turn * (-1) ** i for i in range(6)], [-turn * (-1) ** i for i in range(6)]])
    )
    yield plain(
        12, "light-links", "1 kg on ten links of 1 g",
        "The pivots of the light links are what remains after the share of the heavy one is subtracted.",
        chain([1e-3] * 10 + [1.0], 0.1, True), drawn(11, 12)
    )
    yield plain(
        13, "far-base", "UR5e, its base 10⁴ m off", "In coordinates of the world every inertia is dominated by m r².",
        changed(ur5e(), 0, translation=[1e4, -1e4, 1e4])
    )
    slide = link(-1, X, (1e4, 0, 0), None, 50.0, (0, 0, 0.1), (1, 0, 0, 1, 0, 1), joint="prismatic")
    on_slide = [slide] + [dict(one, parent=one["parent"] + 1) for one in ur5e()]
    strokes = [([single(q[0] * 1e-3)] + q[1:], qd, qdd) for q, qd, qdd in drawn(7, 14)]
    yield plain(
        14, "far-slide", "UR5e on a slide 10⁴ m out, stroke of mm",
        "If the offset is added to the coordinate, f32 keeps no mm of it.", on_slide, strokes
    )
    yield plain(
        15, "fast", "UR5e at 1000 rad/s", "Products of speeds exceed all else by 10⁵.", ur5e(),
        moved(None, lambda k, i, x: math.copysign(1e3, x), lambda k, i, x: x * 1e5)
    )
    yield plain(
        16, "remainders", "UR5e, what is left of a million rad", "Angles counted in integers leave small remainders.",
        ur5e(), moved(lambda k, i, x: remainder(k, i))
    )
    turns = [[1, -1, 2, -3, 0, 5], [-2, 3, 1, 4, -1, -4]]
    yield plain(
        17, "quarter-turns", "UR5e at quarter turns ± 1 ulp",
        "A sine that is to be near 0 is lost if π/2 is reduced with too few digits.", ur5e(),
        beside([[k * math.pi / 2 for k in row] for row in turns])
    )
    coincident = changed(scaled(ur5e(), 4, 0), 5, rotation=quarters(0), translation=[0.0, 0.0, 0.25])
    yield plain(
        20, "coincident", "UR5e, last two axes on one line, no mass between", "M is singular in every state.",
        coincident
    )
    yield plain(
        21, "parallel", "six rods on parallel axes", "All terms across the plane are to cancel.",
        [rod(i, 1.0, 1.0) for i in range(6)]
    )
    x, y = 1.8694e-4, 1.8908e-4
    yield plain(
        22, "fat", "UR5e, last link against the triangle inequality",
        "Published inertias break it by 8.7 %, and dynamics exist all the same.",
        changed(ur5e(), 5, inertia=[single(v) for v in (x, 0, 0, y, 0, (x + y) / (1 - 0.087))])
    )
    yield plain(22, "points", "six point masses", "Inertias about the centres of mass are zero.", points())
    at_rest = [(q, still(6), still(6)) for q, _, _ in COMMON]
    yield plain(
        30, "at-rest", "UR5e at rest without gravity", "Every answer is to be exactly zero.", ur5e(), at_rest,
        gravity=[0.0, 0.0, 0.0]
    )
    yield plain(
        42, "tiny", "UR5e of 2⁻⁴ the length and 17 g", "Absolute thresholds do not suit a finger.",
        sized(ur5e(), 1 / 16, 1 / 1024), paced(4.0)
    )
    yield plain(
        42, "giant", "UR5e of 2⁴ the length and 9 t", "Absolute thresholds do not suit an excavator.",
        sized(ur5e(), 16.0, 512.0), paced(0.25)
    )
    yield plain(
        44, "on-a-wall", "UR5e on a wall", "Gravity is along no axis of the base.",
        changed(ur5e(), 0, rotation=quarters(1))
    )
    yield plain(45, "tree", "a tree of six bodies", "A trunk that forks twice.", tree([0, 1, 2, 3, 4, 5]))
    yield plain(
        45, "renumbered", "the same tree, numbered otherwise",
        "The order of the bodies is to have no part in the answer.", tree([0, 2, 1, 4, 5, 3]),
        [tuple([row[k] for k in [0, 2, 1, 4, 5, 3]] for row in state) for state in COMMON]
    )
    for name, mass in (("none", 0.0), ("tenth", 1.77), ("one", 17.7), ("ten", 177.0)):
        yield plain(
            46, f"payload-{name}", f"UR5e with a payload of {mass} kg",
            "The last body may outweigh the arm ten times.", loaded(mass)
        )
    yield plain(48, "general", "six links without a zero", "No axis, placement or inertia is simple.", general())


def loaded(mass):
    """The last link of UR5e and a load as one body."""
    one, c = ur5e()[5], (0.02, -0.01, 0.08)
    total = one["mass"] + mass
    com = [(one["mass"] * x + mass * y) / total for x, y in zip(one["com"], c)]
    a, b = 0.004 * mass, 0.0005 * mass
    inertia, pairs = [], [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)]
    for k, (i, j) in enumerate(pairs):
        entry = one["inertia"][k] + [a, b, -b, a, b, a][k]
        for m, at_ in ((one["mass"], one["com"]), (mass, c)):
            d = [x - y for x, y in zip(at_, com)]
            entry += m * ((sum(x * x for x in d) if i == j else 0) - d[i] * d[j])
        inertia.append(single(entry))
    return changed(ur5e(), 5, mass=single(total), com=[single(x) for x in com], inertia=inertia)
