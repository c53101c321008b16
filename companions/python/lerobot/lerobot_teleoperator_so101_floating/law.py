"""The law of an arm that floats: observer, friction that is compensated in part, walls, and the
follower's load.

Observer and friction are those of the firmware's `Observer` and `HandGuiding` (motion-control), of
which the guide has the reasons and the measurements: with a share σ of at most 1/(1 + ε) the
compensation never exceeds the friction that there is, and by the errors of gravity it is smaller
still, so that an arm that is released comes to rest.
"""

import math

import numpy as np


class Observer:
    """Velocities from encoder positions: both poles at exp(−ω h), h a whole number of ticks."""

    def __init__(self, bandwidth: float, tick: float):
        self.bandwidth, self.tick = bandwidth, tick
        self.q: np.ndarray | None = None
        self.qd = np.zeros(0)

    def update(self, measured: np.ndarray, ticks: int = 1) -> tuple[np.ndarray, np.ndarray]:
        """Positions and velocities after a measurement that comes `ticks` ticks after the one
        before."""
        if self.q is None:
            self.q, self.qd = measured.copy(), np.zeros_like(measured)
            return self.q, self.qd
        h = ticks * self.tick
        gap = -math.expm1(-self.bandwidth * h)
        predicted = self.q + h * self.qd
        error = measured - predicted
        self.q = predicted + gap * (2.0 - gap) * error
        self.qd = self.qd + gap * gap / h * error
        return self.q, self.qd


class Guiding:
    """The share of friction that is compensated, and walls at the ends of the joints."""

    def __init__(self, config, lower: np.ndarray, upper: np.ndarray):
        self.share, self.most = config.friction_share, config.most_friction
        self.rest_speed, self.gravity_error = config.rest_speed, config.gravity_error
        self.stiffness, self.damping, self.wall = config.wall_stiffness, config.wall_damping, config.wall_torque
        self.lower, self.upper = lower, upper

    def compensation(self, qd: np.ndarray, gravity: np.ndarray, friction: np.ndarray) -> np.ndarray:
        """max(σ |F̂| − e, 0), in the direction of F̂ while that is the one of the motion, and zero
        at rest."""
        errors = np.abs(self.gravity_error * gravity)
        shared = self.share * friction
        torque = shared - np.clip(shared, -errors, errors)
        torque = np.where(torque * qd > 0.0, torque, 0.0)
        moves = np.clip(np.abs(qd) / self.rest_speed - 1.0, 0.0, 1.0)
        return moves * np.clip(torque, -self.most, self.most)

    def walls(self, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
        """Springs that push back from the ends and never pull, damped on motion into them alone."""

        def push(depth, inward):
            torque = self.stiffness * depth + self.damping * np.maximum(inward, 0.0)
            return np.where(depth > 0.0, np.clip(torque, 0.0, self.wall), 0.0)

        return push(self.lower - q, -qd) - push(q - self.upper, qd)


class Feedback:
    """The follower's load as it is felt: a gain beyond a dead band, limited, and forgotten when it
    is old."""

    def __init__(self, config):
        self.gain, self.dead_band = config.feedback_gain, config.feedback_dead_band
        self.most, self.timeout = config.feedback_torque, config.feedback_timeout
        self._torque, self._since = np.zeros(6), -math.inf

    def set(self, torque: np.ndarray, now: float) -> None:
        self._torque, self._since = torque, now

    def torque(self, now: float) -> np.ndarray:
        if now - self._since > self.timeout:
            return np.zeros(6)
        beyond = self._torque - np.clip(self._torque, -self.dead_band, self.dead_band)
        return np.clip(self.gain * beyond, -self.most, self.most)
