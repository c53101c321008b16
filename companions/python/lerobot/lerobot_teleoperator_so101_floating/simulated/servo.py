"""One simulated STS3215: its registers, and the motor that they command.

Written from Feetech's protocol manual and memory table, not with the plug-in's code: what the two
understand differently, the tests find.
"""

import math

COUNTS = 4096
RADIANS = math.tau / COUNTS
MODEL = 777
POSITION_MODE, PWM_MODE = 0, 2

# Source: as `motors.py` of the plug-in, the numbers of the scene so101_teach.
TORQUE_CONSTANT, RESISTANCE = 1.2116414, 2.6761663
DUTY_PER_GAIN = 0.166
"""Duty per error of position and unit of the gain P, 1/rad."""


def signed(value: int, bit: int) -> int:
    return -(value & (1 << bit) - 1) if value >> bit & 1 else value


class Servo:
    """Registers by address; positions come from the arm, the motor's torque goes to it."""

    def __init__(self, identity: int, gear: float = 345.0, mounting: int = 0, supply: float = 7.4):
        self.registers = bytearray(128)
        self.ratio = gear / 345.0
        self.supply = supply
        self.mounting = mounting
        """The encoder's count at the joint's zero, less half a turn."""
        self.frozen: bytes | None = None
        """Registers that the servo replies with while it is stale."""
        self.silent = False
        """The servo obeys, and its replies get lost."""
        self.powered = True
        self.angle, self.speed = 0.0, 0.0
        self.zero = COUNTS // 2 - 1
        """The count that the joint's zero has after a right calibration."""
        self.set(0, 3, 1)
        self.set(1, 10, 1)
        self.set(3, MODEL, 2)
        self.set(5, identity, 1)
        self.set(7, 250, 1)
        self.set(8, 1, 1)
        self.set(11, COUNTS - 1, 2)
        self.set(13, 70, 1)
        self.set(16, 1000, 2)
        self.set(18, 12, 1)
        self.set(21, 32, 1)
        self.set(48, 1000, 2)
        self.set(55, 1, 1)
        self.set(63, 30, 1)
        self.refresh()

    def get(self, address: int, length: int = 2) -> int:
        return int.from_bytes(self.registers[address : address + length], "little")

    def set(self, address: int, value: int, length: int = 2) -> None:
        self.registers[address : address + length] = value.to_bytes(length, "little")

    def signed(self, address: int, bit: int) -> int:
        return signed(self.get(address), bit)

    def signed_frozen(self, address: int, bit: int) -> int:
        """As `signed`, of what a stale servo replies."""
        return signed(int.from_bytes(self.frozen[address : address + 2], "little"), bit)

    def set_signed(self, address: int, value: int, bit: int) -> None:
        self.set(address, min(abs(value), (1 << bit) - 1) | (value < 0) << bit)

    @property
    def identity(self) -> int:
        return self.registers[5]

    @property
    def torque_enabled(self) -> bool:
        return self.registers[40] != 0

    def calibrate(self, offset: int, least: int, most: int) -> None:
        self.set_signed(31, offset, 11)
        self.set(9, least)
        self.set(11, most)

    def write(self, address: int, data: bytes) -> None:
        if not self.powered or address in (0, 1, 3, 4) or 56 <= address <= 70:
            return  # The latter are read-only.
        self.registers[address : address + len(data)] = data

    def read(self, address: int, length: int) -> bytes:
        source = self.registers if self.frozen is None else self.frozen
        return bytes(source[address : address + length])

    def cut(self) -> None:
        """The cable to the servo breaks: no bus and no supply, and the registers are what they are
        after one."""
        self.silent, self.powered = True, False
        self.registers[40] = 0

    def freeze(self) -> None:
        """From now on the servo replies with what its registers were, while its motor goes on."""
        self.frozen = bytes(self.registers)

    def move(self, angle: float, speed: float) -> None:
        """Sets the joint's angle, rad, and its speed, rad/s."""
        self.angle, self.speed = angle, speed
        self.refresh()

    def refresh(self) -> None:
        actual = round(self.angle / RADIANS) + self.zero + self.mounting
        # With bit 4 of the phase the servo counts on over turns: it has made one.
        present = actual - self.signed(31, 11) + (COUNTS if self.registers[18] & 0x10 else 0)
        self.set_signed(56, present, 15)
        self.set_signed(58, round(self.speed / RADIANS), 15)
        self.set_signed(60, round(1000 * self.duty()), 10)
        self.set(62, round(10 * self.supply), 1)

    def duty(self) -> float:
        """The share of the supply that the motor gets."""
        if not self.torque_enabled:
            return 0.0
        limit = self.get(48) / 1000.0
        mode = self.registers[33]
        if mode == PWM_MODE:
            duty = self.signed(44, 10) / 1000.0
        elif mode == POSITION_MODE:
            error = (self.signed(42, 15) - self.signed(56, 15)) * RADIANS
            duty = self.registers[21] * DUTY_PER_GAIN * error
        else:
            duty = 0.0
        return max(-limit, min(limit, duty))

    def motor(self) -> tuple[float, float]:
        """The motor's constant at the joint, N·m/A, and its voltage, V, until a register changes;
        without power the bridge is open and the motor turns free, as one without a constant."""
        if not self.torque_enabled:
            return 0.0, 0.0
        return TORQUE_CONSTANT * self.ratio, self.duty() * self.supply
