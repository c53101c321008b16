"""The errors of this package: each names the file, line, joint, body, argument or effect concerned."""

from __future__ import annotations

from typing import Any

__all__ = [
    "AngleError",
    "ArgumentError",
    "DescriptionError",
    "DtypeError",
    "EffectError",
    "LinkageError",
    "LoopModelError",
    "LoopOpen",
    "ModeError",
    "ModelError",
    "MultiDofJoint",
    "NoAttitude",
    "NoEngine",
    "NotFinite",
    "NotPositiveDefinite",
    "NotRecorded",
    "RobotDynamicsError",
    "ShapeError",
    "UnderActuated",
    "UnknownBody",
    "UnknownCoordinate",
    "UnknownFrame",
    "UnknownRobot",
    "UnreadableFile",
]


class RobotDynamicsError(Exception):
    """The base of all errors of this package."""

    def __init__(self, message: str, **fields: Any) -> None:
        super().__init__(message)
        for name, value in fields.items():
            setattr(self, name, value)

    def __str__(self) -> str:
        return str(self.args[0]) if self.args else ""


class DescriptionError(RobotDynamicsError, ValueError):
    """A URDF or MJCF that cannot be used."""

    line: int | None
    """The line of the file, from 1; none if no line is concerned."""
    element: str
    """The element and its name, such as ``joint `elbow` ``; empty if none is concerned."""
    problem: str
    """The problem without its place."""


class UnreadableFile(DescriptionError, OSError):
    """A file that the operating system does not give."""


class ModelError(RobotDynamicsError, ValueError):
    """A robot that the library refuses: too large, or with impossible numbers."""

    body: str | None
    """The body concerned."""


class NoEngine(RobotDynamicsError, LookupError):
    """The wheel has no engine of this robot, or no form of this name."""

    robot: str
    """The robot's name."""


class UnknownRobot(RobotDynamicsError, LookupError):
    """No robot of the library has this name."""

    name: str
    """The name."""


class UnknownBody(RobotDynamicsError, LookupError):
    """The robot has no body of this name or number."""

    body: str | int
    """The name or number."""


class UnknownFrame(RobotDynamicsError, ValueError):
    """No frame has this name."""

    frame: str
    """The name."""


class ShapeError(RobotDynamicsError, ValueError):
    """An array of the wrong shape."""

    argument: str
    """The argument concerned."""
    shape: tuple[int, ...]
    """Its shape."""
    expected: str
    """What is expected."""


class ArgumentError(RobotDynamicsError, TypeError, ValueError):
    """An argument that is not of its type, such as a list of two numbers for a direction."""

    given: Any
    """What was given."""


class DtypeError(RobotDynamicsError, TypeError):
    """An array that is neither all float32 nor all float64, or no array of numbers."""

    argument: str
    """The argument concerned."""


class EffectError(RobotDynamicsError, ValueError):
    """An effect that a scene or a robot cannot have."""

    effect: str
    """The effect's name."""


class NotPositiveDefinite(RobotDynamicsError, ArithmeticError):
    """M is not positive definite: a joint moves no inertia, or a number overflows."""

    joint: str
    """The joint's name."""
    coordinate: int
    """The velocity coordinate."""
    state: int
    """The state's index in the batch; 0 of a single state."""


class MultiDofJoint(RobotDynamicsError, ValueError):
    """A joint of several degrees of freedom, of which no transmission is known."""

    joint: str
    """The joint's name."""
    state: int
    """The state's index in the batch; 0 of a single state."""


class AngleError(RobotDynamicsError, ValueError):
    """An angle beyond the range in which sines are computed, where its whole turns matter."""

    joint: str
    """The joint's name; that of the linkage, where it is an angle of a linkage."""
    coordinate: int | None
    """The velocity coordinate; none of a linkage."""
    angle: float
    """The angle, rad."""
    limit: float
    """The largest angle, rad."""
    state: int
    """The state's index in the batch; 0 of a single state."""


class NoAttitude(RobotDynamicsError, ValueError):
    """A quaternion of length zero, or so small that its square is."""

    joint: str
    """The joint's name."""
    state: int
    """The state's index in the batch; 0 of a single state."""


class UnknownCoordinate(RobotDynamicsError, LookupError):
    """The robot has no velocity coordinate of this number."""

    coordinate: int
    """The number."""


class LoopModelError(RobotDynamicsError, ValueError):
    """Loops that cannot be described so."""

    loop: str
    """The loop's name; the robot's, where the whole is concerned."""


class LoopOpen(RobotDynamicsError, ArithmeticError):
    """A loop is open: its ends are not where its joint would have them."""

    loop: str
    """The loop's name."""
    error: float
    """By how much, relative to the loop's size."""
    state: int
    """The state's index in the batch; 0 of a single state."""


class UnderActuated(RobotDynamicsError, ArithmeticError):
    """A coordinate moves although all motors are held."""

    loop: str
    """The loop that it moves in; the robot, if it moves in none."""
    joint: str
    """The joint's name."""
    state: int
    """The state's index in the batch; 0 of a single state."""


class NotFinite(RobotDynamicsError, ArithmeticError):
    """A number of a loop overflows: one that is given as NaN or infinite marks its row instead."""

    loop: str
    """The loop's name."""
    state: int
    """The state's index in the batch; 0 of a single state."""


class LinkageError(RobotDynamicsError, ValueError):
    """A linkage that cannot be described so, or that has no motion in a state."""

    linkage: str
    """The linkage's name."""
    state: int | None
    """The state's index in the batch; none where the description is concerned."""


class ModeError(RobotDynamicsError, ValueError):
    """Modes of a link that cannot be used, or that have no motion in a state."""

    link: str | None
    """The link's name; the robot's, where no link is concerned."""
    mode: int | None
    """The mode's number: among those of the link, in a state among all."""
    state: int | None
    """The state's index in the batch; none where the description is concerned."""


class NotRecorded(RobotDynamicsError, LookupError):
    """No figure of this robot and algorithm is recorded."""

    robot: str
    """The robot's name."""
