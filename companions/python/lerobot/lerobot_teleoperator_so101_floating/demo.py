"""The floating arm without hardware: it floats, is pushed, and comes down, on a simulated bus.

    python -m lerobot_teleoperator_so101_floating.demo [--fast]
"""

import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from .motors import JOINTS, LEADER_GEARS
from .simulated import TICK, Arm, Bench, Clock, install, run

POSTURE = np.array([0.0, -0.6, 0.6, 0.5, 0.0, 0.3])


class Watched(Clock):
    """A clock that keeps pace with the machine's, unless it is fast, and prints the arm four times a
    second."""

    def __init__(self, fast: bool):
        super().__init__()
        self.fast, self.begin, self.due = fast, time.monotonic(), 0.0
        self.arm, self.doing = Arm(POSTURE, LEADER_GEARS, width=0.01), "connects"

    def sleep(self, seconds: float) -> None:
        super().sleep(seconds)
        if self.seconds >= self.due:
            self.due = self.seconds + 0.25
            if not self.fast:
                time.sleep(max(self.seconds - (time.monotonic() - self.begin), 0.0))
            angles = "".join(f"{angle:14.1f}" for angle in np.degrees(self.arm.q))
            print(f"{self.seconds:6.2f}{angles}  {self.doing}", flush=True)


def main() -> None:
    install()
    clock = Watched("--fast" in sys.argv[1:])
    arm = clock.arm
    print("     s" + "".join(f"{joint:>14}" for joint in JOINTS) + "  degrees")
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(Path(folder), clock)
        arm.hand = lambda q, qd, time: 20.0 * (POSTURE - q) - qd
        _, teleoperator = bench.floating(arm, LEADER_GEARS)
        hands = {
            "is held while its torque rises": (1.2, arm.hand),
            "floats": (2.0, lambda q, qd, time: np.zeros(6)),
            "is pushed": (0.6, lambda q, qd, time: np.array([0.15, 0.0, 0.15, 0.0, 0.0, 0.0])),
            "floats where it was pushed to": (2.0, lambda q, qd, time: np.zeros(6)),
        }
        for clock.doing, (seconds, arm.hand) in hands.items():
            run(teleoperator, round(seconds / TICK))
        clock.doing = "comes down"
        teleoperator.disconnect()
        clock.doing, down = "its torque is off", arm.q.copy()
        bench.buses[0].advance(1.0)
        bench.close()
    print(f"fell by {np.degrees(np.abs(arm.q - down)).max():.1f}° once its torque was off")


if __name__ == "__main__":
    main()
