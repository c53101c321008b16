"""Cases 71 to 94: what the proofs of error bounds find hard (companions/certification)."""

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

# States at which a search over a million found the worst errors of the first four torques, by
# `certify --json`.
UR5E_WORST = [
    (
        [-0.6715471148490906, 5.787980079650879, -0.2891339361667633, 4.119882583618164, -1.2044637203216553, -3.880908966064453],
        [3.1415927410125732, 3.1415927410125732, 3.0564327239990234, 3.141592502593994, 2.7093582153320312, 3.140886068344116],
        [10.0, -9.926730155944824, -6.8091301918029785, -9.999992370605469, 9.99986457824707, 7.644986152648926],
    ),
    (
        [0.7090639472007751, 5.824457168579102, -0.2800798714160919, -1.8798778057098389, 6.211093425750732, -2.8659467697143555],
        [3.1170034408569336, 3.1415927410125732, 3.1415927410125732, -3.1415927410125732, 2.6418168544769287, -3.012962818145752],
        [9.999990463256836, -9.691706657409668, -9.69039535522461, -9.999995231628418, 9.992758750915527, -9.998102188110352],
    ),
    (
        [6.282597541809082, -2.959874391555786, 0.9763347506523132, 4.665211200714111, 1.2000868320465088, -6.280332088470459],
        [-3.1415927410125732, -2.6370224952697754, -3.141591787338257, -3.116182804107666, 3.1415927410125732, 2.142568826675415],
        [-9.831963539123535, 10.0, 10.0, -9.897163391113281, 10.0, -8.093253135681152],
    ),
    (
        [6.179553985595703, 1.8775556087493896, -0.29388970136642456, 0.1747870147228241, -0.5443236827850342, 4.379305362701416],
        [-3.1415927410125732, 3.0546586513519287, 3.141592502593994, -2.433722734451294, -0.2809723913669586, -1.4915941953659058],
        [9.898872375488281, 10.0, 9.028451919555664, 4.9675374031066895, -0.49028345942497253, 6.2073774337768555],
    ),
]

PANDA_WORST = [
    (
        [1.565912127494812, 1.368788719177246, 2.7627665996551514, -0.4066007435321808, 0.5895168781280518, 2.03767728805542, 0.9652442932128906],
        [2.174999952316284, -2.12431001663208, 2.1142661571502686, -2.1619081497192383, 2.6086432933807373, 0.48137032985687256, 0.771854817867279],
        [-8.54277229309082, -9.410639762878418, 10.0, -8.218389511108398, -9.610520362854004, 9.999996185302734, 9.667193412780762],
    ),
    (
        [2.0861356258392334, -1.0539964437484741, -1.1483328342437744, -0.199380025267601, -2.7755956649780273, 1.486558437347412, -1.8229347467422485],
        [2.174999952316284, 2.174999952316284, 2.1634163856506348, -1.9861831665039062, -1.1858454942703247, 1.6196424961090088, -2.2298004627227783],
        [-10.0, 10.0, -8.710673332214355, -4.346899509429932, 7.479394435882568, 0.06238245218992233, 9.995585441589355],
    ),
    (
        [-1.619254231452942, 0.9343224167823792, 1.0551376342773438, -1.1855599880218506, -2.4904730319976807, 1.9527320861816406, -0.13270574808120728],
        [-2.174999952316284, -2.174999952316284, -2.173398017883301, 2.174999952316284, -2.609999895095825, -2.4827558994293213, 0.4415680170059204],
        [10.0, -10.0, 10.0, -9.992249488830566, 9.99428939819336, 9.275601387023926, -9.999996185302734],
    ),
    (
        [-0.2516545355319977, -0.03665631636977196, -1.2228325605392456, -1.3807621002197266, 1.9843814373016357, 1.749084711074829, -2.487981081008911],
        [-2.174999952316284, 2.174999952316284, -2.174999952316284, -2.007639169692993, 2.6099016666412354, 2.609999895095825, 0.9687309861183167],
        [10.0, -8.956598281860352, 8.714313507080078, 10.0, -6.36707067489624, -9.999982833862305, -4.761876106262207],
    ),
]



def found():
    rest = [(q, still(6), still(6)) for q, _, _ in COMMON]
    yield Case(
        71, "vertical-axis", "UR5e at rest, its first axis vertical",
        "Gravity has no torque about the first axis: all that the bodies contribute cancels to zero.", ur5e(), rest
    )

    balance = [([a] + [0.0] * 5, still(6), still(6)) for a in (0.0, single(0.7), single(-2.5))]
    balance += [([0.0, b] + [0.0] * 4, still(6), still(6)) for b in (2.0**-20, single(1e-3), single(1.5))]
    balance += [([a] + [0.0] * 5, COMMON[0][1], COMMON[0][2]) for a in (0.0, single(0.7))]
    yield Case(
        72, "balance", "a stretched arm that its counterweight balances",
        "Torques of gravity of 170 N·m cancel to zero about the first joint, and to a millionth of that beside it.",
        seesaw(), balance
    )

    heavy_and_light = [1e3 if i % 2 == 0 else 1e-3 for i in range(16)]
    yield Case(
        73, "heavy-light", "16 rods of 1000 kg and 1 g by turns", "Sums of sizes that differ by 10⁶ along the chain.",
        chain(heavy_and_light, 0.25, True), drawn(16, 73, 2)
    )
    yield Case(
        74, "light-heavy", "16 rods of 1 g and 1000 kg by turns", "As case 73, with the heavy rod at the end.",
        chain(heavy_and_light[1:] + [1e3], 0.25, True), drawn(16, 74, 2)
    )
    growing = [10.0 ** (-3 + 0.5 * i) for i in range(11)]
    yield Case(
        75, "growing", "eleven rods of 1 g to 100 kg, each √10 times the one before",
        "Every pivot is what remains of a number ten times as large.", chain(growing, 0.25, True), drawn(11, 75)
    )

    step = math.tau / 128
    middles = [[(k + 0.5) * step for k in row] for row in ([0, 7, -9, 16, 31, -32], [-64, 63, 48, -17, 33, 1])]
    yield Case(
        76, "seams", "UR5e between two entries of a table of 128 sines, ± 1 ulp",
        "At the seams of a table the rest of the reduction is largest, and one bit decides which entry counts.",
        ur5e(), beside(middles)
    )
    entries = [[k * step for k in row] for row in ([1, 7, -9, 15, 31, -33], [-65, 63, 47, -17, 33, 2])]
    yield Case(
        77, "entries", "UR5e at the entries of a table of 128 sines, ± 1 ulp",
        "The rest of the reduction is a difference of nearly equal numbers.", ur5e(), beside(entries)
    )

    slow = moved(None, lambda k, i, x: x * 1e-40, lambda k, i, x: x * 1e-40)
    yield Case(
        78, "subnormal-rates", "UR5e without gravity at 10⁻⁴⁰ rad/s and rad/s²",
        "Speeds, accelerations and torques are subnormal in f32, and products of speeds vanish.", ur5e(), slow,
        gravity=NO_GRAVITY, underflow=(64 * SMALLEST[0], 0.0)
    )
    f64_slow = [(q, [x * 2.0**-1030 for x in qd], [x * 2.0**-1030 for x in qdd]) for q, qd, qdd in COMMON]
    yield Case(
        79, "subnormal-rates-f64", "UR5e without gravity at 10⁻³¹⁰ rad/s and rad/s²",
        "As case 78 for f64; f32 does not have the numbers.", ur5e(), f64_slow, gravity=NO_GRAVITY,
        underflow=(0.0, 64 * SMALLEST[1]), in_f32=False
    )
    dust = changed(
        ur5e(), 5, mass=single(1e-38), inertia=[single(x) for x in (2e-42, 0, 0, 2e-42, 0, 3e-42)], com=[0.0, 0.0, 0.0]
    )
    # The reciprocal of the last pivot exceeds f32: a solver that uses it refuses rather than
    # divide.
    yield Case(
        80, "subnormal-inertia", "UR5e, last link of 10⁻³⁸ kg and 3·10⁻⁴² kg·m²",
        "The last pivot is subnormal in f32: a flush to zero makes M singular.", dust, COMMON,
        underflow=(64 * SMALLEST[0], 0.0), refusal=["f32"]
    )

    yield Case(
        81, "panda-corners", "Panda at corners of the box of its certificate",
        "The proven error is up to 17 times the worst observed one, the largest ratio of all certificates; by intervals alone it is 38 times.",
        panda(), corners(PANDA)
    )
    still_panda = [(q, still(7), still(7)) for q, _, _ in corners(PANDA)]
    yield Case(
        82, "panda-rest", "Panda at rest at corners of its box",
        "Gravity alone, of which the certificate knows less than a hundredth of the whole.", panda(), still_panda
    )

    yield Case(
        83, "free-motion", "UR5e moved by no motor",
        "Torques of inertia, of speeds and of gravity cancel to what the rounding of the accelerations leaves.",
        ur5e(), free_motion(ur5e())
    )
    yield Case(
        84, "gantry", "slides of 1000, 100 and 10 kg, and a wrist of 1 g",
        "Forces and torques of sizes that differ by 10⁹, and joints that slide.", gantry(), COMMON
    )
    yield Case(
        85, "star", "a trunk with seven limbs of 1 mg to 3 t", "Contributions of all sizes meet in one sum.", star(),
        drawn(8, 85)
    )
    nearly = changed(scaled(ur5e(), 4, 0), 5, rotation=rpy(2.0**-10, 0.0, 0.0), translation=[0.0, 0.0, 0.25])
    yield Case(
        86, "nearly-coincident", "UR5e, last two axes 10⁻³ rad apart, no mass between",
        "M is nearly singular: its smallest pivot is a square of the angle.", nearly, COMMON
    )
    spin = moved(None, lambda k, i, x: 2e4 if i == 5 else x, None)
    yield Case(
        87, "gyroscope", "a rotor at 20 000 rad/s in gimbals on an arm",
        "The couples of the rotor exceed those of everything else.", gyroscope(), spin
    )
    turned = moved(lambda k, i, x: x + (-1) ** i * 1000 * math.tau)
    yield Case(
        88, "thousand-turns", "UR5e after a thousand turns of each joint",
        "Reduction of 6283 rad: a sine in f32 needs four parts of the step.", ur5e(), turned
    )
    far = changed(ur5e(), 5, com=[0.0, 0.0, 1000.0], inertia=[single(x) for x in (1e-3, 0, 0, 1e-3, 0, 1e-3)])
    yield Case(
        89, "far-mass", "UR5e, the last centre of mass 1 km off",
        "The last link's own inertia is 10⁻⁹ of m r², from which it is lost in f32; its last axis turns with that alone.",
        far, COMMON
    )
    upright = at([[0.0, -math.pi / 2, 0.0, -math.pi / 2, 0.0, 0.0], [0.0, math.pi / 2, 0.0, math.pi / 2, math.pi, 0.0]])
    yield Case(
        90, "upright", "UR5e stretched upright and hanging",
        "Gravity's torques nearly vanish about all joints together, and the arm is singular.", ur5e(),
        [(q, still(6), still(6)) for q, _, _ in upright]
    )
    so101_rest = [(q, still(6), still(6)) for q, _, _ in corners(SO101)]
    yield Case(
        91, "so101-rest", "SO-101 at rest at corners of the box of its certificate",
        "The first axis is vertical, and gravity has no torque about it but for roundings, which intervals bound at 49 times the worst observed one.",
        so101(), so101_rest
    )
    yield Case(
        92, "so101-corners", "SO-101 at corners of its box",
        "Links of 12 g to 104 g at 10 rad/s, and inertias of 10⁻⁶ kg·m².", so101(), corners(SO101)
    )
    yield Case(
        93, "worst-found", "UR5e where a search found the worst errors",
        "The largest errors of this library's torques among a million states of the box.", ur5e(), UR5E_WORST
    )
    yield Case(
        94, "panda-worst-found", "Panda where a search found the worst errors",
        "The same of an arm whose links are twisted by a quarter turn at each joint.", panda(), PANDA_WORST
    )
