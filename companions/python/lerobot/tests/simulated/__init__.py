"""An SO-101 in simulated time: servos that speak the Feetech protocol byte by byte, and the arm
that they move."""

from .arm import Arm, Still
from .bus import Bus
from .clock import Clock
from .port import LINES, Remote, install
from .servo import Servo

__all__ = ["LINES", "Arm", "Bus", "Clock", "Remote", "Servo", "Still", "install"]
