"""LeRobot's own programs run the plug-in: its teleoperation command, on two simulated arms and with
the plug-in's thread."""

import logging
import sys
from types import SimpleNamespace

import numpy as np
import pytest
from conftest import JOINTS, Arm, Bench


@pytest.fixture
def two(tmp_path):
    benches = []
    for name in ("leader", "follower"):
        folder = tmp_path / name
        folder.mkdir()
        benches.append(Bench(folder, benches[0].clock if benches else None))
    yield benches
    for each in benches:
        each.close()


def test_lerobot_teleoperate_runs_from_its_command_line(two, monkeypatch, caplog):
    from lerobot.scripts import lerobot_teleoperate

    from lerobot_teleoperator_so101_floating import So101Floating

    clock = two[0].clock
    monkeypatch.setattr(So101Floating, "clock", clock)
    monkeypatch.setattr(lerobot_teleoperate, "time", SimpleNamespace(perf_counter=clock.now))
    monkeypatch.setattr(lerobot_teleoperate, "precise_sleep", clock.sleep)
    posture = np.array([0.0, -0.8, 0.8, 0.5, 0.0, 0.3])
    leader_arm, follower_arm = Arm(posture), Arm(posture)
    leader_arm.hand = lambda q, qd, time: 20.0 * (posture + [0.3, 0.2, -0.2, 0, 0.3, 0.2] - q) - 1.0 * qd
    # Forces of the follower's servos are stiff: its arm is moved by the same plant.
    leader, follower = two[0].bus(leader_arm), two[1].bus(follower_arm, step=0.1)
    monkeypatch.setattr(logging, "info", lambda *_: None)
    arguments = [
        "lerobot-teleoperate", "--teleop.type=so101_floating", f"--teleop.port={leader.port}", "--teleop.id=bench",
        f"--teleop.calibration_dir={two[0].folder}", "--teleop.gears=[345,345,345,345,345,345]",
        "--teleop.guardian=false", "--teleop.wrist_roll_zero=0", "--robot.type=so101_follower",
        f"--robot.port={follower.port}", "--robot.id=bench", "--robot.use_degrees=true",
        f"--robot.calibration_dir={two[1].folder}", "--teleop_time_s=3", "--fps=30",
    ]  # fmt: skip
    monkeypatch.setattr(sys, "argv", arguments)
    lerobot_teleoperate.main()
    # The leader floated, the follower followed it, and the torque of both is off.
    commanded = [duties for duties in leader.duties if any(duties.values())]
    assert len(commanded) > 590
    assert np.abs(leader_arm.q - posture).max() > 0.15
    assert np.abs(follower_arm.q - posture)[[0, 4]].min() > 0.1
    assert not any(servo.torque_enabled for servo in leader.servos + follower.servos)


def test_the_thread_keeps_the_rate_and_the_action_is_fresh(bench):
    bus = bench.bus(Arm([0.0, -0.8, 0.8, 0.5, 0.0, 0.3]))
    teleoperator = bench.teleoperator(bus, background=True)
    teleoperator.connect(calibrate=False)
    first, ages = len(bus.duties), []
    for _ in range(90):
        action = teleoperator.get_action()
        ages.append(bench.clock.now() - teleoperator.loop.last)
        bench.clock.sleep(1 / 60)
    ticks = len(bus.duties) - first
    teleoperator.disconnect()
    assert set(action) == {f"{joint}.pos" for joint in JOINTS}
    # 200 Hz for one and a half seconds; the last good reading is that of the last tick or, during a
    # tick, the one before.
    assert abs(ticks - 300) <= 1 and max(ages) <= 0.01
    assert not any(servo.torque_enabled for servo in bus.servos)


def test_an_error_of_the_thread_reaches_lerobots_loop(bench):
    from lerobot_teleoperator_so101_floating import ServoSilent

    bus = bench.bus(Arm([0.0, -0.8, 0.8, 0.5, 0.0, 0.3]))
    teleoperator = bench.teleoperator(bus, background=True)
    teleoperator.connect(calibrate=False)
    bench.clock.sleep(0.3)
    bus.servos[1].silent = True
    with pytest.raises(ServoSilent):
        for _ in range(20):
            teleoperator.get_action()
            bench.clock.sleep(1 / 60)
    # The loop gets it at once, and the arm comes down meanwhile; one servo cannot confirm it.
    assert bus.servos[0].torque_enabled
    teleoperator.disconnect()
    assert not any(servo.torque_enabled for servo in bus.servos)
