"""The checks that every reading passes before a torque is computed from it."""

from collections import deque

import numpy as np

from .errors import BusLost, CorruptReplies, ImplausibleMotion, ServoFault, ServoSilent, StaleServo, WrongSupply
from .motors import DUTY_STEPS, JOINTS
from .wire import Reading, Replies

OVERHEATED = 1 << 2


class Misses:
    """Counts the ticks in a row in which a servo did not reply."""

    def __init__(self, servos: list[int], most: int):
        self.servos, self.most = servos, most
        self._missed = dict.fromkeys(servos, 0)
        self._corrupt = dict.fromkeys(servos, 0)

    def record(self, replies: Replies) -> bool:
        """Whether all servos replied; raises the error of what was missed too often."""
        for servo in self.servos:
            missed = servo in replies.missing
            self._missed[servo] = self._missed[servo] + 1 if missed else 0
            self._corrupt[servo] = self._corrupt[servo] + (servo in replies.corrupt) if missed else 0
        too_often = [servo for servo in self.servos if self._missed[servo] >= self.most]
        if not too_often:
            return not replies.missing
        corrupt = [servo for servo in too_often if self._corrupt[servo] > 0]
        if corrupt:
            joint = JOINTS[self.servos.index(corrupt[0])]
            raise CorruptReplies(f"the replies of {joint} came with a wrong checksum {self.most} times in a row", joint)
        if len(too_often) == len(self.servos):
            raise BusLost(f"no servo replied {self.most} times in a row")
        joint = JOINTS[self.servos.index(too_often[0])]
        raise ServoSilent(f"the servo of {joint} did not reply {self.most} times in a row", joint)


class Plausibility:
    """Checks what the servos say against itself, against the past and against what they were
    commanded."""

    def __init__(self, config):
        self.config = config
        self._voltage: float | None = None
        self._before: np.ndarray | None = None
        self._frozen_since: list[tuple[float, int] | None] = [None] * 6
        self._strange_since: list[float | None] = [None] * 6
        # Duties and when they were sent, for as long as a servo may take to follow.
        self._sent: deque[tuple[float, np.ndarray]] = deque()

    def sent(self, now: float, steps: np.ndarray) -> None:
        self._sent.append((now, steps))
        while len(self._sent) > 1 and self._sent[1][0] < now - self.config.stale_time:
            self._sent.popleft()

    def check(self, now: float, readings: list[Reading], ticks: int) -> None:
        """Raises the error of the first reading that cannot be."""
        for joint, reading in zip(JOINTS, readings, strict=True):
            hot = OVERHEATED if reading.temperature > self.config.most_temperature else 0
            if status := reading.status | hot:
                raise ServoFault(joint, status)
        self._supply(readings)
        self._jumps(readings, ticks)
        for place, reading in enumerate(readings):
            self._frozen(now, place, reading)
            if self.config.check_load:
                self._follows(now, place, reading)

    def _supply(self, readings: list[Reading]) -> None:
        measured = sum(reading.voltage for reading in readings) / len(readings)
        # Currents make the voltage drop for a moment; the steps of 0.1 V are smoothed too.
        self._voltage = measured if self._voltage is None else self._voltage + 0.02 * (measured - self._voltage)
        if not self.config.least_supply <= self._voltage <= self.config.most_supply:
            raise WrongSupply(
                f"the supply is {self._voltage:.1f} V, outside {self.config.least_supply} to {self.config.most_supply} V"
            )

    @property
    def supply(self) -> float:
        if self.config.supply is not None:
            return self.config.supply
        return self.config.most_supply if self._voltage is None else self._voltage

    def _jumps(self, readings: list[Reading], ticks: int) -> None:
        positions = np.array([reading.position for reading in readings])
        if self._before is not None:
            # A few counts are noise of the encoder.
            most = self.config.most_speed * ticks / self.config.rate * (4096 / (2 * np.pi)) + 8
            jumped = np.abs(positions - self._before) > most
            if jumped.any():
                place = int(jumped.argmax())
                step = positions[place] - self._before[place]
                raise ImplausibleMotion(f"{JOINTS[place]} jumped by {step} counts within {ticks} ticks", JOINTS[place])
        self._before = positions

    def _frozen(self, now: float, place: int, reading: Reading) -> None:
        """A position that stands while the servo's own speed says that it moves."""
        frozen = self._frozen_since[place]
        # Slower than ten counts in this time, the noise of either could look like it.
        if abs(reading.speed) < 10.0 / self.config.stale_time:
            self._frozen_since[place] = None
        elif frozen is None or abs(reading.position - frozen[1]) > 1:
            self._frozen_since[place] = (now, reading.position)
        elif now - frozen[0] > self.config.stale_time:
            raise StaleServo(
                f"the servo of {JOINTS[place]} reports the speed {reading.speed} at one and the same position", JOINTS[place]
            )

    def _follows(self, now: float, place: int, reading: Reading) -> None:
        """A load that is none of the duties that the servo was sent lately."""
        if not self._sent:
            return
        sent = [steps[place] for _, steps in self._sent]
        tolerance = self.config.load_tolerance * DUTY_STEPS
        if min(sent) - tolerance <= reading.load <= max(sent) + tolerance:
            self._strange_since[place] = None
        elif self._strange_since[place] is None:
            self._strange_since[place] = now
        elif now - self._strange_since[place] > self.config.stale_time:
            raise StaleServo(
                f"the servo of {JOINTS[place]} reports the load {reading.load} and was commanded {min(sent)} to {max(sent)}",
                JOINTS[place],
            )
