"""The load of a follower, from what LeRobot's so101_follower observes: positions alone.

The servo of a joint gives the duty P · 0.166 per radian by which its position is off its goal
(0.166 and the motor's numbers: the source of `motors.py`). At rest that torque and the
surroundings' carry the joint's weight, of which the model is known. While the arm moves, the error
also has friction and lag in it: `dead_band` leaves them out. Not tried on hardware.
"""

import numpy as np

from .calibration import LOWER, UPPER
from .motors import JOINTS, SCENE_GEAR, Motors

DUTY_PER_GAIN = 0.166


class FollowerLoad:
    """Estimates the torques with which its surroundings load each joint of a follower that uses
    degrees."""

    def __init__(self, gain: float = 16.0, supply: float = 7.4, dead_band: float = 0.15):
        """`gain` is the servos' P_Coefficient, which so101_follower sets to 16; `supply` in V,
        `dead_band` in N·m."""
        from .dynamics import floating_dynamics

        motors = Motors((SCENE_GEAR,) * 6)
        self._stiffness = gain * DUTY_PER_GAIN * motors.stall(supply)
        self._most = motors.stall(supply)
        self._dynamics = floating_dynamics(motors, None)
        self._dead_band = dead_band

    def of(self, action: dict[str, float], observation: dict[str, float]) -> dict[str, float]:
        """The feedback that `send_feedback` takes, computed from the action that the follower was
        sent and the observation that came after it."""
        goal, present = self._angles(action), self._angles(observation)
        motor = np.clip(self._stiffness * (goal - present), -self._most, self._most)
        gravity, _ = self._dynamics(present, np.zeros(6))
        load = gravity - motor
        load -= np.clip(load, -self._dead_band, self._dead_band)
        return {f"{joint}.torque": float(torque) for joint, torque in zip(JOINTS, load, strict=True)}

    @staticmethod
    def _angles(values: dict[str, float]) -> np.ndarray:
        given = np.array([values[f"{joint}.pos"] for joint in JOINTS], dtype=float)
        angles = np.radians(given)
        angles[5] = LOWER[5] + given[5] / 100.0 * (UPPER[5] - LOWER[5])
        return angles
