"""Scenes are composed as in the library, and refused as its compiler would."""

import numpy as np
import pytest

import robot_dynamics as rd
from trees import states

ONES = [1.0] * 6


def arm():
    robot = rd.Robot("ur5e")
    return robot, *states(robot, 1)


def test_scenes_are_sums_or_tuples():
    robot, q, v, a, _ = arm()
    parts = [rd.Gravity(), rd.Inertia(), rd.Coriolis(), rd.Viscous([0.5] * 6)]
    assert np.array_equal(robot.rnea(q, v, a, rd.Scene(*parts)), robot.rnea(q, v, a, tuple(parts)))
    assert np.array_equal(robot.rnea(q, v, a), robot.rnea(q, v, a, rd.RIGID_BODY))
    assert np.allclose(robot.rnea(q, v, a, rd.Inertia())[0], robot.crba(q)[0] @ a[0], rtol=0, atol=1e-12)


def test_friction_and_springs_have_their_closed_forms():
    robot, q, v, a, _ = arm()
    alone = lambda effect: robot.rnea(q, v, a, effect)[0]  # noqa: E731
    k = np.arange(1.0, 7.0)
    assert np.allclose(alone(rd.Viscous(k)), k * v[0])
    assert np.allclose(alone(rd.Coulomb(k, 1e-3)), k * np.sign(v[0]))
    expected = np.where(v[0] > 0, 2 * k, -k)
    assert np.allclose(alone(rd.AsymmetricCoulomb(2 * k, k, 1e-3)), expected)
    assert np.allclose(alone(rd.Stribeck(k, 0.5, 1e-3)), k * np.exp(-((v[0] / 0.5) ** 2)) * np.sign(v[0]))
    assert np.allclose(alone(rd.Spring(k, [0.1] * 6)), k * (q[0] - 0.1))
    assert np.allclose(alone(rd.Cogging([3.0] * 6, [[1.0]] * 6, [[2.0]] * 6)), np.cos(3 * q[0]) + 2 * np.sin(3 * q[0]))
    assert np.array_equal(alone(rd.ConstantTorque(k)), k)
    twice = rd.RIGID_BODY + rd.ConstantTorque(k) + rd.ConstantTorque(-3.0 * k)
    assert np.allclose(robot.rnea(q, v, a, twice), robot.rnea(q, v, a) - 2.0 * k)
    assert np.allclose(robot.aba(q, v, robot.rnea(q, v, a, twice), twice), a, atol=1e-9)
    bristles = rd.Lugre(100 * k, k, k, 2 * k, k, 0.1, [0.001] * 6)
    g = (2 * k + k * np.exp(-((v[0] / 0.1) ** 2))) / (100 * k)
    rate = v[0] - np.abs(v[0]) / g * 0.001
    assert np.allclose(alone(bristles), 100 * k * 0.001 + k * rate + k * v[0])
    stops = rd.EndStops([-1.0] * 6, ONES, 1000.0, 0.0, 0.01)
    assert np.allclose(alone(stops), 1000 * (np.maximum(q[0] - 1, 0) - np.maximum(-1 - q[0], 0)))
    assert np.allclose(robot.crba(q, rd.Inertia() + rd.Armature(k)) - robot.crba(q), np.diag(k))


def test_loads_wrenches_and_bases_act():
    robot, q, v, a, tau = arm()
    wrench = np.array([1.0, 2.0, 3.0, 4.0, 5.0, 6.0])
    body = robot.bodies[-1]
    local = robot.rnea(q, v, a, rd.RIGID_BODY + rd.BodyWrench(body, wrench)) - robot.rnea(q, v, a)
    assert np.allclose(local[0], -robot.jacobian(q, body)[0].T @ wrench)
    world = robot.rnea(q, v, a, rd.RIGID_BODY + rd.WorldWrench(5, wrench)) - robot.rnea(q, v, a)
    assert np.allclose(world[0], -robot.jacobian(q, body, "local_world_aligned")[0].T @ wrench)
    load = rd.RIGID_BODY + rd.Payload(body, 2.0, [0.0, 0.0, 0.1], [0.01, 0.0, 0.0, 0.01, 0.0, 0.01])
    assert robot.crba(q, load)[0, 0, 0] > robot.crba(q)[0, 0, 0]
    assert np.allclose(robot.aba(q, v, robot.rnea(q, v, a, load), load), a, atol=1e-9)
    assert np.allclose(robot.forward_dynamics(q, v, robot.rnea(q, v, a, load), load), a, atol=1e-9)
    lift = rd.Inertia() + rd.Coriolis() + rd.MovingBase([0.0] * 6, [0.0, 0.0, 0.0, 0.0, 0.0, 9.81])
    assert np.allclose(robot.rnea(q, v, a, lift), robot.rnea(q, v, a))
    gears = rd.RIGID_BODY + rd.LoadFriction([0.2] * 6, [0.1] * 6, 0.01)
    motor = robot.rnea(q, v, a, gears)
    assert np.allclose(robot.transmitted_torque(q, v, motor, gears), robot.rnea(q, v, a), atol=1e-9)
    for forward in (robot.aba, robot.forward_dynamics):
        assert np.allclose(forward(q, v, motor, gears), a, atol=1e-8), forward
    ground = rd.Contact([(body, [0.0, 0.0, 0.0])], [0.0, 0.0, 1.0], 10.0, 100.0, 1.0, 0.01, 0.5, 0.01)
    assert not np.allclose(robot.rnea(q, v, a, rd.RIGID_BODY + ground), robot.rnea(q, v, a))


def test_rotors_that_spin_have_no_place_where_the_core_has_none():
    robot, q, v, a, tau = arm()
    scene = rd.RIGID_BODY + rd.GyroscopicRotors([1e-4] * 6, [5.0] * 6)
    for call in (lambda: robot.centroidal_matrix(q, scene), lambda: robot.osim_inverse(q, 0, "local", scene)):
        with pytest.raises(rd.EffectError, match="Armature") as error:
            call()
        assert error.value.effect == "GyroscopicRotors"
    free = rd.Robot("a1_free")
    with pytest.raises(rd.EffectError, match="coordinate 2 has several"):
        free.crba(free.neutral(), rd.GyroscopicRotors([0.0, 0.0, 1e-4] + [0.0] * 15, [5.0] * 18))
    with pytest.raises(rd.EffectError, match="5 numbers for 6"):
        robot.crba(q, rd.GyroscopicRotors([1e-4] * 6, [5.0] * 5))


def test_two_of_a_kind_are_refused():
    for effect in (rd.Gravity(), rd.Inertia(), rd.Coriolis(), rd.Viscous(ONES), rd.Coulomb(ONES, 0.1)):
        with pytest.raises(rd.EffectError) as error:
            effect + effect
        assert error.value.effect == effect.names[0]
        with pytest.raises(rd.EffectError):
            rd.Robot("ur5e").gravity(np.zeros(6), (effect, effect))
    springs = rd.Spring(ONES, ONES) + rd.Spring(ONES, ONES)
    assert springs.names == ["Spring", "Spring"] and len(springs) == 2 and "Spring" in springs


def test_impossible_effects_are_refused():
    robot, q, v, a, tau = arm()
    with pytest.raises(rd.EffectError, match="5 numbers for 6") as error:
        robot.rnea(q, v, a, rd.RIGID_BODY + rd.Viscous([1.0] * 5))
    assert error.value.effect == "Viscous"
    with pytest.raises(rd.EffectError, match="no body"):
        robot.rnea(q, v, a, rd.RIGID_BODY + rd.BodyWrench("hand", ONES))
    with pytest.raises(rd.EffectError, match="no body of the number 9"):
        robot.rnea(q, v, a, rd.RIGID_BODY + rd.BodyWrench(9, ONES))
    with pytest.raises(rd.EffectError, match="mass"):
        robot.rnea(q, v, a, rd.RIGID_BODY + rd.Payload(0, -1.0))
    with pytest.raises(rd.EffectError, match="below zero"):
        rd.Viscous([-1.0] * robot.nv)
    for effect in (rd.Gravity() + rd.Coriolis(), ()):
        with pytest.raises(rd.EffectError, match="needs Inertia"):
            robot.aba(q, v, tau, effect)
    for wrong in (1.0, "Gravity", [1.0]):
        with pytest.raises(rd.EffectError):
            robot.rnea(q, v, a, wrong)
    for wrong in (rd.RIGID_BODY + rd.BodyWrench(0, ONES), rd.RIGID_BODY + rd.LoadFriction(ONES, ONES, 0.1), rd.Inertia()):
        with pytest.raises(rd.EffectError):
            robot.elastic_inverse_dynamics(q, v, a, a, a, ONES, ONES, ONES, wrong)
    for wrong in ([0.0] * 6, [1.0] * 5, [float("inf")] * 6):
        with pytest.raises(rd.EffectError, match="stiffness needs 6"):
            robot.elastic_inverse_dynamics(q, v, a, a, a, wrong, ONES, ONES)
    with pytest.raises(rd.EffectError, match="width"):
        robot.friction_regressor(v, 0.0)
    with pytest.raises(rd.EffectError, match="length 1"):
        rd.Gravity(direction=[0.0, 0.0, -2.0])
    for normal in ([0.0, 0.0, 2.0], [0.0, 0.0, 0.0], [0.0, 0.0, 1.0 + 1e-6], [float("nan"), 0.0, 1.0]):
        with pytest.raises(rd.EffectError, match="normal.*length 1") as error:
            rd.Contact([("wrist_3", [0.0] * 3)], normal, 0.0, 100.0, 1.0, 0.01, 0.5, 0.01)
        assert error.value.effect == "Contact"
    rd.Contact([("wrist_3", [0.0] * 3)], [0.6, 0.0, 0.8], 0.0, 100.0, 1.0, 0.01, 0.5, 0.01)
    with pytest.raises(rd.EffectError, match="not finite"):
        rd.Viscous([float("nan")])
    with pytest.raises(rd.EffectError, match="ConstantTorque: a number is not finite"):
        rd.ConstantTorque([float("inf")])
    with pytest.raises(rd.EffectError, match="5 numbers for 6"):
        robot.rnea(q, v, a, rd.ConstantTorque([1.0] * 5))
    with pytest.raises(rd.EffectError, match="width"):
        rd.Coulomb([1.0], 0.0)
    with pytest.raises(rd.UnknownBody):
        rd.Payload(None, 1.0)
    with pytest.raises(rd.EffectError, match="harmonics"):
        robot.rnea(q, v, a, rd.Cogging(ONES, [[1.0] * 9] * 6, [[]] * 6))


TERMS = [rd.Gravity(), rd.Inertia(), rd.Coriolis()]


@pytest.mark.parametrize("terms", [[TERMS[i] for i in range(3) if bits >> i & 1] for bits in range(8)], ids=str)
@pytest.mark.parametrize("more", ["none", "friction", "armature", "load and base"])
@pytest.mark.parametrize("name", ["ur5e", "a1_free", "g1"])
def test_every_set_of_terms_is_computed_alike(name, more, terms):
    """All algorithms see the same terms, however few scenes the machine code has for each."""
    robot = rd.Robot(name)
    q, v, a, _ = states(robot, 2)
    base = rd.MovingBase([0.3, -0.2, 0.1, 0.5, 0.4, -0.6], [0.2] * 6)
    extra = {"none": rd.Scene(), "friction": rd.Viscous([0.5] * robot.nv) + rd.Coulomb([0.3] * robot.nv, 0.1), "armature": rd.Armature([0.5] * robot.nv), "load and base": rd.Payload(robot.bodies[-1], 0.4) + base}
    scene = rd.Scene(*terms) + extra[more]
    tau = robot.rnea(q, v, a, scene)
    parts = [robot.rnea(q, v, a, (term, extra[more])) - robot.rnea(q, v, a, extra[more]) for term in terms]
    near = dict(rtol=0, atol=1e-10 * max(np.abs(robot.rnea(q, v, a, (rd.RIGID_BODY, extra[more]))).max(), 1.0))
    if more != "load and base":
        assert np.allclose(tau, sum(parts) + robot.rnea(q, v, a, extra[more]), **near)
        y = robot.regressor(q, v, a, scene).reshape(2, robot.nv, -1)
        own = robot.rnea(q, v, a, extra[more])
        assert np.allclose(y @ robot.inertial_parameters(scene).ravel() + own, tau, **near)
        assert np.allclose(robot.bias(q, v, scene), robot.rnea(q, v, 0 * a, scene), **near)
    if {rd.Inertia(), rd.Coriolis()} <= set(terms):
        mask = np.broadcast_to(np.arange(robot.nv) % 2.0, v.shape)
        assert np.allclose(robot.hybrid_dynamics(q, v, np.where(mask, a, tau), mask, scene)[0], tau, rtol=0, atol=1e-6)
        assert np.allclose(robot.rnea_and_wrenches(q, v, a, scene)[0], tau, **near)
    else:
        for refused in (lambda: robot.rnea_and_wrenches(q, v, a, scene), lambda: robot.hybrid_dynamics(q, v, tau, 0 * v, scene)):
            with pytest.raises(rd.EffectError, match="it needs"):
                refused()
    if rd.Inertia() in terms:
        for found in (robot.aba, robot.forward_dynamics, lambda *x: robot.forward_dynamics_with_error(*x)[0]):
            assert np.allclose(found(q, v, tau, scene), a, rtol=0, atol=1e-6)


def test_effects_of_ones_own_are_called_once():
    robot, calls = rd.Robot("ur5e"), []
    q, v, a, tau = states(robot, 6)

    def friction(q, qd):
        calls.append((q.shape, qd.shape))
        return 3.0 * qd + 0.1 * np.sin(q)

    own, inner = rd.RIGID_BODY + rd.OwnEffect(friction), rd.RIGID_BODY + rd.Viscous([3.0] * 6)
    assert np.allclose(robot.rnea(q, v, a, own), robot.rnea(q, v, a, inner) + 0.1 * np.sin(q))
    assert np.allclose(robot.rnea(q.reshape(2, 3, 6), v[0], a[0], own)[1, 2], robot.rnea(q[5], v[0], a[0], own))
    assert calls[:2] == [((6, 6), (6, 6)), ((2, 3, 6), (2, 3, 6))] and len(calls) == 3
    assert np.allclose(robot.bias(q, v, own), robot.rnea(q, v, 0 * a, own))
    assert np.array_equal(robot.gravity(q, own), robot.gravity(q))
    for method in (robot.aba, robot.forward_dynamics):
        assert np.allclose(method(q, v, robot.rnea(q, v, a, own), own), a, rtol=0, atol=1e-9)
        assert np.array_equal(method(q, v, tau, own), method(q, v, tau - friction(q, v)))
    assert own.names[-1] == "OwnEffect" and "OwnEffect" in own and len(own) == 4 and "friction" in repr(own)
    assert own == rd.RIGID_BODY + rd.OwnEffect(friction) != rd.RIGID_BODY + rd.OwnEffect(len)
    single = [x.astype(np.float32) for x in (q, v, a)]
    for refused in (
        lambda: robot.rnea(*single, own), lambda: robot.crba(q, own),
        lambda: rd.OwnEffect(3), lambda: robot.rnea(q, v, a, rd.OwnEffect(lambda q, qd: qd[:2])),
    ):  # fmt: skip
        with pytest.raises(rd.EffectError) as error:
            refused()
        assert error.value.effect == "OwnEffect"
    with pytest.raises(rd.ShapeError, match="OwnEffect"):
        robot.rnea(q, v, a, rd.OwnEffect(lambda q, qd: qd[:, :3]))
    with pytest.raises(ZeroDivisionError):
        robot.rnea(q, v, a, rd.OwnEffect(lambda q, qd: 1 / 0))


def test_derivatives_have_those_of_effects():
    """Against differences, with what the library knows derivatives of; the rest is refused."""
    robot = rd.Robot("ur5e")
    q, v, a, tau = (x[0] for x in states(robot, 1))
    scene = rd.RIGID_BODY + rd.Viscous([0.4] * 6) + rd.Spring([30.0] * 6, [0.1] * 6) + rd.Armature([0.2] * 6)
    scene += rd.Payload(robot.bodies[-1], 0.7) + rd.MovingBase([0.1, -0.2, 0.3, 0.4, 0.5, -0.6], [1.0, 2.0, -1.0, 0.5, 0.3, 0.2])
    # What an implicit step leaves out of their derivatives is here.
    scene += rd.Coulomb([2.0] * 6, 0.9) + rd.AsymmetricCoulomb([3.0] * 6, [1.0] * 6, 0.8) + rd.Stribeck([4.0] * 6, 0.7, 0.3)
    scene += rd.Cogging([5.0] * 6, [[0.7, 0.2]] * 6, [[-0.6, 0.3]] * 6) + rd.EndStops([-0.1] * 6, [0.1] * 6, 90.0, 20.0, 0.5)
    inverse, forward = robot.rnea_derivatives(q, v, a, scene), robot.forward_dynamics_derivatives(q, v, tau, scene)
    steps = 1e-6 * np.eye(6)
    for k in range(6):
        by = [[steps[k] if i == k_of else 0.0 for i in range(3)] for k_of in range(3)]
        for found, function, given in ((inverse, robot.rnea, (q, v, a)), (forward, robot.forward_dynamics, (q, v, tau))):
            for derivative, step in zip(found, by):
                after, before = (function(*(x + s * d for x, d in zip(given, step)), scene) for s in (1, -1))
                assert np.abs((after - before) / 2e-6 - derivative[:, k]).max() < 1e-6 * np.abs(derivative).max()
    wrench, bristles = rd.BodyWrench(robot.bodies[-1], [1.0] * 6), rd.Lugre(*[[1.0] * 6] * 5, 0.1, [0.0] * 6)
    for effect, refused in (
        ("Coriolis", rd.Gravity() + rd.Inertia()), ("Inertia", rd.Gravity()), ("BodyWrench", scene + wrench), ("Lugre", scene + bristles),
    ):  # fmt: skip
        with pytest.raises(rd.EffectError) as error:
            robot.rnea_derivatives(q, v, a, refused)
        assert error.value.effect == effect
