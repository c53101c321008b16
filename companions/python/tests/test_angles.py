"""Angles of any size: right, or an error that names joint and state, in every algorithm."""

import math

import numpy as np
import pytest

import machines
import robot_dynamics as rd
from test_arrays import METHODS, all_of, arguments
from trees import states, urdf

RANGE = {np.float32: 1e4, np.float64: 1e5}
SIZES = {np.float32: (1.1e4, 2e5, 1e6, -3e9, 1e30), np.float64: (1.1e5, -2e9, 1e15, 1e300)}
SHARE = {np.float32: 1e-5, np.float64: 1e-12}
# They return positions, or depend on whole turns.
OF_WHOLE_TURNS = {"integrate", "elastic_inverse_dynamics"}


def turned(angle, dtype):
    """The same angle within half a turn, by the sine and cosine of C's library."""
    angle = float(dtype(angle))
    return math.atan2(math.sin(angle), math.cos(angle))


def tree(free=False):
    text = urdf(seed=5, joints=5, kinds=("continuous", "revolute"))
    return rd.Robot.from_text(text, free_base=free)


@pytest.mark.parametrize("dtype", RANGE)
@pytest.mark.parametrize("free", [False, True])
@pytest.mark.parametrize(("method", "names"), [row for row in METHODS if row[1].startswith("q")])
def test_an_angle_of_any_size_is_right_or_an_error(method, names, free, dtype):
    if (method == "base_velocity_from_momentum") != free and method != "rnea":
        pytest.skip("of a free base")
    robot = tree(free)
    first = 7 if free else 0
    for size in SIZES[dtype]:
        given = arguments(robot, names, 20, dtype)
        near = [argument.copy() if isinstance(argument, np.ndarray) else argument for argument in given]
        given[0][3, first + 1], near[0][3, first + 1] = size, turned(size, dtype)
        if method in OF_WHOLE_TURNS - {"integrate"}:
            with pytest.raises(rd.AngleError, match=f"`{robot.joints[free + 1]}`.*state 3") as error:
                all_of(getattr(robot, method)(*given))
            assert (error.value.joint, error.value.state) == (robot.joints[free + 1], 3)
            assert error.value.angle == dtype(size) and error.value.limit == RANGE[dtype]
            continue
        if method in ("integrate", "difference") and robot.joint_kinds[free + 1] == "revolute":
            continue
        found, expected = all_of(getattr(robot, method)(*given)), all_of(getattr(robot, method)(*near))
        if method == "integrate":
            expected[0][3, first + 1] = given[0][3, first + 1] + given[1][3, robot.nv - 4]
        if method == "normalise" and robot.joint_kinds[free + 1] == "revolute":
            expected[0][3, first + 1] = given[0][3, first + 1]
        for a, b in zip(found, expected, strict=True):
            assert np.abs(a - b).max() <= SHARE[dtype] * max(np.abs(b).max(), 1.0), size


@pytest.mark.parametrize("dtype", RANGE)
def test_within_the_range_no_bit_changes(dtype):
    robot = tree()
    q, v, a, _ = (x.astype(dtype) for x in states(robot, 9))
    q[4, 2] = RANGE[dtype]
    before = q.copy()
    assert robot.rnea(q, v, a)[4].tobytes() == robot.rnea(q[4], v[4], a[4]).tobytes()
    beyond = q.copy()
    beyond[5, 1] = 1e6
    assert np.delete(robot.rnea(beyond, v, a), 5, 0).tobytes() == np.delete(robot.rnea(q, v, a), 5, 0).tobytes()
    assert q.tobytes() == before.tobytes() and beyond[5, 1] == dtype(1e6)


@pytest.mark.parametrize("dtype", RANGE)
def test_whole_turns_that_matter_are_an_error(dtype):
    robot = tree()
    q, v, a, tau = (x.astype(dtype) for x in states(robot, 6))
    n, limit = robot.nv, RANGE[dtype]
    scenes = {
        "Spring": rd.Spring([0.0, 2.0] + [0.0] * (n - 2), [0.0] * n),
        "EndStops": rd.EndStops([-1.0] * n, [1.0] * n, 10.0, 1.0, 0.01),
        "Cogging": rd.Cogging([0.0, 1.0] + [0.0] * (n - 2), [[0.1]] * n, [[0.2]] * n),
    }
    q[4, 1] = 2 * limit
    for effect, scene in scenes.items():
        scene = rd.RIGID_BODY + scene
        for method, given in (("rnea", (q, v, a)), ("aba", (q, v, tau)), ("forward_dynamics", (q, v, tau))):
            with pytest.raises(rd.AngleError, match=f"`{robot.joints[1]}`.*{effect}") as error:
                getattr(robot, method)(*given, scene)
            assert (error.value.joint, error.value.coordinate, error.value.state) == (robot.joints[1], 1, 4)
    # The angle of a cog is n q.
    q[4, 1] = 50.0
    fine = rd.Cogging([0.0, limit / 40] + [0.0] * (n - 2), [[0.1]] * n, [[0.2]] * n)
    with pytest.raises(rd.AngleError, match="Cogging"):
        robot.rnea(q, v, a, rd.RIGID_BODY + fine)
    q[4, 1] = 39.0
    assert np.isfinite(robot.rnea(q, v, a, rd.RIGID_BODY + fine)).all()


@pytest.mark.parametrize("dtype", RANGE)
def test_planar_joints_and_steps(dtype):
    text = (
        '<robot name="r"><link name="a"/><link name="b"><inertial><mass value="1"/><origin xyz="0.1 0 0"/>'
        '<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>'
        '<joint name="floor" type="planar"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint></robot>'
    )
    robot, size = rd.Robot.from_text(text), RANGE[dtype] * 1e3
    q, to, step = np.zeros((3, 3), dtype), np.ones((3, 3), dtype), np.ones((3, 3), dtype)
    near = q.copy()
    q[1, 0], near[1, 0] = size, turned(size, dtype)
    far = np.abs(robot.difference(q, to) - robot.difference(near, to)).max()
    assert far <= SHARE[dtype] * 10
    assert robot.normalise(q)[1, 0] == q[1, 0]
    step[2, 0] = size
    for given in ((q, np.ones_like(q)), (near, step)):
        with pytest.raises(rd.AngleError, match="floor") as error:
            robot.integrate(*given)
        assert error.value.joint == "floor"
    free = tree(True)
    place, v, *_ = (x.astype(dtype) for x in states(free, 2))
    v[1, 2] = size
    with pytest.raises(rd.AngleError) as error:
        free.integrate(place, v)
    assert (error.value.joint, error.value.coordinate, error.value.state) == (free.joints[0], 2, 1)


@pytest.mark.parametrize("dtype", RANGE)
def test_machines_with_loops(dtype):
    size, limit = 3.0 * RANGE[dtype], RANGE[dtype]
    robot = machines.bars()
    loops = rd.Loops(robot, [machines.pin()], [0])
    q = loops.assemble(np.array([0.4, 0.3, 0.9]).astype(dtype))
    turns = round(size / math.tau)
    far = np.array([q[0], q[1], float(q[2]) + turns * math.tau], dtype)
    rates = np.ones(1, dtype)
    with pytest.raises(rd.AngleError, match="rocker_joint"):
        loops.assemble(far)
    near = np.array([q[0], q[1], turned(far[2], dtype)], dtype)
    if dtype == np.float64:
        for a, b in zip(loops.inverse_dynamics(far, rates, rates), loops.inverse_dynamics(near, rates, rates)):
            assert np.abs(a - b).max() < 1e-9
    linkages = rd.Linkages(robot, [("bar", machines.four_bar(), [0, 1, 2])])
    for call in (linkages.motion, linkages.rnea, linkages.forward_dynamics):
        with pytest.raises(rd.AngleError, match="`bar`.*state 1") as error:
            call(np.array([[0.3], [size]], dtype), np.ones((2, 1), dtype), np.ones((2, 1), dtype))
        assert (error.value.joint, error.value.state, error.value.limit) == ("bar", 1, limit)
    # A ratio makes an angle too large that is not so at the motor.
    arm = rd.Robot("ur5e")
    belted = rd.Linkages(arm, [("belt", rd.Belt([0.0, 50.0]), [4, 5])])
    y = np.array([0.0, 0.0, 0.0, 0.0, limit / 20], dtype)
    with pytest.raises(rd.AngleError, match="belt"):
        belted.rnea(y, 0 * y, 0 * y)
    # Joints in no linkage are those of a tree.
    y = np.array([0.1, size, 0.3, 0.2, 0.1], dtype)
    close = np.array([0.1, turned(size, dtype), 0.3, 0.2, 0.1], dtype)
    a, b = belted.rnea(y, 0 * y, 0 * y), belted.rnea(close, 0 * y, 0 * y)
    assert np.abs(a - b).max() <= SHARE[dtype] * np.abs(b).max()
    assert belted.motion(y, 0 * y, 0 * y)[0][1] == y[1]


@pytest.mark.parametrize("dtype", RANGE)
def test_links_that_bend(dtype):
    boom, size = machines.boom(), {np.float32: 1e6, np.float64: 1e15}[dtype]
    q, close, eta = (np.array(x, dtype) for x in ([size, 0.2], [turned(size, dtype), 0.2], [1e-3, -1e-3, 2e-3]))
    z = 0 * eta
    for a, b in zip(boom.rnea(q, 0 * q, 0 * q, eta, z, z), boom.rnea(close, 0 * q, 0 * q, eta, z, z)):
        assert np.abs(a - b).max() <= SHARE[dtype] * max(np.abs(b).max(), 1.0)
