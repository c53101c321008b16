"""Forward dynamics of the simulated arm, from the wheel: the effects of the scene `so101_teach`."""

import robot_dynamics as rd
from lerobot_teleoperator_so101_floating.motors import WIDTH, Motors


def forward_dynamics(gears, friction: float = 1.0):
    """Accelerations at positions, velocities and torques; `friction` scales all of it."""
    motors, robot = Motors(tuple(gears)), rd.Robot("so101")
    effects = rd.Scene(
        rd.RIGID_BODY,
        rd.Viscous(friction * motors.viscous),
        rd.Coulomb(friction * motors.coulomb, WIDTH),
        rd.Armature(motors.armature),
        rd.LoadFriction(friction * motors.driving, friction * motors.backdriving, WIDTH),
    )
    return lambda q, qd, torque: robot.forward_dynamics(q, qd, torque, effects)
