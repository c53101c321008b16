"""An SO-101 on a pseudo-terminal: servos that speak the Feetech protocol byte by byte, and the arm that they move."""

from .arm import Arm, Still
from .bus import Bus
from .servo import Servo

__all__ = ["Arm", "Bus", "Servo", "Still"]
