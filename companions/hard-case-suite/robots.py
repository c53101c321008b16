"""The robots of the cases: links as the suite writes them, every number one that f32 has (but
rotations and axes)."""

import math
import struct

DOWN = [0.0, 0.0, -9.8125]  # a number that f32 has


def single(x):
    """The number of f32 nearest to x."""
    return struct.unpack("<f", struct.pack("<f", x))[0]


def neighbour(x, step):
    """The number of f32 that is `step` units in the last place above x > 0 or further from zero if
    x < 0."""
    return struct.unpack("<f", struct.pack("<i", struct.unpack("<i", struct.pack("<f", x))[0] + step))[0]


X, Y, Z = [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]
QUARTER = {0: (0.0, 1.0), 1: (1.0, 0.0), 2: (0.0, -1.0), 3: (-1.0, 0.0)}  # sine, cosine


def of_angles(roll, pitch, yaw):
    """The rotation of sines and cosines about the fixed axes x, y, z, as in a URDF."""
    (sr, cr), (sp, cp), (sy, cy) = roll, pitch, yaw
    return [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]


def quarters(roll, pitch=0, yaw=0):
    return [[x + 0.0 for x in row] for row in of_angles(QUARTER[roll % 4], QUARTER[pitch % 4], QUARTER[yaw % 4])]


def rpy(*angles):
    return of_angles(*[(math.sin(x), math.cos(x)) for x in angles])


def link(
    parent, axis, at=(0, 0, 0), rotation=None, mass=0.0, com=(0, 0, 0), inertia=(0,) * 6, armature=0.0, joint="revolute"
):
    numbers = lambda row: [single(x) for x in row]
    return {
        "parent": parent,
        "joint": joint,
        "axis": axis,
        "rotation": rotation or quarters(0),
        "translation": numbers(at),
        "mass": single(mass),
        "com": numbers(com),
        "inertia": numbers(inertia),
        "armature": single(armature),
    }


def scaled(links, which, by):
    """Mass and inertia of a link times a number."""
    links = [dict(one) for one in links]
    heavy = links[which]
    heavy["mass"], heavy["inertia"] = single(heavy["mass"] * by), [single(x * by) for x in heavy["inertia"]]
    return links


def sized(links, size, mass):
    """All lengths and all masses times powers of two."""
    links = [dict(one) for one in links]
    for one in links:
        one["translation"] = [x * size for x in one["translation"]]
        one["com"] = [x * size for x in one["com"]]
        one["mass"] *= mass
        one["inertia"] = [x * mass * size * size for x in one["inertia"]]
    return links


def changed(links, which, **what):
    links = [dict(one) for one in links]
    links[which].update(what)
    return links


def ur5e():
    """Universal Robots UR5e: ur_description, config/ur5e (BSD-3-Clause)."""
    return [
        link(
            -1, Z, (0, 0, 0.1625), None, 3.761, (0, -0.00193, -0.02561),
            (0.0070021, 1.053e-5, 7.3e-7, 0.00657286, -4.9994e-4, 0.00648091)
        ),
        link(
            0, Z, (0, 0, 0), quarters(1), 8.058, (-0.2125, 0, 0.11336),
            (0.01505885, -5.4e-5, 5.63e-6, 0.33388086, -1.81e-6, 0.33247207)
        ),
        link(
            1, Z, (-0.425, 0, 0), None, 2.846, (-0.2422, 0, 0.0265),
            (0.00399632, -1.365e-5, 0.00137272, 0.07879254, -6.6e-6, 0.0784851)
        ),
        link(
            2, Z, (-0.3922, 0, 0.1333), None, 1.37, (0, -0.01634, -0.0018),
            (0.00165491, 4.38e-6, -2.82e-6, 0.00126279, -1.0157e-4, 0.00135962)
        ),
        link(
            3, Z, (0, -0.0997, 0), quarters(1), 1.3, (0, 0.01634, -0.0018),
            (0.00135617, 4.44e-6, 2.74e-6, 9.6614e-4, 5.048e-5, 0.00127827)
        ),
        link(
            4, Z, (0, 0.0996, 0), quarters(-1), 0.365, (0, 0, -0.001159),
            (1.8694e-4, 6.0e-8, -1.7e-7, 1.8908e-4, -9.2e-7, 2.5756e-4)
        ),
    ]


def panda():
    """Franka Emika Panda without a hand: the numbers of
    dynamics-core/src/robots/imported/panda.rs."""
    return [
        link(
            -1, Z, (0, 0, 0.333), None, 4.970684, (0.003875, 0.002081, -0.04762),
            (0.70337, -0.000139, 0.006772, 0.70661, 0.019169, 0.009117)
        ),
        link(
            0, Z, (0, 0, 0), quarters(-1), 0.646926, (-0.003141, -0.02872, 0.003495),
            (0.007962, -0.003925, 0.010254, 0.02811, 0.000704, 0.025995)
        ),
        link(
            1, Z, (0, -0.316, 0), quarters(1), 3.228604, (0.027518, 0.039252, -0.066502),
            (0.037242, -0.004761, -0.011396, 0.036155, -0.012805, 0.01083)
        ),
        link(
            2, Z, (0.0825, 0, 0), quarters(1), 3.587895, (-0.05317, 0.104419, 0.027454),
            (0.025853, 0.007796, -0.001332, 0.019552, 0.008641, 0.028323)
        ),
        link(
            3, Z, (-0.0825, 0.384, 0), quarters(-1), 1.225946, (-0.011953, 0.041065, -0.038437),
            (0.035549, -0.002117, -0.004037, 0.029474, 0.000229, 0.008627)
        ),
        link(
            4, Z, (0, 0, 0), quarters(1), 1.666555, (0.060149, -0.014117, -0.010517),
            (0.001964, 0.000109, -0.001158, 0.004354, 0.000341, 0.005433)
        ),
        link(
            5, Z, (0.088, 0, 0), quarters(1), 0.735522, (0.010517, -0.004252, 0.061597),
            (0.012516, -0.000428, -0.001196, 0.010027, -0.000741, 0.004815)
        ),
    ]


def so101():
    """SO-101: the numbers of dynamics-core/src/robots/imported/so101.rs, quarter turns made
    exact."""
    shoulder = (8.3759e-5, 7.55525e-8, -1.16342e-6, 8.10403e-5, 1.54663e-7, 2.39783e-5)
    upper = (4.08002e-5, -1.97819e-5, -4.03016e-8, 0.000147318, 8.97326e-9, 0.000142487)
    lower = (2.87438e-5, 7.41152e-6, 1.26409e-6, 0.000159844, -4.90188e-8, 0.00014529)
    wrist = (3.68263e-5, 1.7893e-8, -5.28128e-8, 2.5391e-5, 3.6412e-6, 2.1e-5)
    gripper = (2.75087e-5, -3.35241e-7, -5.7352e-6, 4.33657e-5, -5.17847e-8, 3.45059e-5)
    jaw = (6.61427e-6, -3.19807e-7, -5.90717e-9, 1.89032e-6, -1.09945e-7, 5.28738e-6)
    return [
        link(
            -1, Z, (0.0388353, 0, 0.0624), quarters(2, 0, 2), 0.100006, (-0.0307604, -1.66727e-5, -0.0252713), shoulder
        ),
        link(
            0, Z, (-0.0303992, -0.0182778, -0.0542), quarters(0, -1, -1), 0.103, (-0.0898471, -0.00838224, 0.0184089),
            upper
        ),
        link(1, Z, (-0.11257, -0.028, 0), quarters(0, 0, 1), 0.104, (-0.0980701, 0.00324376, 0.0182831), lower),
        link(2, Z, (-0.1349, 0.0052, 0), quarters(0, 0, -1), 0.079, (-0.000103312, -0.0386143, 0.0281156), wrist),
        link(
            3, Z, (0, -0.0611, 0.0181), rpy(math.pi / 2, 0.0486795, math.pi), 0.087,
            (0.000213627, 0.000245138, -0.025187), gripper
        ),
        link(4, Z, (0.0202, 0.0188, -0.0234), quarters(1), 0.012, (-0.00157495, -0.0300244, 0.0192755), jaw),
    ]


def rod(i, mass, size, axis=Y, thin=0.0):
    """A rod along x on the one before."""
    across = mass * size * size / 12
    at = (0 if i == 0 else size, 0, 0)
    return link(i - 1, axis, at, None, mass, (size / 2, 0, 0), (thin * across, 0, 0, across, 0, across))


def chain(masses, size, in_space):
    """Rods, their axes across, or across and upright by turns."""
    return [rod(i, mass, size, Z if in_space and i % 2 else Y, 0.02) for i, mass in enumerate(masses)]


def points():
    """Point masses away from the axes, which turn by quarters."""
    return [link(i - 1, Z, (0.1, 0, 0.2), quarters(1), 1.5, (0.2, 0.1, 0.05)) for i in range(6)]


def tree(numbering):
    """A trunk with two limbs, one of which forks; its bodies in the order of `numbering`."""
    limbs = [
        (-1, Z, (0, 0, 0.3)),
        (0, Y, (0.2, 0.1, 0.3)),
        (0, X, (-0.2, 0.1, 0.3)),
        (1, X, (0.25, 0, -0.1)),
        (1, Z, (0.15, -0.2, 0.1)),
        (4, Y, (0.1, 0.1, 0.2)),
    ]
    links = []
    for old in numbering:
        parent, axis, at = limbs[old]
        parent = numbering.index(parent) if parent >= 0 else -1
        links.append(
            link(parent, axis, at, None, 0.5 + at[0], (0.05, at[1], -0.1), (0.02, 0.001, -0.002, 0.03, 0.0015, 0.025))
        )
    return links


def general():
    """Axes, placements and inertias without a zero."""
    links = []
    for k in range(6):
        axis = [0.3 - 0.2 * k, 0.5, 0.9]
        size = math.sqrt(sum(x * x for x in axis))
        turned = rpy(0.7 - 0.3 * k, 0.4 + 0.1 * k, -0.9 + 0.5 * k)
        inertia = (0.02, 0.001, -0.002, 0.018, 0.0015, 0.012)
        links.append(
            link(
                k - 1, [x / size for x in axis], (0.1 + 0.02 * k, -0.05, 0.2), turned, 3 - 0.4 * k, (0.02, 0.05, 0.1),
                inertia
            )
        )
    return links


def seesaw():
    """Five rods of 1 kg and 1 m, and on the other side of the first joint what balances them
    stretched."""
    return [link(-1, Y, (0, 0, 0), None, 17.5, (-1, 0, 0), (1, 0, 0, 1, 0, 1))] + [
        rod(i, 1.0, 1.0, Y, 0.02) for i in range(1, 6)
    ]


def gantry():
    """Three slides of 1000 kg to 10 kg, and a wrist of three light links of 1 g."""
    slides = [
        link(i - 1, axis, (0, 0, 0), None, mass, (0, 0, 0), (1, 0, 0, 1, 0, 1), joint="prismatic")
        for i, (axis, mass) in enumerate([(X, 1e3), (Y, 1e2), (Z, 1e1)])
    ]
    wrist = [
        link(i - 1, axis, (0, 0, -0.1), None, 1e-3, (0.01, 0.005, -0.02), (1e-6, 0, 0, 1e-6, 0, 1e-6))
        for i, axis in [(3, Z), (4, Y), (5, Z)]
    ]
    return slides + wrist


def star():
    """A trunk with seven limbs of 1 mg to 1000 kg."""
    trunk = link(-1, Z, (0, 0, 0.3), None, 1.0, (0.01, 0.02, 0.1), (0.02, 0.001, -0.002, 0.03, 0.0015, 0.025))
    limb = lambda k: link(
        0, [X, Y][k % 2], (0.1 * k, 0.2, 0.1), None, 10.0 ** (1.5 * k - 6), (0.1, 0.02, -0.2),
        [10.0 ** (1.5 * k - 8)] + [0, 0] + [10.0 ** (1.5 * k - 8), 0] + [10.0 ** (1.5 * k - 8)]
    )
    return [trunk] + [limb(k) for k in range(7)]


def gyroscope():
    """Three gimbals whose innermost is a rotor, on UR5e's first three links."""
    rings = [
        link(2 + i, axis, (-0.2 if i == 0 else 0, 0, 0), None, mass, (0, 0, 0), inertia)
        for i, (axis, mass, inertia) in enumerate(
            [
                (X, 0.1, (1e-4, 0, 0, 2e-4, 0, 1e-4)),
                (Y, 0.1, (1e-4, 0, 0, 1e-4, 0, 2e-4)),
                (Z, 1.0, (5e-4, 0, 0, 5e-4, 0, 1e-3)),
            ]
        )
    ]
    return ur5e()[:3] + rings
