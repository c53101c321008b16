"""The follower's load is felt, limited, and forgotten."""

import numpy as np
import pytest
from conftest import TICK, Arm, Still, run

WARM = 250


@pytest.fixture
def warm(bench, at_rest):
    bus, teleoperator = bench.floating(at_rest)
    run(teleoperator, WARM)
    return bus, teleoperator


def felt(teleoperator, feedback, ticks=20):
    """The change of the torque under this feedback, N·m."""
    before = teleoperator.loop.torque.copy()
    for _ in range(ticks):
        teleoperator.send_feedback(feedback)
        teleoperator.tick()
    return teleoperator.loop.torque - before


def test_the_load_is_felt_by_the_gain_beyond_the_dead_band(warm):
    _, teleoperator = warm
    loads = {"shoulder_pan": 50.0, "elbow_flex": 0.55, "wrist_roll": -0.25, "gripper": 0.04}
    change = felt(teleoperator, {f"{joint}.torque": load for joint, load in loads.items()})
    # The first is limited, the last within the dead band.
    assert np.abs(change - [0.3, 0, 0.3 * 0.5, 0, -0.3 * 0.2, 0]).max() < 1e-6


def test_a_load_that_is_no_longer_sent_is_forgotten(warm):
    bus, teleoperator = warm
    before = teleoperator.loop.torque.copy()
    felt(teleoperator, {"elbow_flex.torque": 0.55})
    run(teleoperator, round(0.3 / TICK))
    assert np.abs(teleoperator.loop.torque - before).max() < 1e-6
    assert not any(servo.registers[65] for servo in bus.servos)


def test_the_torque_changes_no_faster_than_allowed(bench, at_rest):
    bus, teleoperator = bench.floating(at_rest, torque_rate=2.0, feedback_gain=1.0)
    run(teleoperator, 400)
    assert np.abs(felt(teleoperator, {"elbow_flex.torque": 0.3}, 1)[2] - 2.0 * TICK) < 1e-9


def test_torques_are_limited(bench):
    bus, teleoperator = bench.floating(Still([0.0, 1.3, -1.2, 0.0, 0.0, 0.0]), torque_limit=0.5)
    run(teleoperator, 400)
    assert np.abs(teleoperator.loop.torque).max() == 0.5


def test_walls_push_back_at_the_ends_of_joints(bench):
    inside, beyond = Still([1.80, 0, 0, 0, 0, 0]), Still([1.93, 0, 0, 0, 0, 0])
    torques = []
    for arm in (inside, beyond):
        _, teleoperator = bench.floating(arm)
        run(teleoperator, 400)
        torques.append(teleoperator.loop.torque[0])
        teleoperator.disconnect()
    # 5 N·m/rad from 0.05 rad before the limit of 1.91986 rad on, at the count next to 1.93 rad.
    assert abs(torques[0]) < 1e-4 and abs(torques[1] + 5.0 * (1.93 - 1.86986)) < 5e-3


def test_a_hand_moves_the_arm_with_less_effort(bench):
    """The torque of a hand that leads the shoulder and the wrist, with and without compensated
    friction."""

    def effort(**options):
        arm = Arm([0.0, -0.8, 0.8, 0.5, 0.0, 0.2])
        start, sum_of_squares = arm.q.copy(), []

        def hand(q, qd, time):
            after = max(time - 0.6, 0.0)
            way = np.array([0.4, 0.3, 0.0, 0.3, 0.5, 0.0])
            wanted = start + way * np.sin(0.8 * after)
            torque = 20.0 * (wanted - q) + 1.0 * (0.8 * way * np.cos(0.8 * after) * (after > 0.0) - qd)
            if time > 0.6:
                sum_of_squares.append(torque @ torque)
            return torque

        arm.hand = hand
        _, teleoperator = bench.floating(arm, ramp=0.3, **options)
        run(teleoperator, round(4.0 / TICK))
        return np.sqrt(np.mean(sum_of_squares))

    assert effort() <= 0.7 * effort(friction_share=0.0)


@pytest.mark.parametrize("push", [0.0, 0.6, -0.6])
def test_a_push_on_the_follower_is_felt_at_the_leader(tmp_path, push):
    """The load of LeRobot's own follower comes from its positions alone; its joints move, and the
    hand pushes one."""
    from conftest import Bench
    from lerobot.robots.so_follower import SOFollower, SOFollowerRobotConfig

    from lerobot_teleoperator_so101_floating import FollowerLoad

    posture = np.array([0.0, -0.8, 0.8, 0.5, 0.0, 0.3])
    sides = []
    for name in ("leader", "follower"):
        (tmp_path / name).mkdir()
        sides.append(Bench(tmp_path / name, sides[0].clock if sides else None))
    try:
        leader, teleoperator = sides[0].floating(Still(posture))
        arm = Arm(posture)
        arm.hand = lambda q, qd, time: np.array([0.0, 0.0, push if time > 2.0 else 0.0, 0.0, 0.0, 0.0])
        bus = sides[1].bus(arm)
        robot = SOFollower(SOFollowerRobotConfig(id="bench", calibration_dir=tmp_path / "follower", port=bus.port))
        robot.connect(calibrate=False)
        estimate = FollowerLoad(dead_band=0.0)
        torques = []
        for tick in range(800):
            action = teleoperator.get_action()
            robot.send_action(action)
            load = estimate.of(action, robot.get_observation())
            teleoperator.send_feedback(load if tick > 300 else {})
            torques.append(teleoperator.loop.torque[2])
        robot.disconnect()
        # The gear's friction, a fifth of the load, may carry a part of it.
        assert abs(load["elbow_flex.torque"] - push) <= 0.05 + 0.3 * abs(push)
        felt = torques[-1] - torques[380]
        assert felt * push > 0.05 if push else abs(felt) < 0.02
    finally:
        for side in sides:
            side.close()
