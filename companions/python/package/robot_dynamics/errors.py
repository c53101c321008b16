"""The errors of this package: each names what is concerned in its fields.

Names are those of the robot. ``state`` is the index of the state in its batch, 0 of a single state,
and None where a description is concerned; ``coordinate`` is a velocity coordinate.
"""

from __future__ import annotations

from typing import Any

__all__ = [
    "AngleError",
    "ArgumentError",
    "DescriptionError",
    "DtypeError",
    "EffectError",
    "IdentificationError",
    "LinkageError",
    "LoopModelError",
    "LoopOpen",
    "MissingFile",
    "ModeError",
    "ModelError",
    "MotionError",
    "MotorError",
    "MultiDofJoint",
    "NoAttitude",
    "NotFinite",
    "NotPositiveDefinite",
    "NotRecorded",
    "PoseNotReached",
    "RobotDynamicsError",
    "SensorLoadError",
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


class UnreadableFile(DescriptionError, OSError):
    """A file that the operating system does not give."""


class MissingFile(UnreadableFile, FileNotFoundError):
    """A file that does not exist."""


class ModelError(RobotDynamicsError, ValueError):
    """A robot that the library refuses: too large, or with impossible numbers."""

    body: str | None


class UnknownRobot(RobotDynamicsError, LookupError):
    """No robot of the library has this name."""

    name: str


class UnknownBody(RobotDynamicsError, LookupError):
    """The robot has no body of this name or number."""

    body: str | int


class UnknownFrame(RobotDynamicsError, ValueError):
    """No frame has this name."""

    frame: str


class ShapeError(RobotDynamicsError, ValueError):
    """An array of the wrong shape."""

    argument: str
    shape: tuple[int, ...]
    expected: str


class ArgumentError(RobotDynamicsError, TypeError, ValueError):
    """An argument that is not of its type, such as a list of two numbers for a direction."""

    given: Any


class DtypeError(RobotDynamicsError, TypeError):
    """An array that is neither float32 nor float64 nor of integers, or arrays of both."""

    argument: str


class EffectError(RobotDynamicsError, ValueError):
    """An effect that a scene or a robot cannot have."""

    effect: str


class IdentificationError(RobotDynamicsError, ValueError):
    """A robot or a recording from which no parameters follow."""


class NotPositiveDefinite(RobotDynamicsError, ArithmeticError):
    """M is not positive definite: a joint moves no inertia, or a number overflows."""

    joint: str
    coordinate: int
    state: int


class MultiDofJoint(RobotDynamicsError, ValueError):
    """A joint of several degrees of freedom, of which no transmission is known."""

    joint: str
    state: int


class AngleError(RobotDynamicsError, ValueError):
    """An angle beyond the range in which sines are computed, rad, where its whole turns matter."""

    joint: str
    """The joint's name; that of the linkage, where it is an angle of a linkage."""
    coordinate: int | None
    angle: float
    limit: float
    state: int


class NoAttitude(RobotDynamicsError, ValueError):
    """A quaternion of length zero, or so small that its square is."""

    joint: str
    state: int


class UnknownCoordinate(RobotDynamicsError, LookupError):
    """The robot has no velocity coordinate of this number."""

    coordinate: int


class LoopModelError(RobotDynamicsError, ValueError):
    """Loops that cannot be described so."""

    loop: str
    """The loop's name; the robot's, where the whole is concerned."""


class LoopOpen(RobotDynamicsError, ArithmeticError):
    """A loop is open: its ends are not where its joint would have them."""

    loop: str
    error: float
    """By how much, relative to the loop's size."""
    state: int


class UnderActuated(RobotDynamicsError, ArithmeticError):
    """A coordinate moves although all motors are held."""

    loop: str
    """The loop that it moves in; the robot, if it moves in none."""
    joint: str
    state: int


class NotFinite(RobotDynamicsError, ArithmeticError):
    """A number of a loop overflows: one that is given as NaN or infinite marks its row instead."""

    loop: str
    state: int


class LinkageError(RobotDynamicsError, ValueError):
    """A linkage that cannot be described so, or that has no motion in a state."""

    linkage: str
    state: int | None


class ModeError(RobotDynamicsError, ValueError):
    """Modes of a link that cannot be used, or that have no motion in a state."""

    link: str | None
    """The link's name; the robot's, where no link is concerned."""
    mode: int | None
    """The mode's number: among those of the link, in a state among all."""
    state: int | None


class SensorLoadError(RobotDynamicsError, ValueError):
    """Poses at rest from which no load of a sensor follows."""

    poses: int


class MotorError(RobotDynamicsError, ValueError):
    """A motor whose numbers a thermal limit refuses."""

    joint: int | None
    """The number of its joint; none where all are concerned."""


class MotionError(RobotDynamicsError, ValueError):
    """A number of a goal, of a tip's motion or of its inverse kinematics that is refused."""

    joint: int | None
    """The number of its joint; none where all are concerned."""


class PoseNotReached(RobotDynamicsError, ValueError):
    """A pose that is out of reach, or nearly so."""

    q: list[float]
    """The positions of the nearest pose that was found."""


class NotRecorded(RobotDynamicsError, LookupError):
    """No figure of this robot and algorithm is recorded."""

    robot: str
