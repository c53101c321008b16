"""Goals that move against closed forms, poses against the robot's own kinematics, and a tip within its limits."""

import numpy as np
import pytest

import robot_dynamics as rd

Q = np.array([0.4, -1.0, 1.2, 0.2, 0.8, 0.5])


def test_a_goal_is_reached_in_the_time_of_the_closed_form():
    goal = rd.MovingGoal([0.0, 0.0], 1e-3, [2.0, 1.0], [10.0, 5.0], [100.0, 50.0])
    assert goal.set(0, np.array([1.5, 0.1])) == goal.ticks == 1051
    # At the greatest speed d/v + v/a + a/j; limits are kept with a share of 2⁻¹⁶.
    assert 1.5 / 2 + 2 / 10 + 10 / 100 < 1e-3 * goal.ticks < 1.0511
    before = goal.at(400)
    goal.set(400, [0.2, -0.3])
    assert np.array_equal(before[:2], goal.at(400)[:2]) and before[0].shape == (2,)
    goal.set(500, [0.3, 0.0])
    q, qd, qdd = goal.at(np.arange(500, goal.ticks + 1))
    assert q.shape == qd.shape == qdd.shape == (goal.ticks - 499, 2)
    for rate, limit in zip((q, qd, qdd), ([2.0, 1.0], [10.0, 5.0], [100.0, 50.0])):
        assert (np.abs(np.diff(rate, axis=0)) <= np.multiply(1e-3, limit) + 1e-9).all()
    assert np.array_equal(q[-1], [0.3, 0.0]) and not qd[-1].any() and not qdd[-1].any()
    goal.set(0, [1.0, 1.0], ([0.5, 0.5], [0.1, 0.2], [0.0, 0.0]))
    assert np.array_equal(goal.at(0)[1], [0.1, 0.2])


def test_wrong_goals_name_the_joint():
    goal = rd.MovingGoal([0.0, 0.0], 1e-3, [2.0] * 2, [10.0] * 2, [100.0] * 2)
    still = [0.0, 0.0]
    for call, joint in (
        (lambda: goal.set(0, [0.0, np.nan]), 1),
        (lambda: goal.set(0, still, (still, still, [0.0, 11.0])), 1),
        (lambda: goal.set(0, [1.0]), None),
        (lambda: rd.MovingGoal(still, 1e-3, [2.0] * 2, [0.0, 1.0], [1.0] * 2), 0),
        (lambda: rd.MovingGoal(still, 0.0, [2.0] * 2, [1.0] * 2, [1.0] * 2), None),
    ):
        with pytest.raises(rd.MotionError) as error:
            call()
        assert error.value.joint == joint
    assert np.array_equal(goal.at(0)[0], still)


def at(arm, body, q):
    rotations, positions = arm.poses(q)
    return rotations[body], positions[body]


@pytest.mark.parametrize("name", ["ur5e", "panda"])
def test_positions_of_a_pose_have_it(name):
    arm = rd.Robot(name)
    lower, upper, tip = np.array(arm.lower_limits), np.array(arm.upper_limits), arm.nv - 1
    solver, random, reached = rd.PoseSolver(arm, tip), np.random.default_rng(1), 0
    for _ in range(1000):
        rotation, position = at(arm, tip, random.uniform(np.maximum(lower, -3.0), np.minimum(upper, 3.0)))
        try:
            q = solver.solve(rotation, position)
        except rd.PoseNotReached as error:
            assert len(error.q) == arm.nv
            continue
        found = at(arm, tip, q)
        assert np.allclose(found[0], rotation, rtol=0, atol=1e-8) and np.allclose(found[1], position, rtol=0, atol=1e-8)
        assert (lower <= q).all() and (q <= upper).all()
        reached += 1
    assert reached >= 993


def test_a_ur5e_has_eight_solutions_of_a_pose():
    arm = rd.Robot("ur5e")
    solver = rd.PoseSolver(arm, "wrist_3")
    rotation, position = at(arm, 5, Q)
    found = solver.solutions(rotation, position)
    assert found.shape == (8, 6)
    poses = arm.poses(found)
    assert np.allclose(poses[0][:, 5], rotation, rtol=0, atol=1e-8) and np.allclose(poses[1][:, 5], position, rtol=0, atol=1e-8)
    apart = np.abs(np.sin(0.5 * (found[:, None] - found))).max(axis=2)
    assert (apart + np.eye(8) > 0.1).all() and np.abs(np.sin(0.5 * (found - Q))).max(axis=1).min() < 1e-8
    with pytest.raises(rd.PoseNotReached) as error:
        solver.solve(rotation, [2.0, 0.0, 0.0], Q)
    assert np.linalg.norm(at(arm, 5, error.value.q)[1] - [2.0, 0.0, 0.0]) > 1.0
    for wrong in (np.full((3, 3), np.nan), np.diag([1.0, 1.0, -1.0])):
        with pytest.raises(rd.MotionError):
            solver.solve(wrong, position)
    with pytest.raises(rd.MotionError):
        solver.solve(rotation, [np.nan, 0.0, 0.0])


def test_a_tip_follows_a_twist_within_limits():
    arm = rd.Robot("ur5e")
    tip = rd.TipMotion(arm, "wrist_3", Q, 1e-3, [10.0] * 6)
    start = at(arm, 5, Q)[1]
    ways = {tip.step([0.0, 0.0, 0.0, 0.0, 0.0, 0.1]) for _ in range(1000)}
    assert ways == {("follows", None)}
    assert np.allclose(at(arm, 5, tip.state[0])[1], start + [0.0, 0.0, 0.1], rtol=0, atol=2e-3)
    # Out of reach a joint slows or limits it, and without a twist it comes to rest.
    ways, speeds = zip(*((tip.step([0.0, 0.0, 0.0, 1.0, 0.0, 0.0])[0], tip.state[1]) for _ in range(3000)))
    assert np.abs(speeds).max() <= 3.2 and np.abs(np.diff(speeds, axis=0)).max() <= 0.01 + 1e-12
    assert "slowed" in ways
    assert {tip.step([np.nan] * 6) for _ in range(1000)} == {("stops", None)} and not tip.state[1].any()
    tip.restart((Q, [0.1] * 6, [0.0] * 6))
    assert np.array_equal(tip.state[0], Q)
    with pytest.raises(rd.MotionError):
        tip.restart((Q, [np.nan] * 6, [0.0] * 6))
    with pytest.raises(rd.MotionError) as error:
        rd.TipMotion(arm, 5, Q, 1e-3, [10.0] * 5 + [np.inf])
    assert error.value.joint == 5
