"""Cases 71 to 87: what the proofs of error bounds find hard (docs/certificates.md)."""

import math

from cases import COMMON, Case, at, beside, drawn, moved, still
from dynamics import Tree, cholesky, solve
from mpmath import mpf
from robots import DOWN, chain, changed, gantry, gyroscope, panda, rpy, scaled, seesaw, single, so101, star, ur5e

NO_GRAVITY = [0.0, 0.0, 0.0]
# Subnormal results carry this error for each number that is rounded to one: 2⁻¹⁴⁹ and 2⁻¹⁰⁷⁴.
SMALLEST = (2.0**-149, 2.0**-1074)


def free_motion(links):
    """The common states with the accelerations, rounded to f32, of a robot that no motor moves."""
    states, n = [], len(links)
    for q, qd, _ in COMMON:
        tree = Tree({"links": links, "gravity": DOWN}, q)
        bias, _ = tree.torques([mpf(x) for x in qd], [mpf(0)] * n)
        qdd = solve(cholesky(tree.mass_matrix()[0]), [-x for x in bias])
        states.append((q, qd, [single(float(x)) for x in qdd]))
    return states


def corners(limits):
    """The box of a certificate at its corners, in an order that mixes the signs; fully moving."""
    states = []
    for k in range(8):
        low = lambda i, shift: (k >> ((i + shift) % 3)) & 1
        q = [lower if low(i, 0) else upper for i, (lower, upper, _) in enumerate(limits)]
        qd = [-rate if low(i, 1) else rate for i, (_, _, rate) in enumerate(limits)]
        qdd = [-10.0 if low(i, 2) else 10.0 for i in range(len(limits))]
        states.append(tuple([single(x) for x in row] for row in (q, qd, qdd)))
    return states


PANDA = [
    (-2.8973, 2.8973, 2.175),
    (-1.7628, 1.7628, 2.175),
    (-2.8973, 2.8973, 2.175),
    (-3.0718, -0.0698, 2.175),
    (-2.8973, 2.8973, 2.61),
    (-0.0175, 3.7525, 2.61),
    (-2.8973, 2.8973, 2.61),
]

SO101 = [
    (-1.91986, 1.91986, 10.0),
    (-1.74533, 1.74533, 10.0),
    (-1.69, 1.69, 10.0),
    (-1.65806, 1.65806, 10.0),
    (-2.74385, 2.84121, 10.0),
    (-0.174533, 1.74533, 10.0),
]


def found():
    rest = [(q, still(6), still(6)) for q, _, _ in COMMON]
    yield Case(
        71,
        "vertical-axis",
        "UR5e at rest, its first axis vertical",
        "Gravity has no torque about the first axis: all that the bodies contribute cancels to zero.",
        ur5e(),
        rest,
    )

    balance = [([a] + [0.0] * 5, still(6), still(6)) for a in (0.0, single(0.7), single(-2.5))]
    balance += [([0.0, b] + [0.0] * 4, still(6), still(6)) for b in (2.0**-20, single(1e-3), single(1.5))]
    balance += [([a] + [0.0] * 5, COMMON[0][1], COMMON[0][2]) for a in (0.0, single(0.7))]
    yield Case(
        72,
        "balance",
        "a stretched arm that its counterweight balances",
        "Torques of gravity of 170 N·m cancel to zero about the first joint, and to a millionth of that beside it.",
        seesaw(),
        balance,
    )

    heavy_and_light = [1e3 if i % 2 == 0 else 1e-3 for i in range(16)]
    yield Case(
        73,
        "heavy-light",
        "16 rods of 1000 kg and 1 g by turns",
        "Sums of sizes that differ by 10⁶ along the chain.",
        chain(heavy_and_light, 0.25, True),
        drawn(16, 73, 2),
    )
    yield Case(
        74,
        "light-heavy",
        "16 rods of 1 g and 1000 kg by turns",
        "As case 73, with the heavy rod at the end.",
        chain(heavy_and_light[1:] + [1e3], 0.25, True),
        drawn(16, 74, 2),
    )
    growing = [10.0 ** (-3 + 0.5 * i) for i in range(11)]
    yield Case(
        75,
        "growing",
        "eleven rods of 1 g to 100 kg, each √10 times the one before",
        "Every pivot is what remains of a number ten times as large.",
        chain(growing, 0.25, True),
        drawn(11, 75),
    )

    step = math.tau / 128
    middles = [[(k + 0.5) * step for k in row] for row in ([0, 7, -9, 16, 31, -32], [-64, 63, 48, -17, 33, 1])]
    yield Case(
        76,
        "seams",
        "UR5e between two entries of a table of 128 sines, ± 1 ulp",
        "At the seams of a table the rest of the reduction is largest, and one bit decides which entry counts.",
        ur5e(),
        beside(middles),
    )
    entries = [[k * step for k in row] for row in ([1, 7, -9, 15, 31, -33], [-65, 63, 47, -17, 33, 2])]
    yield Case(
        77,
        "entries",
        "UR5e at the entries of a table of 128 sines, ± 1 ulp",
        "The rest of the reduction is a difference of nearly equal numbers.",
        ur5e(),
        beside(entries),
    )

    slow = moved(None, lambda k, i, x: x * 1e-40, lambda k, i, x: x * 1e-40)
    yield Case(
        78,
        "subnormal-rates",
        "UR5e without gravity at 10⁻⁴⁰ rad/s and rad/s²",
        "Speeds, accelerations and torques are subnormal in f32, and products of speeds vanish.",
        ur5e(),
        slow,
        gravity=NO_GRAVITY,
        underflow=(64 * SMALLEST[0], 0.0),
    )
    f64_slow = [(q, [x * 2.0**-1030 for x in qd], [x * 2.0**-1030 for x in qdd]) for q, qd, qdd in COMMON]
    yield Case(
        79,
        "subnormal-rates-f64",
        "UR5e without gravity at 10⁻³¹⁰ rad/s and rad/s²",
        "As case 78 for f64; f32 does not have the numbers.",
        ur5e(),
        f64_slow,
        gravity=NO_GRAVITY,
        underflow=(0.0, 64 * SMALLEST[1]),
        in_f32=False,
    )
    dust = changed(
        ur5e(), 5, mass=single(1e-38), inertia=[single(x) for x in (2e-42, 0, 0, 2e-42, 0, 3e-42)], com=[0.0, 0.0, 0.0]
    )
    # The reciprocal of the last pivot exceeds f32: a solver that uses it refuses rather than divide.
    yield Case(
        80,
        "subnormal-inertia",
        "UR5e, last link of 10⁻³⁸ kg and 3·10⁻⁴² kg·m²",
        "The last pivot is subnormal in f32: a flush to zero makes M singular.",
        dust,
        COMMON,
        underflow=(64 * SMALLEST[0], 0.0),
        refusal=["f32"],
    )

    yield Case(
        81,
        "panda-corners",
        "Panda at corners of the box of its certificate",
        "The proven error of the first torque is 38 times the worst observed one, the largest ratio of all certificates of the whole dynamics.",
        panda(),
        corners(PANDA),
    )
    still_panda = [(q, still(7), still(7)) for q, _, _ in corners(PANDA)]
    yield Case(
        82,
        "panda-rest",
        "Panda at rest at corners of its box",
        "Gravity alone, of which the certificate knows less than a hundredth of the whole.",
        panda(),
        still_panda,
    )

    yield Case(
        83,
        "free-motion",
        "UR5e moved by no motor",
        "Torques of inertia, of speeds and of gravity cancel to what the rounding of the accelerations leaves.",
        ur5e(),
        free_motion(ur5e()),
    )
    yield Case(
        84,
        "gantry",
        "slides of 1000, 100 and 10 kg, and a wrist of 1 g",
        "Forces and torques of sizes that differ by 10⁹, and joints that slide.",
        gantry(),
        COMMON,
    )
    yield Case(
        85,
        "star",
        "a trunk with seven limbs of 1 mg to 3 t",
        "Contributions of all sizes meet in one sum.",
        star(),
        drawn(8, 85),
    )
    nearly = changed(scaled(ur5e(), 4, 0), 5, rotation=rpy(2.0**-10, 0.0, 0.0), translation=[0.0, 0.0, 0.25])
    yield Case(
        86,
        "nearly-coincident",
        "UR5e, last two axes 10⁻³ rad apart, no mass between",
        "M is nearly singular: its smallest pivot is a square of the angle.",
        nearly,
        COMMON,
    )
    spin = moved(None, lambda k, i, x: 2e4 if i == 5 else x, None)
    yield Case(
        87,
        "gyroscope",
        "a rotor at 20 000 rad/s in gimbals on an arm",
        "The couples of the rotor exceed those of everything else.",
        gyroscope(),
        spin,
    )
    turned = moved(lambda k, i, x: x + (-1) ** i * 1000 * math.tau)
    yield Case(
        88,
        "thousand-turns",
        "UR5e after a thousand turns of each joint",
        "Reduction of 6283 rad: a sine in f32 needs four parts of the step.",
        ur5e(),
        turned,
    )
    far = changed(ur5e(), 5, com=[0.0, 0.0, 1000.0], inertia=[single(x) for x in (1e-3, 0, 0, 1e-3, 0, 1e-3)])
    yield Case(
        89,
        "far-mass",
        "UR5e, the last centre of mass 1 km off",
        "The last link's own inertia is 10⁻⁹ of m r², from which it is lost in f32; its last axis turns with that alone.",
        far,
        COMMON,
    )
    upright = at([[0.0, -math.pi / 2, 0.0, -math.pi / 2, 0.0, 0.0], [0.0, math.pi / 2, 0.0, math.pi / 2, math.pi, 0.0]])
    yield Case(
        90,
        "upright",
        "UR5e stretched upright and hanging",
        "Gravity's torques nearly vanish about all joints together, and the arm is singular.",
        ur5e(),
        [(q, still(6), still(6)) for q, _, _ in upright],
    )
    so101_rest = [(q, still(6), still(6)) for q, _, _ in corners(SO101)]
    yield Case(
        91,
        "so101-rest",
        "SO-101 at rest at corners of the box of its certificate",
        "The first axis is vertical, and the proven error of its torque of gravity is 49 times the worst observed one, the largest ratio of all certificates.",
        so101(),
        so101_rest,
    )
    yield Case(
        92,
        "so101-corners",
        "SO-101 at corners of its box",
        "Links of 12 g to 104 g at 10 rad/s, and inertias of 10⁻⁶ kg·m².",
        so101(),
        corners(SO101),
    )
