"""One tick of the loop: read, check, compute, limit, send. Whoever calls it switches the torque off
if it raises."""

import numpy as np

from .calibration import LOWER, UPPER, Angles
from .errors import DynamicsFailed, ImplausibleMotion, LoopLate
from .law import Feedback, Guiding, Observer
from .monitor import Misses, Plausibility
from .motors import DUTY_STEPS, JOINTS, DutyRounder, Motors
from .wire import Wire


class Loop:
    """The loop of six servos; `dynamics(q, qd)` gives the torques of gravity and of friction,
    N·m."""

    def __init__(self, config, wire: Wire, angles: Angles, dynamics):
        self.config, self.wire, self.angles, self.dynamics = config, wire, angles, dynamics
        self.motors = Motors(config.gears)
        self.tick_time = 1.0 / config.rate
        self.observer = Observer(config.bandwidth, self.tick_time)
        self.guiding = Guiding(config, LOWER + config.wall_margin, UPPER - config.wall_margin)
        self.feedback = Feedback(config)
        self.misses = Misses(wire.servos, config.most_misses)
        self.plausibility = Plausibility(config)
        self.rounder = DutyRounder()
        self.counts: np.ndarray | None = None
        """The positions of the last good reading, counts."""
        self.torque = np.zeros(6)
        """The torques that were last commanded, N·m."""
        self._started: float | None = None
        self._last: float | None = None

    @property
    def last(self) -> float | None:
        """When the last good reading came."""
        return self._last

    def tick(self, now: float) -> None:
        """Raises a `FloatingError`, or an error of the port, after which no torque may be left
        on."""
        readings, replies = self.wire.present()
        if not self.misses.record(replies):
            return  # The servos keep their duties for the few ticks that may be missed.
        ticks = self._ticks(now)
        ordered = [readings[servo] for servo in self.wire.servos]
        self.plausibility.check(now, ordered, ticks)
        self.counts = np.array([reading.position for reading in ordered])
        measured = self.angles.of(self.counts)
        self.angles.check(measured, self.config.beyond_limits)
        q, qd = self.observer.update(measured, ticks)
        fast = np.abs(qd) > self.config.most_speed
        if fast.any():
            place = int(fast.argmax())
            raise ImplausibleMotion(f"{JOINTS[place]} moves at {qd[place]:.1f} rad/s", JOINTS[place])
        self._command(now, q, qd, ticks)

    def _ticks(self, now: float) -> int:
        """The age of the last good reading, in ticks."""
        before, self._last = self._last, now
        if before is None:
            self._started = now
            return 1
        if now - before > self.config.most_age:
            raise LoopLate(f"the loop did not run for {now - before:.2f} s")
        return max(round((now - before) / self.tick_time), 1)

    def _command(self, now: float, q: np.ndarray, qd: np.ndarray, ticks: int) -> None:
        wanted = self._wanted(now, q, qd)
        step = self.config.torque_rate * ticks * self.tick_time
        self.torque = np.clip(wanted, self.torque - step, self.torque + step)
        # The back-EMF is the motor's own and no torque at the joint; its part follows the speed
        # without a limit of its rate.
        command = self.torque + self._ramp(now) * self.motors.back_emf * qd
        most = int(self.config.most_duty * DUTY_STEPS)
        steps = self.rounder.round(command / self.motors.stall(self.plausibility.supply), most)
        self.wire.set_duties(dict(zip(self.wire.servos, steps.tolist(), strict=True)))
        self.plausibility.sent(now, steps)

    def _ramp(self, now: float) -> float:
        since = now - (self._started if self._started is not None else now)
        return min(since / self.config.ramp, 1.0) if self.config.ramp > 0.0 else 1.0

    def _wanted(self, now: float, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
        try:
            gravity, friction = self.dynamics(q, qd)
        except Exception as error:
            raise DynamicsFailed(f"the model raised {error!r}") from error
        gravity = gravity * np.asarray(self.config.gravity_scale)
        free = gravity + self.guiding.compensation(qd, gravity, friction) + self.feedback.torque(now)
        torque = self._ramp(now) * (free + self.guiding.walls(q, qd))
        if not np.isfinite(torque).all():
            raise DynamicsFailed("the model gave torques that are not finite", JOINTS[int(np.argmin(np.isfinite(torque)))])
        return np.clip(torque, -self.config.torque_limit, self.config.torque_limit)
