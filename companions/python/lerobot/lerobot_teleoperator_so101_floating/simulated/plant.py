"""Forward dynamics of the simulated arm, from the wheel: the effects of the scene `so101_teach`."""

import numpy as np
import robot_dynamics as rd

from ..motors import WIDTH, Motors


def forward_dynamics(gears, friction: float = 1.0, width: float = WIDTH):
    """Accelerations at positions, velocities and torques; `friction` scales all of it, and fades below
    the speed `width`, rad/s."""
    motors, robot = Motors(tuple(gears)), rd.Robot("so101")
    effects = rd.Scene(
        rd.RIGID_BODY,
        rd.Viscous(friction * motors.viscous),
        rd.Coulomb(friction * motors.coulomb, width),
        rd.Armature(motors.armature),
        rd.LoadFriction(friction * motors.driving, friction * motors.backdriving, width),
    )

    def accelerations(q, qd, torque):
        return robot.aba(q, qd, torque, effects)

    # Forward and inverse dynamics of the wheel agree on the friction of gears.
    q, qd, torque = np.linspace(-0.8, 0.9, 6), np.linspace(0.5, -0.6, 6), np.linspace(-0.7, 1.0, 6)
    back = robot.rnea(q, qd, accelerations(q, qd, torque), effects)
    assert np.abs(back - torque).max() < 1e-9, back - torque
    return accelerations
