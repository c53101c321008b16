"""Arrays of one state and of many, their types, and what is refused."""

import pickle
import threading
import time

import numpy as np
import pytest

import robot_dynamics as rd
from trees import states

METHODS = [
    ("rnea", "q v a"), ("bias", "q v"), ("gravity", "q"), ("rnea_two_velocities", "q v a v"), ("crba", "q"),
    ("inverse_mass", "q"), ("rnea_derivatives", "q v a"), ("forward_dynamics_derivatives", "q v t"), ("aba", "q v t"), ("forward_dynamics", "q v t"), ("hybrid_dynamics", "q v t m"),
    ("transmitted_torque", "q v t"), ("jacobian", "q b"), ("bias_acceleration", "q v b"), ("poses", "q"),
    ("kinematics", "q v a"), ("kinetic_energy", "q v"), ("potential_energy", "q"), ("momentum", "q v"),
    ("centroidal_momentum", "q v"), ("centroidal_matrix", "q"), ("center_of_mass", "q v"),
    ("momentum_and_coriolis", "q v"), ("momentum_and_drift", "q v"), ("coriolis_matrix", "q v"),
    ("base_velocity_from_momentum", "q v h"), ("osim_inverse", "q b"), ("operational_space", "q b"),
    ("regressor", "q v a"), ("integrate", "q v"), ("difference", "q q"), ("normalise", "q"),
    ("crba_jacobian", "q b"), ("ltdl", "M"), ("solve", "L D t"), ("inverse", "L D"), ("cholesky", "M"),
    ("cholesky_solve", "L D t"), ("spatial_operator_ltdl", "q"), ("spatial_operator_inverse", "q"),
    ("acceleration_error", "M L D a t"), ("forward_dynamics_with_error", "q v t"), ("regressor_columns", "q v a b"),
    ("regressor_row", "q v a c"), ("friction_regressor", "v w"), ("elastic_inverse_dynamics", "q v a t t s s s"),
]  # fmt: skip


def arguments(robot, names, count, dtype):
    q, v, a, t = (x.astype(dtype) for x in states(robot, count))
    mask = np.broadcast_to(np.arange(robot.nv) % 2, v.shape).astype(dtype)
    momentum = np.ones((count, 6), dtype)
    table = {"q": q, "v": v, "a": a, "t": t, "m": mask, "h": momentum, "b": robot.bodies[-1], "c": 1, "w": 0.3}
    table["M"] = robot.crba(q)
    table["L"], table["D"] = robot.ltdl(table["M"])
    table["s"] = [7.0] * robot.nv
    return [table[name] for name in names.split()]


def cases(*robots):
    """Methods with the robots that have them: some are of a free base or of joints of one coordinate."""
    free = {"base_velocity_from_momentum": True, "elastic_inverse_dynamics": False}
    return [(*row, name) for row in METHODS for name in robots if free.get(row[0], name.endswith("free")) == name.endswith("free")]


def row(argument, i):
    return argument[i] if isinstance(argument, np.ndarray) else argument


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize(("method", "names", "name"), cases("ur5e", "a1", "a1_free"))
def test_batches_are_their_states_to_the_bit(method, names, name, dtype):
    robot = rd.Robot(name)
    count = 37
    given = arguments(robot, names, count, dtype)
    call = getattr(robot, method)
    together = all_of(call(*given))
    for i in range(0, count, 5):
        alone = all_of(call(*[row(argument, i) for argument in given]))
        for batch, single in zip(together, alone, strict=True):
            assert batch.dtype == dtype and single.dtype == dtype
            assert batch[i].tobytes() == single.tobytes()


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_threads_compute_what_one_computes(dtype):
    robot = rd.Robot("ur5e")
    q, v, a, t = (x.astype(dtype) for x in states(robot, 5003))
    parts = np.array([robot.rnea(*rows) for rows in zip(q, v, a)])
    assert robot.rnea(q, v, a).tobytes() == parts.tobytes()
    parts = np.array([robot.aba(*rows) for rows in zip(q, v, t)])
    assert robot.aba(q, v, t).tobytes() == parts.tobytes()


def all_of(found):
    return found if isinstance(found, tuple) else (found,)


@pytest.mark.parametrize(("method", "names", "name"), cases("ur5e", "a1_free"))
def test_leading_axes_broadcast_as_numpys(method, names, name):
    """(2, 1), (3,), none and (1, 1) go together, to the bit of each state alone; so does nothing."""
    robot = rd.Robot(name)
    given, call = arguments(robot, names, 3, np.float64), getattr(robot, method)
    places = [i for i, argument in enumerate(given) if isinstance(argument, np.ndarray)]
    turn = [places.index(i) % 4 if i in places else 4 for i in range(len(given))]
    shapes = [(2, 1), (3,), (), (1, 1)]
    ways = [lambda x: x[:2, None], lambda x: x, lambda x: x[0], lambda x: x[:1, None], lambda x: x]
    together = all_of(call(*[ways[k](x) for k, x in zip(turn, given)]))
    leading = np.broadcast_shapes(*[shapes[k] for k in turn if k < 4])
    for i, j in np.ndindex(2, 3):
        index = (i, j)[-len(leading) :] if leading != (2, 1) else (i, 0)
        alone = all_of(call(*[[x[i], x[j], x[0], x[0], x][k] if k < 4 else x for k, x in zip(turn, given)]))
        for batch, single in zip(together, alone, strict=True):
            assert batch.shape[: len(leading)] == leading and batch[index].tobytes() == single.tobytes()
    empty = call(*[x[:0, None] if k == 0 else ways[k](x) for k, x in zip(turn, given)])
    for none, batch in zip(all_of(empty), together, strict=True):
        assert none.shape == (0, *batch.shape[1:]) and none.dtype == np.float64


@pytest.mark.parametrize(("method", "names", "name"), cases("ur5e", "a1_free"))
def test_integers_are_float64(method, names, name):
    robot = rd.Robot(name)
    given, call = arguments(robot, names, 3, np.float64), getattr(robot, method)
    arrays = [isinstance(x, np.ndarray) for x in given]
    # M, its factors and attitudes are whole as identities.
    for x, kind in zip(given, names.split()):
        if kind in "ML":
            x[:] = np.eye(robot.nv)
        if kind == "q" and name == "a1_free":
            x[:, :4] = [0, 0, 0, 1]
    for dtype in (np.int64, np.uint8):
        x = [np.ceil(np.abs(y)).astype(dtype) if array else y for y, array in zip(given, arrays)]
        exact = [y.astype(float) if array else y for y, array in zip(x, arrays)]
        for found, expected in zip(all_of(call(*x)), all_of(call(*exact)), strict=True):
            assert found.dtype == np.float64 and found.tobytes() == expected.tobytes()


def test_integers_have_the_type_of_arrays_beside_them():
    robot, ones = rd.Robot("ur5e"), np.ones(6, int)
    assert robot.bias(ones, np.ones(6, np.float32)).dtype == np.float32
    swapped = np.ones(6).astype(">f8")
    assert robot.gravity(swapped).tobytes() == robot.gravity(ones).tobytes()


def test_any_leading_axes_and_any_strides():
    robot = rd.Robot("panda")
    q, v, a, _ = states(robot, 24)
    flat = robot.rnea(q, v, a)
    shaped = robot.rnea(*(x.reshape(2, 3, 4, 7) for x in (q, v, a)))
    assert shaped.shape == (2, 3, 4, 7) and np.array_equal(shaped.reshape(24, 7), flat)
    assert np.array_equal(robot.rnea(np.asfortranarray(q), v, a), flat)
    assert np.array_equal(robot.rnea(q[::2], v[::2], a[::2]), flat[::2])
    assert robot.rnea(q[:0], v[:0], a[:0]).shape == (0, 7)
    assert np.array_equal(robot.rnea(list(q[0]), v[0], a[0]), flat[0])
    frozen = q.copy()
    frozen.flags.writeable = False
    assert np.array_equal(robot.rnea(frozen, v, a), flat)
    assert robot.rnea(q, q, q).shape == (24, 7)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_arrays_that_are_not_aligned(dtype):
    robot = rd.Robot("panda")
    q, v, a, _ = (x.astype(dtype) for x in states(robot, 5))

    def moved(x):
        raw = np.zeros(x.nbytes + 1, np.uint8)
        raw[1:] = np.frombuffer(x.tobytes(), np.uint8)
        return raw[1:].view(dtype).reshape(x.shape)

    given = [moved(x) for x in (q, v, a)]
    assert not given[0].flags.aligned and given[0].flags.c_contiguous
    assert robot.rnea(*given).tobytes() == robot.rnea(q, v, a).tobytes()


def test_batches_release_the_lock():
    robot = rd.Robot("g1_free")
    q, v, _, tau = states(robot, 4000)
    ticks, done = [], threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.0005)

    beside = threading.Thread(target=tick)
    beside.start()
    start = time.perf_counter()
    robot.aba(q, v, tau)
    end = time.perf_counter()
    done.set()
    beside.join()
    during = [t for t in ticks if start < t < end]
    # With the lock held none would fall between, whatever the machine's load.
    assert len(during) >= 3, (len(during), end - start)


def test_mixed_and_foreign_types_are_refused():
    robot = rd.Robot("ur5e")
    single, double = np.zeros(6, np.float32), np.zeros(6)
    with pytest.raises(rd.DtypeError, match="qd") as error:
        robot.rnea(single, double, single)
    assert error.value.argument == "qd"
    with pytest.raises(rd.DtypeError, match=r"q.astype\(np.float64\)"):
        robot.gravity(np.zeros(6, np.float16))
    for other in (np.zeros(6, bool), np.zeros(6, complex), np.zeros(6, np.float16), np.array(["a"] * 6), np.zeros(6, object)):
        with pytest.raises(rd.DtypeError) as error:
            robot.gravity(other)
        assert error.value.argument == "q"
    for other in (None, "text", object(), [[1.0], [1.0, 2.0]]):
        with pytest.raises(rd.DtypeError):
            robot.gravity(other)


def test_wrong_shapes_are_named():
    robot = rd.Robot("ur5e")
    with pytest.raises(rd.ShapeError, match="`qd` has the shape") as error:
        robot.rnea(np.zeros(6), np.zeros(5), np.zeros(6))
    assert error.value.argument == "qd" and error.value.shape == (5,) and "6" in error.value.expected
    with pytest.raises(rd.ShapeError, match="leading axes"):
        robot.rnea(np.zeros((3, 6)), np.zeros((4, 6)), np.zeros((3, 6)))
    with pytest.raises(rd.ShapeError, match=r"leading axes \[3, 2\] of `q`, `qd`") as error:
        robot.rnea(np.zeros((3, 1, 6)), np.zeros((2, 6)), np.zeros((4, 3, 6)))
    assert error.value.argument == "qdd"
    with pytest.raises(rd.ShapeError):
        robot.gravity(np.ones(()))
    for wrong in (np.eye(5), np.ones(36), np.ones((2, 6))):
        with pytest.raises(rd.ShapeError, match=r"\[6, 6\] as the last axes") as error:
            robot.ltdl(wrong)
        assert error.value.argument == "m" and error.value.shape == wrong.shape
    with pytest.raises(rd.ShapeError, match="leading axes"):
        robot.solve(np.ones((3, 6, 6)), np.ones((2, 6)), np.ones((3, 6)))


def test_unknown_names_are_named():
    with pytest.raises(rd.UnknownRobot, match="ur5e") as error:
        rd.Robot("ur6")
    assert error.value.name == "ur6" and isinstance(error.value, LookupError)
    robot = rd.Robot("ur5e")
    for body in ("hand", 6, -1, None, 1.5):
        with pytest.raises(rd.UnknownBody) as error:
            robot.jacobian(np.zeros(6), body)
        assert error.value.body == body
    with pytest.raises(rd.UnknownCoordinate, match="it has 6") as error:
        robot.regressor_row(*[np.zeros(6)] * 3, 6)
    assert error.value.coordinate == 6
    with pytest.raises(rd.UnknownFrame) as error:
        robot.jacobian(np.zeros(6), 0, "tool")
    assert error.value.frame == "tool"


def test_joints_that_have_no_transmission_or_attitude_are_named():
    robot = rd.Robot("a1_free")
    q, v, a, tau = states(robot, 3)
    with pytest.raises(rd.MultiDofJoint, match="several degrees of freedom") as error:
        robot.elastic_inverse_dynamics(q, v, a, tau, tau, *[[1.0] * 18] * 3)
    assert error.value.joint == robot.joints[0] and error.value.state == 0
    q[2, :4] = 0.0
    with pytest.raises(rd.NoAttitude) as error:
        robot.normalise(q)
    assert error.value.joint == robot.joints[0] and error.value.state == 2


def test_all_errors_have_one_base_and_their_text():
    for name in rd.errors.__all__:
        error = getattr(rd, name)
        assert issubclass(error, rd.RobotDynamicsError)
        assert str(error("why", joint="elbow")) == "why"
    assert pickle.loads(pickle.dumps(rd.ShapeError("why"))).args == ("why",)
    assert issubclass(rd.MissingFile, FileNotFoundError) and issubclass(rd.MissingFile, rd.UnreadableFile)


def test_arguments_of_other_types_have_the_base_too():
    robot, zeros = rd.Robot("ur5e"), np.zeros(6)
    for call in (
        lambda: rd.Gravity(direction=[0.0, -1.0]), lambda: rd.Gravity("9.81"), lambda: rd.Viscous(1.0), lambda: rd.Viscous("abc"),
        lambda: rd.Coulomb([1.0] * 6, None), lambda: rd.BodyWrench(0, [1.0] * 5), lambda: rd.Payload(0, "heavy"),
        lambda: rd.Contact([("wrist_3", [0.0])], [0.0, 0.0, 1.0], 0.0, 1.0, 1.0, 0.1, 0.5, 0.1), lambda: rd.FourBar(1, 2, 3, []),
        lambda: rd.Stewart([]), lambda: rd.Beam("long", 1.0), lambda: rd.LoopJoint("l", "fixed", [0]), lambda: rd.LoopJoint("l", 3, [0, 1]),
        lambda: rd.Loops(robot, [3]), lambda: rd.Linkages(robot, [("l", 3, [1])]), lambda: rd.Robot(5), lambda: rd.Robot.from_text(b"<a/>"),
        lambda: rd.Robot.from_file(5), lambda: rd.Robot.from_text("<a/>", joints=3), lambda: robot.friction_regressor(zeros, "w"),
        lambda: robot.operational_space(zeros, 0, damping="small"), lambda: robot.elastic_inverse_dynamics(*[zeros] * 5, "a", [1.0], [1.0]),
    ):  # fmt: skip
        with pytest.raises(rd.ArgumentError) as error:
            call()
        assert isinstance(error.value, TypeError) and hasattr(error.value, "given") and "cannot be" in str(error.value)


def test_the_acceleration_without_qdd_is_said_right():
    robot = rd.Robot("ur5e")
    q, v, _, _ = (x[0] for x in states(robot, 1))
    for frame in ("local", "world", "local_world_aligned"):
        bias = robot.bias_acceleration(q, v, 5, frame)
        velocity, acceleration = (x[5] for x in robot.kinematics(q, v, 0 * v, frame))
        more = np.cross(velocity[:3], velocity[3:]) if frame == "local_world_aligned" else np.zeros(3)
        assert np.allclose(bias[:3], acceleration[:3]) and np.allclose(bias[3:] - acceleration[3:], more)


def test_singular_inertia_names_joint_and_state():
    text = (
        '<robot name="r"><link name="a"/><link name="b"><inertial><mass value="1"/><origin xyz="0 0 -0.5"/>'
        '<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link><link name="c"/>'
        '<joint name="shoulder" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 1 0"/>'
        '<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>'
        '<joint name="elbow" type="revolute"><parent link="b"/><child link="c"/><axis xyz="0 1 0"/>'
        '<limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>'
    )
    robot = rd.Robot.from_text(text)
    for method in (robot.aba, robot.forward_dynamics):
        with pytest.raises(rd.NotPositiveDefinite, match="elbow") as error:
            method(np.zeros(2), np.zeros(2), np.zeros(2))
        assert (error.value.joint, error.value.coordinate, error.value.state) == ("elbow", 1, 0)
    m = np.array([[1.0, 0.0], [0.5, 0.0]])
    for method in (robot.ltdl, robot.cholesky):
        with pytest.raises(rd.NotPositiveDefinite, match="elbow"):
            method(m)
    good = rd.Robot("ur5e")
    q, v, _, tau = states(good, 3000)
    whole = good.aba(q, v, tau)
    q[2071, 3] = np.nan
    found = good.aba(q, v, tau)
    assert np.isnan(found[2071]).all() and np.delete(found, 2071, 0).tobytes() == np.delete(whole, 2071, 0).tobytes()


@pytest.mark.parametrize("lane", range(8))
def test_a_singular_state_among_eight_is_named(lane):
    """float32 computes eight states at once, and those of a block with a singular one again one by
    one."""
    robot, state, scene = rd.Robot("ur5e"), 16 + lane, rd.RIGID_BODY
    q, v, _, tau = (x.astype(np.float32) for x in states(robot, 40))
    # All but one stretch out, and have more inertia about the vertical axis than the upright one.
    q[:, 1:3] = 0.0
    q[state, 1] = -np.pi / 2
    inertia = 1.0 / robot.spatial_operator_ltdl(q)[1][:, 0]
    least = np.delete(inertia, state).min()
    assert inertia[state] < 0.5 * least
    scene += rd.Armature([-0.75 * float(least)] + [0.0] * 5)
    with pytest.raises(rd.NotPositiveDefinite) as alone:
        robot.aba(q[state], v[state], tau[state], scene)
    with pytest.raises(rd.NotPositiveDefinite) as among:
        robot.aba(q, v, tau, scene)
    assert among.value.state == state and among.value.coordinate == alone.value.coordinate
    q[state], v[state], tau[state] = q[0], v[0], tau[0]
    assert np.isfinite(robot.aba(q, v, tau, scene)).all()
