"""Robot dynamics over numpy arrays, in float64 and in float32 with the bits of firmware.

>>> import robot_dynamics as rd
>>> arm = rd.Robot("ur5e")
>>> tau = arm.rnea([0.0, -1.2, 1.5, 0.3, 0.7, 0.0], [0.5] * 6, [1.0] * 6)  # N·m
>>> tau.shape
(6,)
"""

from . import errors
from ._native import *  # noqa: F403
from .errors import *  # noqa: F403
