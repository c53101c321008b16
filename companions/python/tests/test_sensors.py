"""A force sensor's load against numpy's least squares, and motors against a model that numpy
solves."""

import numpy as np
import pytest

import robot_dynamics as rd


def test_a_load_is_that_of_numpys_least_squares():
    random = np.random.default_rng(1)
    gravity = random.normal(scale=6.0, size=(12, 3))
    wrench = random.normal(scale=0.1, size=(12, 6)) + [0.2, -0.1, 0.05, 3.0, -2.0, 5.0]
    wrench += np.hstack([-np.cross([0.012, -0.006, 0.096], gravity), -1.2 * gravity])
    load = rd.SensorLoad.fit(gravity, wrench)
    # Columns of m, h and the offset: couples g × h + n₀, forces −m g + f₀.
    blocks = [np.block([[np.zeros((3, 1)), np.cross(g, np.eye(3)).T], [-g[:, None], np.zeros((3, 3))]]) for g in gravity]
    rows = np.vstack([np.hstack([block, np.eye(6)]) for block in blocks])
    expected = np.linalg.lstsq(rows, wrench.ravel(), rcond=None)[0]
    assert np.allclose([load.mass, *load.first_moment, *load.offset], expected, rtol=0, atol=1e-12)
    shown = rd.SensorLoad(load.mass, load.first_moment, load.offset).at_rest(gravity.reshape(3, 4, 3))
    assert shown.shape == (3, 4, 6) and np.allclose(shown.ravel(), rows @ expected, rtol=0, atol=1e-12)


def test_a_residual_is_that_of_the_poses_and_a_sensor_of_another_sign_or_axes_is_refused():
    random = np.random.default_rng(2)
    gravity = random.normal(scale=6.0, size=(12, 3))
    wrench = random.normal(scale=0.1, size=(12, 6)) + np.hstack([np.zeros((12, 3)), -1.2 * gravity])
    load = rd.SensorLoad.fit(gravity, wrench)
    left = (wrench - load.at_rest(gravity)).reshape(12, 2, 3)
    assert np.allclose(load.residual, np.sqrt(np.square(left).sum(2).mean(0)), rtol=1e-9)
    assert rd.SensorLoad(1.2, [0, 0, 0], [0] * 6).residual is None
    for wrong, words in ((-wrench, "negative"), (np.roll(wrench, 1, 1), "axes of the sensor")):
        with pytest.raises(rd.SensorLoadError, match=words):
            rd.SensorLoad.fit(gravity, wrong)


def test_poses_without_a_load_are_refused():
    line = np.array([[0.0, 0.0, 9.81], [0.0, 0.0, -9.81]] * 3)
    for gravity in (line, line[:2], np.full((6, 3), np.nan)):
        with pytest.raises(rd.SensorLoadError) as error:
            rd.SensorLoad.fit(gravity, np.zeros((len(gravity), 6)))
        assert error.value.poses == len(gravity)
    with pytest.raises(rd.ShapeError):
        rd.SensorLoad.fit(line, np.zeros((5, 6)))


SHEET = dict(continuous=[2.0, 3.0], peak=[6.0, 9.0], winding_time=[10.0, 12.0], housing_time=[300.0, 600.0])
SHEET |= dict(share=[0.4, 0.3], hottest=[125.0, 100.0], ambient=25.0, tick=1e-3)


def warm(joint, torque, seconds):
    """w and c of a cold motor after a torque: x' = A x + b by the eigenvectors of A."""
    share, winding, housing = (SHEET[name][joint] for name in ("share", "winding_time", "housing_time"))
    flow = (1.0 - share) / share / housing
    a = np.array([[-1.0 / winding, 1.0 / winding], [flow, -flow - 1.0 / housing]])
    steady = np.linalg.solve(-a, [share / winding * (torque / SHEET["continuous"][joint]) ** 2, 0.0])
    rates, vectors = np.linalg.eig(a)
    return steady - vectors @ (np.exp(rates * seconds) * np.linalg.solve(vectors, steady))


def test_temperatures_are_those_of_the_equations():
    motors = rd.ThermalLimit(**SHEET, saved=([0.0] * 2, [0.0] * 2))
    assert motors.torque == SHEET["peak"] and motors.status == ("cool", None)
    # The limit falls from the peak at w = 3/4 to the continuous torque at 1.
    w, bound = warm(1, 7.0, motors.holds_for(1, 7.0))[0], 1.0 - (7.0 - 3.0) / (4.0 * 9.0)
    assert w < bound < 1.01 * w and motors.holds_for(1, 2.9) == np.inf
    limits = motors.update(np.tile([4.0, -7.0], (5000, 1)))
    expected = np.transpose([warm(0, 4.0, 5.0), warm(1, 7.0, 5.0)])
    # Never below, and a block of ticks above.
    assert (motors.saved >= expected).all() and np.allclose(motors.saved, expected, rtol=0.02, atol=0.001)
    assert np.allclose(motors.celsius, 25.0 + expected[0] * [100.0, 75.0], rtol=0.02)
    assert limits.shape == (5000, 2) and (np.diff(limits, axis=0) <= 0.0).all()
    later = rd.ThermalLimit(**SHEET, saved=motors.saved, off=60.0)
    assert (np.array(later.saved[0]) < motors.saved[0]).all()


def test_without_knowledge_motors_are_hot_and_numbers_are_checked():
    motors = rd.ThermalLimit(**SHEET)
    assert motors.celsius == SHEET["hottest"] and np.allclose(motors.torque, SHEET["continuous"], rtol=0.01)
    motors.measured(1, 110.0)
    assert motors.status == ("hot", 1)
    motors.update(np.zeros((400_000, 2)))
    assert motors.torque == SHEET["peak"] and motors.status == ("cool", None)
    for name, wrong, joint in (("peak", [6.0, 1.0], 1), ("share", [np.nan, 0.3], 0), ("tick", 0.0, None), ("hottest", [1.0], None)):
        with pytest.raises(rd.MotorError) as error:
            rd.ThermalLimit(**SHEET | {name: wrong})
        assert error.value.joint == joint
    with pytest.raises(rd.UnknownCoordinate):
        motors.holds_for(2, 1.0)
