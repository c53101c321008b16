"""The arm's torques, from the wheel `robot_dynamics`: none is computed here."""

from collections.abc import Callable

import numpy as np

from .calibration import LOWER, UPPER
from .errors import WrongConfiguration
from .motors import JOINTS, WIDTH, Motors

Dynamics = Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]
"""The torques of gravity and of friction at positions and velocities, N·m."""


def floating_dynamics(motors: Motors, urdf: str | None) -> Dynamics:
    """The dynamics of the library's SO-101, or of the description in this file, with friction as
    that of the scene `so101_teach`."""
    import robot_dynamics as rd

    try:
        robot = rd.Robot("so101") if urdf is None else rd.Robot.from_file(urdf)
    except rd.RobotDynamicsError as error:
        raise WrongConfiguration(f"{urdf} is no description of an arm: {error}") from error
    # The library's robot names its joints by their links.
    if urdf is not None and tuple(robot.joints) != JOINTS:
        raise WrongConfiguration(f"{urdf} has the joints {robot.joints} in place of {list(JOINTS)}")
    if not np.allclose([robot.lower_limits, robot.upper_limits], [LOWER, UPPER], atol=0.2):
        # Such as those of the SO-100's description: gravity would be that of another posture.
        raise WrongConfiguration(f"{urdf} has other limits of its joints than an SO-101, and so other zeros of their angles")
    gravity = rd.Gravity()
    friction = rd.Scene(
        rd.Viscous(motors.viscous),
        rd.Coulomb(motors.coulomb, WIDTH),
        rd.LoadFriction(motors.driving, motors.backdriving, WIDTH),
    )
    both, still = rd.Scene(gravity, friction), np.zeros(6)

    def torques(q: np.ndarray, qd: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        weight = robot.rnea(q, still, still, gravity)
        # The friction of the gears depends on the weight that they carry.
        return weight, robot.rnea(q, qd, still, both) - weight

    return torques
