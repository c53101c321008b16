"""An arm on a bench: its calibration, its bus, and the teleoperator that floats it."""

import json
from pathlib import Path

import numpy as np

from ..config_so101_floating import So101FloatingConfig
from ..motors import JOINTS
from ..so101_floating import So101Floating
from .bus import Bus
from .clock import Clock
from .servo import Servo

RANGES = ((796, 3298), (910, 3184), (946, 3148), (966, 3128), (0, 4095), (1500, 2751))
"""The ranges that a person records: the joints' ends, a full turn of the wrist, and the jaw's
110°."""
OFFSETS = (-800, 1200, 40, -1500, 300, 900)
SCENE_GEARS = (345.0,) * 6
TICK = 0.005


def run(teleoperator, ticks):
    """Runs so many ticks of the loop."""
    for _ in range(ticks):
        teleoperator.tick()


def servos(gears, supply=7.4):
    """Six servos as a calibration leaves them."""
    made = []
    for place in range(6):
        servo = Servo(place + 1, gears[place], OFFSETS[place], supply)
        least, most = RANGES[place]
        servo.calibrate(OFFSETS[place], least, most)
        # The jaw's lower end, −0.174533 rad, is the lower end of its range.
        servo.zero = (least + most) // 2 if place < 5 else least + round(0.174533 * 4096 / (2 * np.pi))
        servo.refresh()
        made.append(servo)
    return made


def calibration():
    """The file that LeRobot writes of it."""
    return {
        joint: {
            "id": place + 1,
            "drive_mode": 0,
            "homing_offset": OFFSETS[place],
            "range_min": RANGES[place][0],
            "range_max": RANGES[place][1],
        }
        for place, joint in enumerate(JOINTS)
    }


class Bench:
    """A clock, buses and teleoperators that are closed after it."""

    def __init__(self, folder: Path, clock: Clock | None = None):
        self.folder, self.clock = folder, clock or Clock()
        self.file = folder / "bench.json"
        self.write(calibration())
        self.buses, self.teleoperators = [], []

    def write(self, entries) -> None:
        self.file.write_text(json.dumps(entries))

    def bus(self, arm, gears=SCENE_GEARS, step=TICK, supply=7.4, terminal=False) -> Bus:
        bus = Bus(self.folder, arm, servos(gears, supply), self.clock, step, terminal)
        self.buses.append(bus)
        return bus

    def config(self, bus, **options):
        settings = {"background": False, "guardian": False, "gears": SCENE_GEARS, "release_time": 0.2, "wrist_roll_zero": 0.0}
        settings |= options
        return So101FloatingConfig(id="bench", calibration_dir=self.folder, port=bus.port, **settings)

    def teleoperator(self, bus, **options):
        """Not yet connected; without a thread, its ticks come at its rate."""
        teleoperator = So101Floating(self.config(bus, **options))
        teleoperator.clock = self.clock
        if not teleoperator.config.background:
            tick, due = teleoperator.tick, 0.0

            def in_time():
                nonlocal due
                due = max(due + TICK, self.clock.now())
                self.clock.sleep(due - self.clock.now())
                tick()

            teleoperator.tick = in_time
        self.teleoperators.append(teleoperator)
        return teleoperator

    def floating(self, arm, gears=SCENE_GEARS, **options):
        """A bus and a connected teleoperator on it."""
        bus = self.bus(arm, gears)
        teleoperator = self.teleoperator(bus, gears=gears, **options)
        teleoperator.connect(calibrate=False)
        return bus, teleoperator

    def close(self) -> None:
        for teleoperator in self.teleoperators:
            teleoperator._stop_thread()
            teleoperator._torque_may_be_on = False
            teleoperator._close()
        for bus in self.buses:
            bus.close()
