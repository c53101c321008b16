"""A wrong calibration is found before the torque is switched on."""

import copy

import pytest
from conftest import JOINTS, calibration, run

from lerobot_teleoperator_so101_floating import JointOutOfRange, WrongCalibration, WrongConfiguration, WrongServos


def changed(**entries):
    """The right calibration, with some entries of one joint changed."""
    joint = entries.pop("joint", "elbow_flex")
    made = calibration()
    made[joint].update(entries)
    return made


def swapped():
    made = calibration()
    made["wrist_roll"], made["elbow_flex"] = (
        made["elbow_flex"] | {"id": 5},
        made["wrist_roll"] | {"id": 3},
    )
    return made


WRONG = {
    "five_joints": {joint: entry for joint, entry in calibration().items() if joint != "wrist_roll"},
    "another_robot": {f"joint_{place}": entry for place, entry in enumerate(calibration().values())},
    "seven_joints": calibration() | {"wrist_yaw": calibration()["wrist_flex"] | {"id": 7}},
    "two_joints_swapped": swapped(),
    "offset_out_of_range": changed(homing_offset=2600),
    "another_identity": changed(id=4),
    "inverted": changed(drive_mode=1),
    "range_upside_down": changed(range_min=3148, range_max=946),
    "range_beyond_the_turn": changed(range_max=5000),
    "hardly_moved": changed(range_min=1900, range_max=2200),
    "far_from_the_middle": changed(joint="shoulder_pan", range_min=100, range_max=2600),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_calibration_that_cannot_be_this_arms_is_refused(bench, at_rest, name):
    bus = bench.bus(at_rest)
    wrong = WRONG[name]
    bench.write(wrong)
    # The servos have it too: the check is of the numbers, not of the difference.
    for place, joint in enumerate(JOINTS):
        if joint in wrong and abs(wrong[joint]["homing_offset"]) < 2048 and wrong[joint]["range_max"] < 4096:
            bus.servos[place].calibrate(wrong[joint]["homing_offset"], wrong[joint]["range_min"], wrong[joint]["range_max"])
    teleoperator = bench.teleoperator(bus)
    with pytest.raises(WrongCalibration) as caught:
        teleoperator.connect()
    assert caught.value.joint in (*JOINTS, "joint_0", "wrist_yaw", None)
    no_torque_ever(bus)
    assert not teleoperator.is_connected


def no_torque_ever(bus):
    assert not any(servo.torque_enabled for servo in bus.servos)
    torque = [parameters for _, instruction, parameters in bus.received if instruction in (3, 0x83) and parameters[0] == 40]
    assert not any(1 in parameters[1:2] for parameters in torque if len(parameters) == 2)


def test_servos_of_another_calibration_are_refused(bench, at_rest, monkeypatch):
    def nobody(_):
        raise EOFError

    monkeypatch.setattr("builtins.input", nobody)
    bus = bench.bus(at_rest)
    bus.servos[1].calibrate(-300, 910, 3184)
    teleoperator = bench.teleoperator(bus)
    with pytest.raises(WrongCalibration, match="do not have the calibration"):
        teleoperator.connect()  # LeRobot asks, and nobody answers.
    no_torque_ever(bus)


def test_without_calibration_there_is_neither_torque_nor_action(bench, at_rest):
    bus = bench.bus(at_rest)
    bench.file.unlink()
    teleoperator = bench.teleoperator(bus)
    teleoperator.connect(calibrate=False)
    with pytest.raises(WrongCalibration):
        teleoperator.get_action()
    no_torque_ever(bus)
    teleoperator.disconnect()


def test_a_posture_outside_the_calibrated_ranges_is_refused(bench, at_rest):
    bus = bench.bus(at_rest)
    # The horn was mounted anew: the joint's zero is an eighth of a turn from where it was
    # calibrated.
    bus.servos[2].mounting -= 900
    bus.servos[2].refresh()
    with pytest.raises(WrongCalibration, match="elbow_flex stands at count"):
        bench.teleoperator(bus).connect(calibrate=False)
    no_torque_ever(bus)


def test_a_joint_that_leaves_its_limits_ends_without_torque(bench, at_rest):
    bus, teleoperator = bench.floating(at_rest)
    rows = [copy.copy(at_rest.q) for _ in range(400)]
    for tick, row in enumerate(rows):
        row[2] -= 0.01 * min(tick, 160)
    at_rest.rows, at_rest.row = rows, -1
    with pytest.raises(JointOutOfRange) as caught:
        run(teleoperator, 400)
    assert caught.value.joint == "elbow_flex" and caught.value.released
    assert not any(servo.torque_enabled for servo in bus.servos)


def test_a_servo_that_counts_turns_counts_within_one_again(bench, at_rest):
    bus = bench.bus(at_rest)
    bus.servos[3].registers[18] |= 1 << 4
    bus.servos[3].refresh()
    assert bus.servos[3].get(56) > 4096
    teleoperator = bench.teleoperator(bus)
    teleoperator.connect(calibrate=False)
    run(teleoperator, 10)
    assert bus.servos[3].registers[18] == 12 and bus.servos[3].torque_enabled


def test_a_full_turn_of_the_wrist_needs_a_statement(bench, at_rest):
    bus = bench.bus(at_rest)
    teleoperator = bench.teleoperator(bus, wrist_roll_zero=None)
    with pytest.raises(WrongCalibration, match=r"wrist_roll_zero=ANGLE; now it is at 0"):
        teleoperator.connect()
    no_torque_ever(bus)
    # lerobot-calibrate connects so.
    teleoperator.connect(calibrate=False)
    no_torque_ever(bus)
    teleoperator.disconnect()
    stated = bench.teleoperator(bus, wrist_roll_zero=30.0)
    stated.connect()
    stated.tick()
    assert abs(stated.loop.observer.q[4] + 0.5236) < 1e-3 and abs(stated.get_action()["wrist_roll.pos"]) < 0.1


@pytest.mark.parametrize("bit", [0, 7])
def test_a_reversed_servo_is_refused(bench, at_rest, bit):
    bus = bench.bus(at_rest)
    bus.servos[3].registers[18] |= 1 << bit
    with pytest.raises(WrongConfiguration, match="wrist_flex"):
        bench.teleoperator(bus).connect(calibrate=False)
    no_torque_ever(bus)


@pytest.mark.parametrize(("wrong", "words"), [(lambda servo: servo.cut(), "5"), (lambda servo: servo.set(3, 2825), "2825")])
def test_a_servo_that_is_missing_or_of_another_model_is_refused(bench, at_rest, wrong, words):
    bus = bench.bus(at_rest)
    wrong(bus.servos[4])
    with pytest.raises(WrongServos, match=words):
        bench.teleoperator(bus).connect(calibrate=False)
    no_torque_ever(bus)


def test_angles_are_lerobots_degrees(bench, at_rest):
    import numpy as np

    bus, teleoperator = bench.floating(at_rest)
    action = teleoperator.get_action()
    for joint, angle in zip(JOINTS[:5], at_rest.q, strict=False):
        assert abs(np.deg2rad(action[f"{joint}.pos"]) - angle) < 2e-3, joint


def test_another_description_is_taken_or_refused(tmp_path):
    import numpy as np
    import robot_dynamics as rd
    from conftest import REPOSITORY

    from lerobot_teleoperator_so101_floating.calibration import LOWER, UPPER
    from lerobot_teleoperator_so101_floating.dynamics import floating_dynamics
    from lerobot_teleoperator_so101_floating.motors import Motors

    assert np.array_equal([rd.Robot("so101").lower_limits, rd.Robot("so101").upper_limits], [LOWER, UPPER])
    q, qd = np.array([0.3, 0.6, -0.6, 0.2, 0.1, 0.3]), np.full(6, 0.2)
    file = REPOSITORY / "tools/robot-import/tests/urdf/so101.urdf"
    for own, library in zip(floating_dynamics(Motors(), str(file))(q, qd), floating_dynamics(Motors(), None)(q, qd), strict=True):
        assert np.allclose(own, library, atol=1e-6)
    (tmp_path / "renamed.urdf").write_text(file.read_text().replace('"wrist_roll"', '"wrist_yaw"'))
    (tmp_path / "broken.urdf").write_text("<robot>")
    # The zeros of the SO-100's description: its shoulder turns from 0 to 3.5 rad.
    zeros = file.read_text().replace("-1.74533", "0.0").replace("1.74533", "3.5")
    (tmp_path / "zeros.urdf").write_text(zeros)
    for wrong in ("zeros.urdf", "renamed.urdf", "broken.urdf", "none.urdf"):
        with pytest.raises(WrongConfiguration):
            floating_dynamics(Motors(), str(tmp_path / wrong))
