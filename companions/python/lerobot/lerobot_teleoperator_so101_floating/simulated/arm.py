"""The arm that the servos move: the scene's plant, by the dynamics of the wheel."""

import numpy as np

from ..calibration import LOWER, UPPER
from . import plant
from .servo import RESISTANCE

STEP = 5e-4


class Still:
    """An arm whose positions are prescribed, one row of angles for each step of time; the last one
    stays."""

    def __init__(self, rows):
        self.rows = np.atleast_2d(np.asarray(rows, dtype=float))
        self.row = -1
        self.q, self.qd = self.rows[0], np.zeros(6)

    def advance(self, servos, seconds: float) -> None:
        before = self.q
        self.row = min(self.row + 1, len(self.rows) - 1)
        self.q = self.rows[self.row]
        self.qd = (self.q - before) / seconds


class Arm:
    """A moving SO-101: gravity, inertia, friction, rotors, and ends of the joints."""

    def __init__(self, q, gears=(345.0,) * 6, **changes):
        self.q, self.qd = np.array(q, dtype=float), np.zeros(6)
        self.forward = plant.forward_dynamics(gears, **changes)
        self.hand = lambda q, qd, time: np.zeros(6)
        """The torque of a hand at the joints."""
        self.time = 0.0

    def advance(self, servos, seconds: float) -> None:
        steps = max(round(seconds / STEP), 1)
        h = seconds / steps
        constants, volts = np.array([servo.motor() for servo in servos]).T
        for _ in range(steps):
            motors = constants * (volts - constants * self.qd) / RESISTANCE
            ends = 50.0 * (np.minimum(np.maximum(self.q, LOWER), UPPER) - self.q)
            ends -= (ends != 0.0) * self.qd
            torque = motors + ends + self.hand(self.q, self.qd, self.time)
            self.qd = self.qd + h * self.forward(self.q, self.qd, torque)
            self.q = self.q + h * self.qd
            self.time += h
