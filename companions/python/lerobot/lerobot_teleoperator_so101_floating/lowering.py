"""Lowers an arm that nothing guides any more, from what its servos say of positions and duties: it
needs neither model nor calibration, and so it serves after every error, and in the guardian.

Each joint's duty d fades while the joint is slower than v, and brakes it while it is faster:

    ḋ = −f (1 − |q̇|/v) sign d   for |q̇| ≤ v,    ḋ = −b (|q̇|/v − 1) sign q̇   otherwise.

The motor's back-EMF damps what this integrates. At low speeds the small part of it that every gear
and supply has, e q̇, is added to the duty: an arm that creeps under the brake alone gets on. The
torque is switched off once all duties are zero and the arm rests. A joint that does not reply
counts as one at rest: its duty fades unseen.
"""

import math

import numpy as np

from . import wire as wires
from .law import Observer
from .motors import COUNTS, DUTY_STEPS

TICK = 0.005
BANDWIDTH = 30.0
# v, rad/s.
SPEED = 0.4
# f and b, shares of the supply per second; the weight of a stretched arm takes 0.3 of it.
FADE, BRAKE = 0.15, 1.0
# e, s/rad: a gear 1:147 at 8.4 V has it.
BACK_EMF = 0.06
MOST_DUTY = 0.5
# The arm rests if no joint moves on by more than these counts within this time, s: so slowly that
# it stays so without the brake that the back-EMF was.
REST_COUNTS, REST_TIME = 2, 0.6
# An arm that a hand keeps in motion is released after this time, s.
LONGEST = 90.0
ENCODER_FAULT = 1 << 1


class Lowering:
    """The descent of one arm, which a bus that is lost may interrupt."""

    def __init__(self, duties: dict[int, int], now: float):
        """`duties` are those that the servos were last sent; without any, the servos are asked."""
        self._start = dict(duties)
        self._until = now + LONGEST
        self._observer: Observer | None = None

    def run(self, wire: wires.Wire, clock) -> bool:
        """Whether the arm is down and all servos confirm that their torque is off; False if the bus
        is silent, or a servo does not confirm."""
        silent = 0
        while not self._done(clock.now()):
            before = clock.now()
            readings, _ = wire.present()
            silent = 0 if readings else silent + 1
            if silent == 5:
                return False
            if readings and self._observer is None:
                self._begin(wire, readings, before)
            if readings:
                wire.set_duties(self._duties(readings, before))
            clock.sleep(max(before + TICK - clock.now(), 0.0))
        return wire.release(5)

    def _begin(self, wire: wires.Wire, readings: dict[int, wires.Reading], now: float) -> None:
        for _ in range(5):
            if len(self._start) < len(wire.servos):
                found = wire.read_all(wires.GOAL_DUTY, 2).found.items()
                self._start |= {servo: wires.decode(data, wires.DUTY_SIGN) for servo, (_, data) in found}
        self._duty = np.array(list(self._start.values())) / DUTY_STEPS
        self._most = np.maximum(MOST_DUTY, np.abs(self._duty))
        self._counts = np.zeros(len(self._start))
        self._last = {servo: reading.position for servo, reading in readings.items()}
        self._rest, self._since, self._then = self._counts.copy(), now, now
        self._observer = Observer(BANDWIDTH, TICK)

    def _duties(self, readings: dict[int, wires.Reading], now: float) -> dict[int, int]:
        """The duties after one tick more, in thousandths."""
        for place, servo in enumerate(self._start):
            if servo in readings and not readings[servo].status & ENCODER_FAULT:
                position = readings[servo].position
                step = position - self._last.get(servo, position)
                self._counts[place] += (step + COUNTS // 2) % COUNTS - COUNTS // 2
                self._last[servo] = position
        ticks = max(round((now - self._then) / TICK), 1)
        self._then, h = now, ticks * TICK
        _, qd = self._observer.update(self._counts * (math.tau / COUNTS), ticks)
        speed = np.abs(qd) / SPEED
        fade = h * FADE * np.maximum(1.0 - speed, 0.0)
        brake = h * BRAKE * np.maximum(speed - 1.0, 0.0) * np.sign(qd)
        self._duty = np.clip(self._duty - np.clip(self._duty, -fade, fade) - brake, -self._most, self._most)
        if np.abs(self._counts - self._rest).max(initial=0.0) > REST_COUNTS:
            self._rest, self._since = self._counts.copy(), now
        sent = self._duty + BACK_EMF * qd * np.maximum(1.0 - speed, 0.0)
        return dict(zip(self._start, np.rint(DUTY_STEPS * sent).astype(int).tolist(), strict=True))

    def _done(self, now: float) -> bool:
        rests = self._observer is not None and not self._duty.any() and now - self._since > REST_TIME
        return rests or now > self._until
