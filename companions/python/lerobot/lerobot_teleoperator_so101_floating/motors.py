"""The servos STS3215 as motors: torque from the duty of the supply's voltage.

With the torque constant k (also that of the back-EMF) and the resistance R, both at the joint, a
servo in its PWM mode that is commanded the duty d of the supply U gives

    τ = k (d U − k q̇) / R.

A command is therefore u = τ + k² q̇ / R, the torque of a duty at rest, and d = u R / (k U).

Source of the numbers: PyPI better-actuator-models 1.0.2 (Apache-2.0),
`params/feetech_sts3215_7_4V/m1.json` and the M3 of the MX-106 for the load-dependent friction,
which were identified on a pendulum with the gear 1:345. They are those of the scene `so101_teach`
of this project's firmware.

Assumed, and not measured on a leader: the servos with the gears 1:191 and 1:147 have the same
motor, so that torque constant and dry friction grow with the reduction, and armature and viscous
friction with its square; the share of the load that a gear takes is the same.
"""

from dataclasses import dataclass

import numpy as np

JOINTS = ("shoulder_pan", "shoulder_lift", "elbow_flex", "wrist_flex", "wrist_roll", "gripper")
"""The joints in the order of their servos, 1 to 6, as in LeRobot and in the robot's description."""

SCENE_GEAR = 345.0
LEADER_GEARS = (191.0, 345.0, 191.0, 147.0, 147.0, 147.0)
"""The reductions of a leader's gears, from LeRobot's page on the SO-101. A follower has 345 at all
joints."""

TORQUE_CONSTANT = 1.2116414
RESISTANCE = 2.6761663
ARMATURE = 0.028403364
COULOMB = 0.05239296
VISCOUS = 0.059085156
LOAD = 0.10824037
WIDTH = 0.05
"""Speed below which friction fades, rad/s: chosen, as in the scene."""

COUNTS = 4096
DUTY_STEPS = 1000
"""A duty is sent in thousandths of the supply's voltage."""


@dataclass(frozen=True)
class Motors:
    """Six servos of these reductions; arrays have one number for each joint, in SI units at the
    joint."""

    gears: tuple[float, ...] = LEADER_GEARS

    @property
    def ratio(self) -> np.ndarray:
        return np.asarray(self.gears, dtype=float) / SCENE_GEAR

    @property
    def torque_constant(self) -> np.ndarray:
        return TORQUE_CONSTANT * self.ratio

    @property
    def back_emf(self) -> np.ndarray:
        """Torque that the back-EMF takes per speed, N·m·s/rad."""
        return TORQUE_CONSTANT**2 / RESISTANCE * self.ratio**2

    @property
    def armature(self) -> np.ndarray:
        return ARMATURE * self.ratio**2

    @property
    def coulomb(self) -> np.ndarray:
        return COULOMB * self.ratio

    @property
    def viscous(self) -> np.ndarray:
        return VISCOUS * self.ratio**2

    @property
    def driving(self) -> np.ndarray:
        return np.full(6, 2.0 * LOAD / (1.0 - LOAD))

    @property
    def backdriving(self) -> np.ndarray:
        return np.full(6, 2.0 * LOAD / (1.0 + LOAD))

    def stall(self, supply: float) -> np.ndarray:
        """Torque at rest per duty, N·m, at this supply, V."""
        return self.torque_constant * supply / RESISTANCE


class DutyRounder:
    """Duties as whole thousandths, whose errors of rounding are carried to the next tick: their
    mean has no step."""

    def __init__(self, joints: int = 6):
        self._rest = np.zeros(joints)

    def round(self, duties: np.ndarray, most: int) -> np.ndarray:
        wanted = DUTY_STEPS * duties + self._rest
        steps = np.clip(np.rint(wanted), -most, most)
        # The part that the limit cuts off is not owed to the next tick.
        self._rest = np.clip(wanted - steps, -0.5, 0.5)
        return steps.astype(int)
