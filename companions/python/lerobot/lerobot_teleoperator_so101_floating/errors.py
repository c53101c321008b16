"""The errors of this package, by type. After each the arm is lowered, and then the attribute
`released` says whether the servos confirmed that their torque is off."""


class FloatingError(RuntimeError):
    """Base of all errors of this package.

    `joint` is the joint concerned, or None. `released` is True once all six servos have confirmed
    that their torque is off, False if at least one has not, and None if the torque had not been
    switched on, or while the arm comes down.
    """

    def __init__(self, message: str, joint: str | None = None):
        super().__init__(message)
        self.joint = joint
        self.released: bool | None = None

    def __str__(self) -> str:
        text = super().__str__()
        if self.released is False:
            text += "; THE SERVOS DID NOT CONFIRM THAT THEIR TORQUE IS OFF: switch off their supply"
        return text


class BusLost(FloatingError, ConnectionError):
    """The port failed, or no servo replied several times in a row."""


class WrongServos(FloatingError):
    """At connection a servo is missing, is of another model, or has another firmware than the
    others."""


class ServoSilent(FloatingError):
    """One servo did not reply several times in a row, while others did."""


class CorruptReplies(FloatingError):
    """Replies of a servo came with a wrong checksum several times in a row."""


class StaleServo(FloatingError):
    """A servo replies, but with old values: they contradict each other, or do not follow what it is
    commanded."""


class ServoFault(FloatingError):
    """A servo reports a fault; `status` has a bit for each: 0 voltage, 1 encoder, 2 temperature, 3
    current, 5 load."""

    def __init__(self, joint: str, status: int):
        names = {0: "voltage", 1: "encoder", 2: "temperature", 3: "current", 5: "load"}
        faults = [names.get(bit, f"bit {bit}") for bit in range(8) if status >> bit & 1]
        super().__init__(f"the servo of {joint} reports: {', '.join(faults)}", joint)
        self.status = status


class WrongCalibration(FloatingError):
    """The calibration cannot be that of this arm, or the servos do not have it."""


class WrongConfiguration(FloatingError, ValueError):
    """A number of the configuration is not possible, or a servo did not take a setting."""


class WrongSupply(FloatingError):
    """The supply's voltage is outside the range for which the model of the motors holds."""


class JointOutOfRange(FloatingError):
    """A joint is beyond its limits, where the calibration or the reading must be wrong."""


class ImplausibleMotion(FloatingError):
    """A joint moves faster than allowed, or its position jumped."""


class LoopLate(FloatingError):
    """The loop did not run for too long; the servos held their last command meanwhile."""


class DynamicsFailed(FloatingError):
    """The model gave torques that are not finite, or raised an error."""
