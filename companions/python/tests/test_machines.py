"""Kinematic loops, linkages and links that bend: against each other, against numpy, and what is
refused."""

import numpy as np
import pytest

import machines
import robot_dynamics as rd
from trees import states, urdf

Z3 = np.zeros(3)


def near(found, expected, share=1e-11):
    scale = max(np.abs(expected).max(), 1e-9)
    assert np.abs(found - expected).max() <= share * scale


def closed(kind, seed=28, bodies=("link0", "link7")):
    """A random tree, a state, and a loop between two of its bodies that is closed in it."""
    robot = rd.Robot.from_text(urdf(seed=seed, joints=8), exact=False)
    q, v, a, tau = (x[0] for x in states(robot, 1, seed))
    ends = [robot.body_index(body) for body in bodies]
    rotations, positions = (x[ends] for x in robot.poses(q))
    point = np.array([0.3, -0.2, 0.1])
    xyz = [turn.T @ (point - at) for turn, at in zip(rotations, positions)]
    # Axes of the frame on the successor are those of the base; on the predecessor those that
    # coincide with them.
    rpy = [angles(turn.T) for turn in rotations]
    joint = rd.LoopJoint("loop", kind, bodies, xyz, rpy)
    return robot, joint, (q, v, a, tau), (ends, point)


def angles(turn):
    return [np.arctan2(turn[2, 1], turn[2, 2]), -np.arcsin(turn[2, 0]), np.arctan2(turn[1, 0], turn[0, 0])]


ROWS = {"fixed": [0, 1, 2, 3, 4, 5], "revolute": [0, 1, 3, 4, 5], "prismatic": [0, 1, 2, 3, 4], "spherical": [3, 4, 5],
        "cylindrical": [0, 1, 3, 4], "planar": [0, 1, 5]}  # fmt: skip


def constraint(robot, q, v, ends, point, rows):
    """K, and k at these rates, of the relative motion at a point along the base's axes."""
    def at(j):
        return np.vstack([j[:3], j[3:] + np.cross(j[:3].T, point).T])

    k = at(robot.jacobian(q, ends[1], "world")) - at(robot.jacobian(q, ends[0], "world"))
    velocities, accelerations = robot.kinematics(q, v, np.zeros_like(v), "world")
    bias = []
    for end in ends:
        (w, u), (dw, du) = (np.split(x[end], 2) for x in (velocities, accelerations))
        bias.append(np.concatenate([dw, du + np.cross(dw, point) + np.cross(w, u + np.cross(w, point))]))
    return k[rows], bias[0][rows] - bias[1][rows]


@pytest.mark.parametrize("kind", ROWS)
def test_forward_dynamics_of_loops_is_that_of_their_kkt_system(kind):
    robot, joint, (q, v, a, tau), (ends, point) = closed(kind)
    loops = rd.Loops(robot, [joint])
    k, _ = constraint(robot, q, v, ends, point, ROWS[kind])
    v = v - np.linalg.pinv(k) @ (k @ v)  # a velocity that keeps the loop closed
    k, bias = constraint(robot, q, v, ends, point, ROWS[kind])
    nl, h = len(ROWS[kind]), 1e-5
    found, right, *_ = loops.constraints(q, v)
    before, after = (loops.constraints(q + t * v + t * t / 2 * a, v + t * a)[3] for t in (-h, h))
    near((after - before) / (2 * h), found @ a - right, 1e-7)
    if kind not in ("fixed", "spherical"):
        v, bias = 0.0 * v, 0.0 * bias  # the axes of others turn with the successor
    found, right, position, velocity = loops.constraints(q, v)
    assert loops.nl == nl and found.shape == (nl, robot.nv) and np.abs(position).max() < 1e-12
    assert np.abs(velocity).max() < 1e-12 and np.abs(found @ v).max() < 1e-12
    near(found.T @ np.linalg.pinv(found @ found.T) @ found, k.T @ np.linalg.pinv(k @ k.T) @ k)
    zero = np.zeros((nl, nl))
    kkt = np.block([[robot.crba(q), k.T], [k, zero]])
    rest = np.concatenate([tau - robot.bias(q, v), bias])
    expected = np.linalg.lstsq(kkt, rest, rcond=1e-12)[0][: robot.nv]
    qdd, force, rank = loops.forward_dynamics(q, v, tau)
    near(qdd, expected, 1e-9)
    assert np.abs(found @ qdd - right).max() < 1e-9 * np.abs(qdd).max()
    assert rank == np.linalg.matrix_rank(k) == nl
    near(robot.crba(q) @ qdd + robot.bias(q, v) - tau, found.T @ force, 1e-9)


def test_a_humanoid_stands_on_its_ankles():
    robot = rd.Robot("g1_free")
    q, v, _, tau = (x[0] for x in states(robot, 1))
    at = dict(zip(robot.bodies, robot.poses(q)[1]))
    feet = [rd.LoopJoint(foot, "spherical", (None, foot), (at[foot], Z3)) for foot in at if "ankle_roll" in foot]
    loops = rd.Loops(robot, feet, range(6, robot.nv))
    k, bias, *_ = loops.constraints(q, 0.0 * v)
    kkt = np.block([[robot.crba(q), k.T], [k, np.zeros((6, 6))]])
    tau[:6] = 0.0
    expected = np.linalg.solve(kkt, np.concatenate([tau - robot.bias(q, 0.0 * v), bias]))[: robot.nv]
    qdd, _, rank = loops.forward_dynamics(q, 0.0 * v, tau[6:])
    near(qdd, expected, 1e-10)
    assert rank == 6 and k.shape == (6, 35)


@pytest.mark.parametrize("kind", ["revolute", "spherical"])
def test_inverse_dynamics_of_loops_returns_the_motion(kind):
    robot, joint, (q, v, a, _), _ = closed(kind)
    loops = rd.Loops(robot, [joint])
    tau, qd, qdd, force, redundant = loops.inverse_dynamics(q, v, a)
    map, freedoms = loops.coordinate_map(q)
    assert redundant == robot.nv - freedoms == loops.nl and loops.mobility(q) == (freedoms, freedoms)
    k, *_ = loops.constraints(q, qd)
    assert np.abs(k @ map).max() < 1e-10
    near(qd, map @ v)
    near(loops.forward_dynamics(q, qd, tau)[0], qdd, 1e-9)
    tree = robot.rnea(q, qd, qdd)
    columns = map[:, np.abs(map).max(axis=0) > 0.0]
    near(columns.T @ tau, columns.T @ tree, 1e-10)
    near(tau, np.linalg.pinv(columns.T) @ columns.T @ tree, 1e-10)  # the least of all
    near(tree - tau, k.T @ force, 1e-9)


def test_a_linkage_is_its_general_loop():
    robot = machines.bars()
    loops = rd.Loops(robot, [machines.pin()], ["crank_joint"])
    linkages = rd.Linkages(robot, [("bars", machines.four_bar(), ["crank_joint", 1, 2])])
    assert (linkages.names, linkages.py, linkages.ny, loops.actuated, loops.names) == (["bars"], 1, 1, [0], ["pin"])
    y, yd, ydd = (np.random.default_rng(3).uniform(-3.0, 3.0, (100, 1)) for _ in range(3))
    q, qd, qdd, g, singular = linkages.motion(y, yd, ydd)
    assert not singular.any()
    near(loops.assemble(q + [0.0, 0.05, -0.03]), q, 1e-9)
    tau, rates, accelerations, _, redundant = loops.inverse_dynamics(q, yd, ydd)
    assert not redundant.any()
    near(rates, qd, 1e-9)
    near(accelerations, qdd, 1e-9)
    near(linkages.rnea(y, yd, ydd), tau, 1e-9)
    near(loops.coordinate_map(q)[0], g, 1e-9)
    near(linkages.forward_dynamics(y, yd, tau), ydd, 1e-8)
    near(loops.forward_dynamics(q, qd, tau)[0], qdd, 1e-8)


RODS = [([0.0, side * 0.03, 0.25], [-0.04, 0.0, 0.0], [-0.04, side * 0.03, 0.0], 0.25, False) for side in (1.0, -1.0)]
LEGS = [([np.cos(a), np.sin(a), 0.0], [0.5 * np.cos(b), 0.5 * np.sin(b), 0.0], 1.0)
        for a, b in zip(np.radians([10, 110, 130, 230, 250, 350]), np.radians([50, 70, 170, 190, 290, 310]))]  # fmt: skip
LINKAGES = {
    "four_bar": (machines.four_bar, [0.7]),
    "five_bar": (lambda: rd.FiveBar(0.05, [0.12, 0.22], [0.11, 0.2]), [2.0, 0.9]),
    "differential": (lambda: rd.Differential([1.0, 2.5]), [0.3, -0.2]),
    "belt": (lambda: rd.Belt([0.1, 2.0, 0.3]), [0.4]),
    "ankle": (lambda: rd.ParallelAnkle(RODS), [0.2, 0.1]),
    "delta": (lambda: rd.Delta(0.2, 0.2, 0.5, 0.05), [0.3, 0.4, 0.2]),
    "stewart": (lambda: rd.Stewart(LEGS), [0.1, 0.05, 1.0, 0.1, -0.1, 0.2]),
}


@pytest.mark.parametrize("name", LINKAGES)
def test_rates_of_linkages_are_derivatives_of_positions(name):
    make, y = LINKAGES[name]
    linkage, y = make(), np.array(y)
    # Any joints of one coordinate that stand on the base.
    joints = "".join(machines.bar("base", f"b{i}", 0.1 * i, 1.0) for i in range(linkage.driven))
    robot = rd.Robot.from_text(f'<robot name="r"><link name="base"/>{joints}</robot>')
    linkages = rd.Linkages(robot, [(name, linkage, list(range(linkage.driven)))])
    assert linkages.ny == linkage.independent == len(y)
    yd, ydd = np.linspace(0.5, 1.0, len(y)), np.linspace(-1.0, 0.5, len(y))
    q, qd, qdd, g, singular = linkages.motion(y, yd, ydd)
    near(g @ yd, qd)
    h = 1e-4
    before, after = (linkages.motion(y + t * yd + t * t / 2 * ydd, yd + t * ydd, ydd) for t in (-h, h))
    near((after[0] - before[0]) / (2 * h), qd, 1e-6)
    near((after[1] - before[1]) / (2 * h), qdd, 1e-6)
    near(linkages.forward_dynamics(y, yd, linkages.rnea(y, yd, ydd)), ydd, 1e-8)
    assert np.array_equal(linkages.rnea(np.array([y, y]), np.array([yd, yd]), np.array([ydd, ydd]))[1], linkages.rnea(y, yd, ydd))
    # τ at y does the work of the tree's torques.
    near(linkages.rnea(y, yd, ydd), g.T @ robot.rnea(q, qd, qdd))


MJCF = """<mujoco model="m"><compiler angle="radian"/><worldbody>
<body name="crank"><joint name="a" axis="0 1 0"/><inertial pos="0.1 0 0" mass="0.5" diaginertia="0.01 0.01 0.01"/>
<body name="coupler" pos="0.2 0 0"><joint name="b" axis="0 1 0"/><inertial pos="0.2 0 0" mass="1" diaginertia="0.01 0.02 0.02"/></body></body>
<body name="rocker" pos="0.6 0 0"><joint name="c" axis="0 1 0"/><inertial pos="0.2 0 0" mass="0.8" diaginertia="0.01 0.01 0.01"/></body>
</worldbody><equality><connect name="pin" body1="coupler" body2="rocker" anchor="0.5 0 0"/></equality>
<actuator><motor joint="a"/></actuator></mujoco>"""


def test_loops_of_a_file_are_its_equality_constraints():
    robot = rd.Robot.from_text(MJCF)
    loops = rd.Loops(robot)
    assert (loops.names, loops.actuated, loops.nl) == (["pin"], [0], 3)
    assert np.array_equal(rd.Loops(robot, actuated=["a", "c"]).actuated, [0, 2])
    q = loops.assemble([-1.0, 0.5, -1.5])
    position = loops.constraints(q, Z3)[2]
    assert np.abs(position).max() < 1e-13 and q[0] == -1.0
    tau, *_ = loops.inverse_dynamics(q, [0.0], [0.0])
    # Virtual work of the weight.
    map, _ = loops.coordinate_map(q)
    near(tau, map.T @ robot.gravity(q))
    with pytest.raises(rd.LoopModelError, match="0 loops"):
        rd.Loops(rd.Robot("ur5e"))
    # Without the coordinates that fill the model up.
    with pytest.raises(rd.LoopModelError, match="2 of at least 3"):
        rd.Loops(rd.Robot("ur5e"), [rd.LoopJoint("table", "planar", (None, "wrist_3"))], [0, 1])


def test_what_loops_cannot_be_is_named():
    robot = machines.bars()
    pin, ends = machines.pin(), ("coupler", "rocker")
    for joints, actuated, text, loop in (
        ([rd.LoopJoint("l", "revolute", ("rocker", "rocker"))], [0], "same body", "l"),
        ([rd.LoopJoint("l", "revolute", ends, axis=[0.0, 0.0, 0.0])], [0], "axis", "l"),
        ([rd.LoopJoint("l", "revolute", ends, ([5.0, 0.0, 0.0], [0.4, 0.0, 0.0]))], [0], "longer", "l"),
        ([rd.LoopJoint("l", "spherical", ends, rpy=([90.0, 0.0, 0.0], Z3))], [0], "rad", "l"),
        ([pin], [0, 0], "twice", "bars"),
        ([rd.LoopJoint("l", "planar", ends)] * 0, [0], "0 loops", "bars"),
        ([pin] * 9, [0], "9 loops", "bars"),
    ):
        with pytest.raises(rd.LoopModelError, match=text) as error:
            rd.Loops(robot, joints, actuated)
        assert error.value.loop == loop
    with pytest.raises(rd.LoopModelError, match="hinge"):
        rd.LoopJoint("l", "hinge", ends)
    with pytest.raises(rd.UnknownBody):
        rd.Loops(robot, [rd.LoopJoint("l", "fixed", ("hand", None))])
    for wrong in (3, "elbow", -1):
        with pytest.raises(rd.UnknownCoordinate):
            rd.Loops(robot, [pin], [wrong])
    loops = rd.Loops(robot, [pin], [0])
    q = np.array([loops.assemble([1.0, -0.5, 1.5])] * 4)
    q[2, 1] += 1.0
    with pytest.raises(rd.LoopOpen, match="`pin` is open") as error:
        loops.inverse_dynamics(q, np.zeros((4, 1)), np.zeros((4, 1)))
    assert error.value.loop == "pin" and error.value.state == 2 and error.value.error > 0.1
    huge = np.full((3, 3), 1e250)
    with pytest.raises(rd.NotFinite) as error:
        loops.forward_dynamics(q[[0, 1, 3]], huge, np.zeros((3, 1)))
    assert error.value.loop == "pin" and error.value.state == 0
    with pytest.raises(rd.UnderActuated) as error:
        rd.Loops(robot, [rd.LoopJoint("l", "planar", (None, "rocker"))], [2]).coordinate_map(Z3)
    assert error.value.joint in ("crank_joint", "coupler_joint") and error.value.state == 0
    with pytest.raises(rd.ShapeError):
        loops.inverse_dynamics(q[0], Z3, Z3)
    for scene in (rd.Gravity(), rd.RIGID_BODY + rd.LoadFriction(Z3 + 0.1, Z3 + 0.1, 0.1)):
        with pytest.raises(rd.EffectError):
            loops.forward_dynamics(q[0], Z3, [0.0], scene)


def test_dead_points_of_motors_are_told():
    robot = machines.bars()
    q = rd.Loops(robot, [machines.pin()], [0]).assemble([0.0, 0.7, 1.8])
    # Driven at the rocker, the crank is at a dead point where crank and coupler are in line.
    folded = rd.Linkages(robot, [("bars", machines.four_bar(), [0, 1, 2])])
    y = np.linspace(-np.pi, np.pi, 20001)[:, None]
    line = folded.motion(y, 0 * y, 0 * y)[0]
    dead = line[np.abs(np.sin(line[:, 1])).argmin()]
    rocker = rd.Loops(robot, [machines.pin()], [2])
    assert rocker.inverse_dynamics(dead, [0.0], [0.0])[4] == -1.0
    assert rocker.inverse_dynamics(q, [0.0], [0.0])[4] == 0.0
    tau = rocker.inverse_dynamics(dead, [0.0], [0.0])[0]
    assert np.isfinite(tau).all()


def test_what_linkages_cannot_be_is_named():
    robot = machines.bars()
    bar = machines.four_bar()
    for coordinates, text in (([0, 1], "drives 3"), ([0, 1, 1], "twice")):
        with pytest.raises(rd.LinkageError, match=text) as error:
            rd.Linkages(robot, [("knee", bar, coordinates)])
        assert error.value.linkage == "knee" and error.value.state is None
    tree = rd.Robot("a1")
    with pytest.raises(rd.LinkageError, match="one body outside"):
        rd.Linkages(tree, [("wrist", rd.Differential([1.0, 1.0]), [2, 4])])
    with pytest.raises(rd.LinkageError, match="part of a joint"):
        rd.Linkages(rd.Robot("a1_free"), [("w", rd.Differential([1.0, 1.0]), [0, 1])])
    for make, text in (
        (lambda: rd.FourBar(1.0, 0.1, 0.1, 0.1), "longest link"),
        (lambda: rd.FourBar(1.0, float("nan"), 1.0, 1.0), "not finite"),
        (lambda: rd.Differential([0.0, 1.0]), "ratio is zero"),
        (lambda: rd.Belt([1.0] * 9), "more than 8"),
        (lambda: rd.Delta(1.0, 0.1, 0.1, 0.0), "do not reach"),
    ):
        with pytest.raises(rd.LinkageError, match=text):
            make()
    with pytest.raises(rd.UnknownCoordinate):
        rd.Linkages(robot, [("knee", bar, [0, 1, 3])])
    short = rd.Linkages(robot, [("knee", rd.FourBar(0.6, 0.5, 0.3, 0.4), [0, 1, 2])])
    y = np.array([[0.3], [0.2], [np.pi]])
    with pytest.raises(rd.LinkageError, match="do not reach each other") as error:
        short.rnea(y, 0 * y, 0 * y)
    assert error.value.linkage == "knee" and error.value.state == 2


def test_inertia_and_torques_of_links_that_bend_agree():
    boom, random = machines.boom(), np.random.default_rng(7)
    assert boom.nm == 3
    q, qd, qdd = (random.uniform(-2.0, 2.0, 2) for _ in range(3))
    eta, etad, etadd = (random.uniform(-0.05, 0.05, 3) for _ in range(3))
    joints, coupling, modes = boom.crba(q, eta)
    m = np.block([[joints, coupling.T], [coupling, modes]])
    whole = lambda pair: np.concatenate(pair)  # noqa: E731
    at = whole(boom.rnea(q, qd, np.zeros(2), eta, etad, Z3))
    near(whole(boom.rnea(q, qd, qdd, eta, etad, etadd)) - at, m @ np.concatenate([qdd, etadd]), 1e-10)
    tau, force = boom.rnea(q, qd, qdd, eta, etad, etadd)
    free = boom.modal_dynamics(q, qd, qdd, eta, etad)
    tau, force = boom.rnea(q, qd, qdd, eta, etad, free)
    assert np.abs(force).max() < 1e-10
    found, modes_found = boom.forward_dynamics(q, qd, tau, eta, etad)
    near(found, qdd, 1e-9)
    near(modes_found, free, 1e-9)
    rest = boom.at_rest(q)
    assert np.abs(boom.rnea(q, np.zeros(2), np.zeros(2), rest, Z3, Z3)[1]).max() < 1e-5 and rest[0] != 0.0


def test_a_beam_has_its_closed_frequencies_and_a_stiff_one_none():
    bare = rd.Beam(0.5, 0.8, bending=[4.0, 4.0])
    text = machines.link("beam", bare.mass, bare.com, bare.inertia) + machines.joint("base", "beam", 0.0, "0 1 0")
    robot = rd.Robot.from_text(f'<robot name="r"><link name="base"/>{text}</robot>', exact=False)
    clamped = rd.FlexibleRobot(robot, [bare.link(0, [("bend_z", 1), ("bend_z", 2)])])
    expected = np.array([1.875104068711961, 4.694091132974175]) ** 2 * np.sqrt(4.0 / 0.8) / 0.25
    near(clamped.frequencies([0.3], [0.0, 0.0]), expected, 1e-6)
    state = [0.3], [1.0], [2.0], [0.0, 0.0], [0.0, 0.0], [0.0, 0.0]
    near(clamped.rnea(*state)[0], robot.rnea(*state[:3]))
    batch = [np.array([x, x, x]) for x in state]
    assert np.array_equal(clamped.rnea(*batch)[1][2], clamped.rnea(*state)[1])


def test_feed_forward_moves_the_modes_along_their_equations():
    boom, h = machines.boom(), 1e-3

    def reference(t):
        return [np.full(2, x) for x in (0.3 * (1 - np.cos(5 * t)), 1.5 * np.sin(5 * t), 7.5 * np.cos(5 * t))]

    def rates(t, x):
        return np.concatenate([x[3:], boom.modal_dynamics(*reference(t), x[:3], x[3:])])

    eta, etad, etadd = boom.at_rest(np.zeros(2)), Z3, Z3
    x, largest = np.concatenate([eta, Z3]), 0.0
    for t in h * np.arange(400):
        tau, eta, etad, etadd = boom.tick(*reference(t + h), eta, etad, etadd, h)
        near(tau, boom.rnea(*reference(t + h), eta, etad, etadd)[0])
        k1 = rates(t, x)
        k2 = rates(t + h / 2, x + h / 2 * k1)
        k3 = rates(t + h / 2, x + h / 2 * k2)
        x = x + h / 6 * (k1 + 2 * k2 + 2 * k3 + rates(t + h, x + h * k3))
        largest = max(largest, np.abs(eta - x[:3]).max())
    assert largest < 1e-3  # of 0.07 m


def test_what_modes_cannot_be_is_named():
    robot = machines.bars()
    beam = machines.BEAM
    with pytest.raises(rd.ModeError, match="rigid motion") as error:
        rd.FlexibleRobot(robot, [beam.link("crank", [("bend_z", 1)])])
    assert error.value.link == "crank" and error.value.mode == 0
    with pytest.raises(rd.ModeError, match="no shape"):
        beam.link("crank", [("bend", 1)])
    with pytest.raises(rd.ModeError, match="stiffness"):
        rd.Beam(0.5, 0.8).link("crank", [("bend_z", 1)])
    with pytest.raises(rd.ModeError, match="at most 8"):
        rd.FlexibleRobot(robot, [beam.link("crank", [("bend_z", i) for i in range(1, 6)])] * 2)
    mode = rd.Mode([0.0, 0.0, 0.1], [[0.0] * 3] * 3, [0.0, 0.0, 1.0], [0.0] * 3)
    with pytest.raises(rd.ModeError, match="rows and columns"):
        rd.FlexibleLink("crank", [0.5, 0.0, 0.0], [mode], [[np.zeros((3, 3))]], [[1.0, 0.0]], [[0.0]])
    with pytest.raises(rd.ModeError, match="moves no mass"):
        rd.FlexibleRobot(robot, [rd.FlexibleLink("crank", [0.5, 0.0, 0.0], [mode], [[np.zeros((3, 3))]], [[1.0]], [[0.0]])])
    with pytest.raises(rd.UnknownBody):
        rd.FlexibleRobot(robot, [beam.link("hand", [("bend_z", 1)])])
    with pytest.raises(rd.ModelError, match="at most 16"):
        rd.FlexibleRobot(rd.Robot("g1"), [beam.link(0, [("bend_z", 1)])])
    boom = machines.boom()
    with pytest.raises(rd.ModeError) as error:
        boom.modal_dynamics(*[np.zeros((2, 2))] * 3, np.array([Z3, Z3 + 1e300]), np.zeros((2, 3)))
    assert error.value.state == 1
