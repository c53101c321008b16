"""The configuration of the floating leader. On LeRobot's command line each field is
`--teleop.FIELD=…`."""

import math
from dataclasses import dataclass, field, fields

from lerobot.teleoperators.config import TeleoperatorConfig

from .errors import WrongConfiguration
from .motors import LEADER_GEARS


@TeleoperatorConfig.register_subclass("so101_floating")
@dataclass(kw_only=True)
class So101FloatingConfig(TeleoperatorConfig):
    """An SO-101 leader on a serial port.

    Torques are in N·m at the joint, speeds in rad/s, times in s.
    """

    port: str
    """The serial port; one under /dev/serial/by-id stays the same when the adapter is plugged in
    again."""
    use_degrees: bool = True
    """Actions in degrees, as LeRobot's so101_leader; otherwise from −100 to 100."""

    gears: tuple[float, float, float, float, float, float] = LEADER_GEARS
    """Reductions of the servos; six times 345 if the leader is built of a follower's servos."""
    wrist_roll_zero: float | None = None
    """The angle that LeRobot gives `wrist_roll`, in degrees, while the axis of the jaw is level and
    the moving jaw on top: 0 if it stood so when it was calibrated. The full turn that LeRobot
    records says nothing of it."""
    supply: float | None = None
    """The supply's voltage, V; None takes what the servos measure, in steps of 0.1 V."""
    least_supply: float = 4.5
    most_supply: float = 8.4
    urdf: str | None = None
    """A description of the arm in place of the SO-101's, with the same six joints."""
    gravity_scale: tuple[float, float, float, float, float, float] = field(default=(1.0,) * 6)
    """Factors of each joint's gravity torque, for a leader whose handle is heavier or lighter than
    the model's."""

    rate: float = 200.0
    """The number of ticks per second."""
    bandwidth: float = 30.0
    """The bandwidth of the observer that estimates velocities, rad/s."""
    friction_share: float = 0.87
    """The share σ of the modelled friction that is compensated, at most 1/(1 + friction_error); 0
    compensates gravity alone."""
    friction_error: float = 0.1
    """The share ε by which the modelled friction exceeds the true one at most."""
    gravity_error: float = 0.03
    """The share by which the modelled gravity may be off: by so much less is friction
    compensated."""
    rest_speed: float = 0.03
    most_friction: float = 0.5

    wall_stiffness: float = 5.0
    wall_damping: float = 0.1
    wall_torque: float = 0.4
    wall_margin: float = 0.05
    """The walls stand this far inside the limits of the joints, rad."""

    feedback_gain: float = 0.3
    feedback_dead_band: float = 0.05
    feedback_torque: float = 0.3
    feedback_timeout: float = 0.25

    torque_limit: float = 1.6
    """The greatest torque of a joint; gravity takes at most about 0.9 of a stretched arm."""
    torque_rate: float = 20.0
    """The greatest change of a joint's torque, N·m/s."""
    most_duty: float = 0.97
    ramp: float = 1.0
    """The time in which the torque rises from zero after it was switched on."""

    most_speed: float = 10.0
    beyond_limits: float = 0.2
    """The most that a joint may be beyond its limits, rad."""
    most_misses: int = 3
    """Ticks in a row in which a servo may fail to reply."""
    reply_time: float = 0.01
    """The time that a tick waits for the servos' replies, s."""
    most_age: float = 0.15
    """The oldest measurement that may still be acted on."""
    stale_time: float = 0.15
    """The time for which a servo may contradict itself or its commands, s."""
    check_load: bool = True
    """Whether the load that a servo reports must follow the duty that it is commanded, as Feetech's
    memory table states."""
    load_tolerance: float = 0.02
    most_temperature: int = 65
    release_time: float = 1.0
    """The time, s, for which a bus that is lost is tried anew; the guardian goes on after that."""
    guardian: bool = True
    """A second process that lowers the arm if this one ends without having done so, killed for
    instance."""
    background: bool = True
    """A thread runs the loop. Without it whoever holds the teleoperator calls `tick()` at the
    rate."""

    def __post_init__(self):
        for name in ("gears", "gravity_scale"):
            numbers = tuple(float(x) for x in getattr(self, name))
            setattr(self, name, numbers)
            if len(numbers) != 6 or not all(math.isfinite(x) and x > 0.0 for x in numbers):
                raise WrongConfiguration(f"{name} has to have six numbers above zero")
        zero_is_possible = {
            "friction_share", "friction_error", "gravity_error", "most_friction", "wall_stiffness", "wall_damping", "wall_torque",
            "wall_margin", "feedback_gain", "feedback_dead_band", "feedback_torque", "ramp",
        }  # fmt: skip
        for each in fields(self):
            value = getattr(self, each.name)
            if isinstance(value, bool) or not isinstance(value, (int, float)):
                continue
            least = -180.0 if each.name == "wrist_roll_zero" else 0.0 if each.name in zero_is_possible else math.ulp(0.0)
            if not (math.isfinite(value) and value >= least):
                raise WrongConfiguration(f"{each.name} is not possible: {value}")
        if self.friction_share * (1.0 + self.friction_error) > 1.0 + 1e-9:
            raise WrongConfiguration("friction_share exceeds 1/(1 + friction_error): more than the friction would be compensated")
        if self.most_duty > 1.0 or self.gravity_error >= 1.0:
            raise WrongConfiguration("most_duty is at most 1, gravity_error less")
        if self.least_supply >= self.most_supply:
            raise WrongConfiguration("least_supply is not below most_supply")
