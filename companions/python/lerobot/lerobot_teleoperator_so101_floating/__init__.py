"""An SO-101 leader arm that floats, in LeRobot: `--teleop.type=so101_floating`."""

from . import errors
from .config_so101_floating import So101FloatingConfig
from .errors import *
from .follower import FollowerLoad
from .so101_floating import So101Floating

__all__ = ["FollowerLoad", "So101Floating", "So101FloatingConfig", *(name for name in vars(errors) if name[0].isupper())]
