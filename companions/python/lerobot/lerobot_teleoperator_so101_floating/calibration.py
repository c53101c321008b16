"""Whether a calibration can be that of this arm, and joint angles from encoder counts.

LeRobot's calibration puts count 2047 at the middle of each joint's range, and its degrees count
from there. So do the angles of the description that this project imports (`so101.urdf`, "new
calibration"), which LeRobot's own kinematics takes degrees for. The jaw's ends are the ends of its
range.
"""

import math

import numpy as np
from lerobot.motors import MotorCalibration

from .errors import JointOutOfRange, WrongCalibration
from .motors import COUNTS, JOINTS
from .wire import Reading

LOWER = np.array([-1.91986, -1.74533, -1.69, -1.65806, -2.74385, -0.174533])
UPPER = np.array([1.91986, 1.74533, 1.69, 1.65806, 2.84121, 1.74533])
"""The joints' limits, rad, of the description."""

RADIANS = math.tau / COUNTS
MOST_OFFSET = 2047
"""The greatest magnitude that the servo's register of the offset holds."""

# The least and greatest range that is accepted, as a share of that of the description, and the most
# by which its middle may be off the middle of the turn, in counts. The ranges of a person's
# recording end a little before the ends of the joint, and the trigger of a leader opens less than
# the jaw.
NARROWEST = np.array([0.75, 0.75, 0.75, 0.75, 0.75, 0.3])
WIDEST = 1.2
OFF_MIDDLE = 512


def check(calibration: dict[str, MotorCalibration], advice: str = "run lerobot-calibrate") -> None:
    """Raises `WrongCalibration` if this cannot be the calibration of an SO-101."""
    missing = [joint for joint in JOINTS if joint not in calibration]
    others = [joint for joint in calibration if joint not in JOINTS]
    if missing or others:
        raise WrongCalibration(
            f"the calibration is that of another arm: it lacks {missing} and has {others}: {advice}",
            (missing or others)[0],
        )
    for place, joint in enumerate(JOINTS):
        of = calibration[joint]

        def refuse(why: str, joint: str = joint) -> WrongCalibration:
            return WrongCalibration(f"the calibration of {joint} is wrong, {why}: {advice}", joint)

        numbers = (of.id, of.drive_mode, of.homing_offset, of.range_min, of.range_max)
        if not all(isinstance(number, int) and not isinstance(number, bool) for number in numbers):
            raise refuse("its entries are whole numbers")
        if of.id != place + 1:
            raise refuse(f"its servo is {of.id} instead of {place + 1}")
        if of.drive_mode != 0:
            raise refuse("its direction is inverted, which no SO-101 is")
        if abs(of.homing_offset) > MOST_OFFSET:
            raise refuse(f"the offset {of.homing_offset} exceeds {MOST_OFFSET} counts")
        if not 0 <= of.range_min < of.range_max < COUNTS:
            raise refuse(f"its range is {of.range_min} to {of.range_max}")
        share = (of.range_max - of.range_min) * RADIANS / (UPPER[place] - LOWER[place])
        if not NARROWEST[place] <= share <= WIDEST:
            raise refuse(f"its range is {share:.2f} of the joint's; it was not moved from end to end")
        if joint != "gripper" and abs((of.range_min + of.range_max) / 2.0 - COUNTS / 2.0) > OFF_MIDDLE:
            raise refuse("the middle of its range is far from the middle of the turn")


def turns_fully(calibration: dict[str, MotorCalibration]) -> bool:
    """Whether the wrist was recorded as a full turn, as LeRobot does without asking."""
    wrist = calibration["wrist_roll"]
    return wrist.range_max - wrist.range_min == COUNTS - 1


class Angles:
    """The conversion of counts into joint angles; `wrist_roll_zero` in LeRobot's degrees."""

    def __init__(self, calibration: dict[str, MotorCalibration], wrist_roll_zero: float = 0.0):
        middles = [(calibration[joint].range_min + calibration[joint].range_max) / 2.0 for joint in JOINTS]
        middles[4] += math.radians(wrist_roll_zero) / RADIANS
        middles[5] = calibration["gripper"].range_min - LOWER[5] / RADIANS
        self._zero = np.array(middles)

    def of(self, counts: np.ndarray) -> np.ndarray:
        return (counts - self._zero) * RADIANS

    def counts(self, angles: np.ndarray) -> np.ndarray:
        return np.rint(angles / RADIANS + self._zero).astype(int)

    def check(self, angles: np.ndarray, beyond: float) -> None:
        """Raises `JointOutOfRange` of the first joint further beyond its limits than this."""
        outside = (angles < LOWER - beyond) | (angles > UPPER + beyond)
        if outside.any():
            place = int(outside.argmax())
            raise JointOutOfRange(
                f"{JOINTS[place]} is at {angles[place]:.2f} rad, beyond {LOWER[place]:.2f} to {UPPER[place]:.2f}", JOINTS[place]
            )


def check_posture(calibration: dict[str, MotorCalibration], readings: dict[int, Reading], margin: int = 120) -> None:
    """Raises `WrongCalibration` if a joint stands outside the range of its own calibration by more
    than these counts."""
    for joint in JOINTS:
        of = calibration[joint]
        position = readings[of.id].position
        if not of.range_min - margin <= position <= of.range_max + margin:
            raise WrongCalibration(
                f"{joint} stands at count {position}, outside its calibration, {of.range_min} to {of.range_max}", joint
            )
