"""An SO-101 leader arm that floats, as a teleoperator of LeRobot:
`--teleop.type=so101_floating`."""

from .config_so101_floating import So101FloatingConfig
from .errors import (
    BusLost,
    CorruptReplies,
    DynamicsFailed,
    FloatingError,
    ImplausibleMotion,
    JointOutOfRange,
    LoopLate,
    ServoFault,
    ServoSilent,
    StaleServo,
    WrongCalibration,
    WrongConfiguration,
    WrongServos,
    WrongSupply,
)
from .follower import FollowerLoad
from .so101_floating import So101Floating

__all__ = [
    "BusLost",
    "CorruptReplies",
    "DynamicsFailed",
    "FloatingError",
    "FollowerLoad",
    "ImplausibleMotion",
    "JointOutOfRange",
    "LoopLate",
    "ServoFault",
    "ServoSilent",
    "So101Floating",
    "So101FloatingConfig",
    "StaleServo",
    "WrongCalibration",
    "WrongConfiguration",
    "WrongServos",
    "WrongSupply",
]
