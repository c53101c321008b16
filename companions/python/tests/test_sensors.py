"""A force sensor's load against numpy's least squares, and motors against a model that numpy
solves."""

import numpy as np
import pytest

import robot_dynamics as rd
from trees import states


def cross(h):
    """The matrix of h ×."""
    return np.cross(h, np.eye(3)).T


def test_a_load_is_that_of_numpys_least_squares():
    random = np.random.default_rng(1)
    gravity = random.normal(size=(12, 3))
    gravity *= 9.81 / np.linalg.norm(gravity, axis=1, keepdims=True)
    wrench = random.normal(scale=0.1, size=(12, 6)) + [0.2, -0.1, 0.05, 3.0, -2.0, 5.0]
    wrench += np.hstack([-np.cross([0.012, -0.006, 0.096], gravity), -1.2 * gravity])
    load = rd.SensorLoad.fit(gravity, wrench)
    # Of m, h and the offset: couples g × h + n₀, forces −m g + f₀.
    rows = [np.block([[np.zeros((3, 1)), cross(g)], [-g[:, None], np.zeros((3, 3))]]) for g in gravity]
    rows = np.vstack([np.hstack([row, np.eye(6)]) for row in rows])
    expected = np.linalg.lstsq(rows, wrench.ravel(), rcond=None)[0]
    assert np.allclose([load.mass, *load.first_moment, *load.offset], expected, rtol=0, atol=1e-12)
    again = rd.SensorLoad(load.mass, load.first_moment, load.offset)
    shown = again.at_rest(gravity.reshape(3, 4, 3))
    assert np.allclose(shown.reshape(-1), rows @ expected, rtol=0, atol=1e-12) and shown.shape == (3, 4, 6)
    assert np.array_equal(shown[0, 1], load.at_rest(gravity[1]))
    # What it predicts in a pose is the wrench of a payload that hangs on a body at rest.
    robot = rd.Robot("ur5e")
    q, still = states(robot, 1)[0][0], np.zeros(6)
    payload = rd.RIGID_BODY + rd.Payload("wrist_3", load.mass, np.divide(load.first_moment, load.mass))
    with_load, without = (robot.rnea_and_wrenches(q, still, still, scene)[1][-1] for scene in (payload, None))
    here = robot.poses(q)[0][-1].T @ [0.0, 0.0, -9.81]
    assert np.allclose(with_load - without, load.at_rest(here) - load.offset, rtol=0, atol=1e-12)


def test_poses_without_a_load_are_refused():
    line = np.array([[0.0, 0.0, 9.81], [0.0, 0.0, -9.81]] * 3)
    for gravity in (line, line[:2], np.full((6, 3), np.nan), np.zeros((0, 3))):
        with pytest.raises(rd.SensorLoadError) as error:
            rd.SensorLoad.fit(gravity, np.zeros((len(gravity), 6)))
        assert error.value.poses == len(gravity)
    with pytest.raises(rd.ShapeError):
        rd.SensorLoad.fit(line, np.zeros((5, 6)))
    with pytest.raises(rd.ShapeError):
        rd.SensorLoad(1.0, [0.0] * 3, [0.0] * 6).at_rest([1.0, 2.0])
    with pytest.raises(rd.ArgumentError):
        rd.SensorLoad(1.0, [0.0] * 2, [0.0] * 6)


SHEET = dict(continuous=[2.0, 3.0], peak=[6.0, 9.0], winding_time=[10.0, 12.0], housing_time=[300.0, 600.0])
SHEET |= dict(share=[0.4, 0.3], hottest=[125.0, 100.0], ambient=25.0, tick=1e-3)
COLD = ([0.0, 0.0], [0.0, 0.0])


def warm(joint, torque, seconds):
    """w and c of a cold motor after a torque: x' = A x + b by the eigenvectors of A."""
    share, winding, housing = (SHEET[name][joint] for name in ("share", "winding_time", "housing_time"))
    flow = (1.0 - share) / share / housing
    a = np.array([[-1.0 / winding, 1.0 / winding], [flow, -flow - 1.0 / housing]])
    steady = np.linalg.solve(-a, [share / winding * (torque / SHEET["continuous"][joint]) ** 2, 0.0])
    rates, vectors = np.linalg.eig(a)
    return steady - vectors @ (np.exp(rates * seconds) * np.linalg.solve(vectors, steady))


def test_temperatures_are_those_of_the_equations():
    motors = rd.ThermalLimit(**SHEET, saved=COLD)
    assert motors.torque == SHEET["peak"] and motors.status == ("cool", None)
    said = [motors.holds_for(joint, torque) for joint, torque in enumerate((4.0, 7.0))]
    for joint, torque in enumerate((4.0, 7.0)):
        # The limit falls from the peak at w = 3/4 to the continuous torque at 1.
        peak, continuous = SHEET["peak"][joint], SHEET["continuous"][joint]
        bound = 1.0 - (torque - continuous) / (4.0 * peak)
        assert warm(joint, torque, said[joint])[0] < bound < 1.01 * warm(joint, torque, said[joint])[0]
    assert motors.holds_for(1, 2.9) == np.inf and motors.holds_for(1, 9.1) == 0.0
    limits = motors.update(np.tile([4.0, -7.0], (5000, 1)))
    expected = np.array([warm(joint, torque, 5.0) for joint, torque in enumerate((4.0, 7.0))]).T
    # Never below, and a block of ticks above.
    assert (motors.saved >= expected).all() and np.allclose(motors.saved, expected, rtol=0.02, atol=0.001)
    celsius = 25.0 + expected[0] * [100.0, 75.0]
    assert np.allclose(motors.celsius, celsius, rtol=0.02)
    assert limits.shape == (5000, 2) and (np.diff(limits, axis=0) <= 0.0).all()
    again = rd.ThermalLimit(**SHEET, saved=motors.saved)
    assert np.allclose(again.saved[0], motors.saved[0], rtol=0.02) and again.saved[1] == motors.saved[1]
    assert (np.array(rd.ThermalLimit(**SHEET, saved=motors.saved, off=60.0).saved[0]) < again.saved[0]).all()


def test_without_knowledge_motors_are_hot_and_numbers_are_checked():
    motors = rd.ThermalLimit(**SHEET)
    assert motors.celsius == SHEET["hottest"] and motors.status == ("limited", 0)
    assert np.allclose(motors.torque, SHEET["continuous"], rtol=0.01)
    motors.measured(1, 110.0)
    assert motors.status == ("hot", 1)
    motors.update(np.zeros((400_000, 2)))
    assert motors.torque == SHEET["peak"] and motors.status == ("cool", None)
    for name, wrong, joint in (("peak", [6.0, 1.0], 1), ("share", [np.nan, 0.3], 0), ("tick", 0.0, None), ("hottest", [1.0], None)):
        with pytest.raises(rd.MotorError) as error:
            rd.ThermalLimit(**SHEET | {name: wrong})
        assert error.value.joint == joint
    for call in (lambda: motors.holds_for(2, 1.0), lambda: motors.measured(2, 1.0)):
        with pytest.raises(rd.UnknownCoordinate):
            call()
    with pytest.raises(rd.ShapeError):
        motors.update([1.0, 2.0, 3.0])
