"""The bytes of the Feetech bus that the loop needs, on a port that LeRobot's `FeetechMotorsBus` has
opened.

The SDK under `FeetechMotorsBus` reads one register of all servos and stops at the first that does
not reply, without saying which; it drops the status that a reply carries, and takes replies that
came late for those to the next request. The loop needs six registers at once, from every servo that
replies, and the reason of each that did not. Everything that is done once, at connection, is left
to `FeetechMotorsBus`.

Source: Feetech, "Communication Protocol User Manual", and the memory table of the magnetic STS
servos. Signs are one bit above the magnitude: bit 15 of position and speed, bit 10 of duty and
load.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass

import serial

try:
    import termios
except ImportError:  # Not a POSIX system.
    termios = None

# The errors that a port raises when its adapter is gone: `termios.error` is no `OSError`, and
# pyserial lets it pass.
PORT_ERRORS = (OSError, serial.SerialException) + ((termios.error,) if termios else ())

HEADER = b"\xff\xff"
BROADCAST = 0xFE
READ, WRITE, SYNC_READ, SYNC_WRITE = 0x02, 0x03, 0x82, 0x83

PHASE = 18
OPERATING_MODE = 33
TORQUE_ENABLE = 40
GOAL_DUTY = 44
"""In the PWM mode; LeRobot's table calls it Goal_Time, its name in the position mode."""
PRESENT = 56
PRESENT_LENGTH = 10
"""Position, speed, load (two bytes each), voltage, temperature, a flag, status."""

PWM_MODE = 2
REVERSED, COUNTS_TURNS = 0b1000_0001, 0b1_0000
"""Bits of the phase: one reverses the drive, one the position; the position counts on over turns."""
POSITION_SIGN, DUTY_SIGN = 15, 10


def checksum(body: bytes) -> int:
    return ~sum(body) & 0xFF


def packet(servo: int, instruction: int, parameters: bytes) -> bytes:
    body = bytes([servo, len(parameters) + 2, instruction]) + parameters
    return HEADER + body + bytes([checksum(body)])


def sync_read(servos: list[int], address: int, length: int) -> bytes:
    return packet(BROADCAST, SYNC_READ, bytes([address, length, *servos]))


def sync_write(address: int, values: dict[int, bytes]) -> bytes:
    length = len(next(iter(values.values())))
    data = b"".join(bytes([servo]) + value for servo, value in values.items())
    return packet(BROADCAST, SYNC_WRITE, bytes([address, length]) + data)


def encode(value: int, sign_bit: int) -> bytes:
    return (abs(value) | (value < 0) << sign_bit).to_bytes(2, "little")


def decode(data: bytes, sign_bit: int) -> int:
    bits = int.from_bytes(data, "little")
    magnitude = bits & ((1 << sign_bit) - 1)
    return -magnitude if bits >> sign_bit & 1 else magnitude


def release(servos: list[int]) -> bytes:
    """Zero duty and then no torque, for all servos; none replies.

    The duty comes first: Feetech's servos may take a new goal as a wish for torque.
    """
    zero = sync_write(GOAL_DUTY, dict.fromkeys(servos, encode(0, DUTY_SIGN)))
    return zero + sync_write(TORQUE_ENABLE, dict.fromkeys(servos, b"\x00"))


@dataclass(frozen=True)
class Reading:
    """The registers that a servo replied with."""

    position: int
    speed: int
    load: int
    voltage: float
    temperature: int
    status: int
    data: bytes

    @classmethod
    def of(cls, status: int, data: bytes) -> "Reading":
        return cls(
            position=decode(data[0:2], POSITION_SIGN),
            speed=decode(data[2:4], POSITION_SIGN),
            load=decode(data[4:6], DUTY_SIGN),
            voltage=data[6] / 10.0,
            temperature=data[7],
            status=status | data[9],
            data=data,
        )


class Replies:
    """Finds status packets among received bytes: what is not one is skipped, byte by byte."""

    def __init__(self, servos: list[int], length: int):
        self.missing = list(servos)
        self.length = length
        self.found: dict[int, tuple[int, bytes]] = {}
        self.corrupt: set[int] = set()
        self._bytes = b""

    def push(self, received: bytes) -> None:
        self._bytes += received
        while len(self._bytes) >= 6:
            if self._bytes[:2] != HEADER or self._bytes[2] == 0xFF:
                self._bytes = self._bytes[1:]
                continue
            servo, count = self._bytes[2], self._bytes[3]
            if servo not in self.missing or count != self.length + 2:
                self._bytes = self._bytes[1:]
                continue
            end = count + 4
            if len(self._bytes) < end:
                return
            body, total = self._bytes[2 : end - 1], self._bytes[end - 1]
            if checksum(body) != total:
                self.corrupt.add(servo)
                self._bytes = self._bytes[1:]
                continue
            self.found[servo] = (body[2], body[3:])
            self.missing.remove(servo)
            self._bytes = self._bytes[end:]


class Wire:
    """Exchanges with all servos on a serial port, an open `serial.Serial`; `now` gives the time,
    s."""

    def __init__(self, port, servos: list[int], reply_time: float, now: Callable[[], float] = time.monotonic):
        self.port, self.servos, self.reply_time, self.now = port, servos, reply_time, now
        # Those that were sent last.
        self.duties: dict[int, int] = {}
        # The SDK polls; a read that waits for its bytes leaves the processor to LeRobot's other
        # threads.
        port.timeout = reply_time / 4.0

    def send(self, data: bytes) -> None:
        self.port.write(data)

    def read_all(self, address: int, length: int) -> Replies:
        """Asks all servos for the same registers, and waits until all have replied or the time is
        over."""
        replies = Replies(self.servos, length)
        # A reply to an earlier request would be taken for a new one.
        self.port.reset_input_buffer()
        self.send(sync_read(self.servos, address, length))
        until = self.now() + self.reply_time
        while replies.missing:
            # No more than is awaited, so that the read returns as soon as it is there.
            replies.push(self.port.read(max(len(replies.missing) * (length + 6) - len(replies._bytes), 1)))
            if self.now() > until:
                break
        return replies

    def present(self) -> tuple[dict[int, Reading], Replies]:
        replies = self.read_all(PRESENT, PRESENT_LENGTH)
        return {servo: Reading.of(*found) for servo, found in replies.found.items()}, replies

    def set_duties(self, steps: dict[int, int]) -> None:
        """Duties in thousandths of the supply."""
        self.duties = steps
        self.send(sync_write(GOAL_DUTY, {servo: encode(value, DUTY_SIGN) for servo, value in steps.items()}))

    def release(self, rounds: int) -> bool:
        """Switches the torque off until every servo confirms it, at most this often. Whether all
        did."""
        for _ in range(rounds):
            self.send(release(self.servos))
            replies = self.read_all(TORQUE_ENABLE, 1)
            if not replies.missing and all(data == b"\x00" for _, data in replies.found.values()):
                return True
        return False
