"""An SO-101 in simulated time: servos that speak the Feetech protocol byte by byte, and the arm
that they move. The tests run on it, and `demo`."""

from .arm import Arm, Still
from .bench import SCENE_GEARS, TICK, Bench, calibration, run
from .bus import Bus
from .clock import Clock
from .port import LINES, Remote, install
from .servo import Servo
