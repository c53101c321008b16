"""LeRobot's own programs run the plug-in: its teleoperation command, on two simulated arms, in real time."""

import logging
import sys
import time

import numpy as np
import pytest
from conftest import JOINTS, Arm, Bench


@pytest.fixture
def two(tmp_path):
    benches = []
    for name in ("leader", "follower"):
        folder = tmp_path / name
        folder.mkdir()
        benches.append(Bench(folder))
    yield benches
    for each in benches:
        each.close()


def test_lerobot_teleoperate_runs_from_its_command_line(two, monkeypatch, caplog):
    from lerobot.scripts import lerobot_teleoperate

    posture = np.array([0.0, -0.8, 0.8, 0.5, 0.0, 0.3])
    leader_arm, follower_arm = Arm(posture), Arm(posture)
    leader_arm.hand = lambda q, qd, time: 20.0 * (posture + [0.3, 0.2, -0.2, 0, 0.3, 0.2] - q) - 1.0 * qd
    # Forces of the follower's servos are stiff: its arm is moved by the same plant.
    leader, follower = two[0].bus(leader_arm, step=None), two[1].bus(follower_arm, step=None)
    monkeypatch.setattr(logging, "info", lambda *_: None)
    arguments = [
        "lerobot-teleoperate", "--teleop.type=so101_floating", f"--teleop.port={leader.port}", "--teleop.id=bench",
        f"--teleop.calibration_dir={two[0].folder}", "--teleop.gears=[345,345,345,345,345,345]", "--teleop.most_age=2.0",
        "--teleop.reply_time=1.0", "--robot.type=so101_follower", f"--robot.port={follower.port}", "--robot.id=bench",
        "--robot.use_degrees=true", f"--robot.calibration_dir={two[1].folder}", "--teleop_time_s=3", "--fps=30",
    ]  # fmt: skip
    monkeypatch.setattr(sys, "argv", arguments)
    lerobot_teleoperate.main()
    # The leader floated, the follower followed it, and the torque of both is off.
    commanded = [duties for duties in leader.duties if any(duties.values())]
    assert len(commanded) > 100
    assert np.abs(leader_arm.q - posture).max() > 0.15
    assert np.abs(follower_arm.q - posture)[[0, 4]].min() > 0.1
    assert not any(servo.torque_enabled for servo in leader.servos + follower.servos)


def test_the_thread_keeps_the_rate_and_the_action_is_fresh(bench):
    arm = Arm([0.0, -0.8, 0.8, 0.5, 0.0, 0.3])
    bus = bench.bus(arm, step=None)
    teleoperator = bench.teleoperator(bus, background=True, most_age=2.0)
    teleoperator.connect(calibrate=False)
    begin, first = time.monotonic(), len(bus.duties)
    actions = []
    while time.monotonic() - begin < 1.5:
        actions.append(teleoperator.get_action())
        time.sleep(1 / 60)
    rate = (len(bus.duties) - first) / (time.monotonic() - begin)
    teleoperator.disconnect()
    assert set(actions[0]) == {f"{joint}.pos" for joint in JOINTS}
    # A machine that is busy with other tests has less than the 200 Hz of the configuration.
    assert 50.0 < rate < 210.0
    assert not any(servo.torque_enabled for servo in bus.servos)


def test_an_error_of_the_thread_reaches_lerobots_loop(bench):
    from lerobot_teleoperator_so101_floating import ServoSilent

    arm = Arm([0.0, -0.8, 0.8, 0.5, 0.0, 0.3])
    bus = bench.bus(arm, step=None)
    teleoperator = bench.teleoperator(bus, background=True, most_age=2.0, reply_time=0.3)
    teleoperator.connect(calibrate=False)
    time.sleep(0.3)
    bus.servos[1].silent = True
    with pytest.raises(ServoSilent):
        for _ in range(200):
            teleoperator.get_action()
            time.sleep(1 / 60)
    assert not any(servo.torque_enabled for servo in bus.servos)
    teleoperator.disconnect()
