"""Serial ports in simulated time, in the place of pyserial's for the SDK under LeRobot.

A byte takes its time on the wire, and a read waits for its bytes until its timeout. The line behind
a port is a `Bus` of this process, or, over a socket, one of another.
"""

import termios
from collections import deque
from multiprocessing.connection import Client
from types import SimpleNamespace

import serial
from scservo_sdk import port_handler

from .clock import Clock

BYTE = 10.0 / 1_000_000
"""Ten bits at the servos' rate, s."""
POLL = 1e-4
"""The time of a read that finds nothing and does not wait: the SDK polls."""

LINES: dict = {}
"""The lines by the names of their ports."""


class Port:
    """The part of a `serial.Serial` that the SDK and the plug-in use."""

    def __init__(self, line, timeout: float):
        self.line, self.timeout, self.clock = line, timeout, line.clock
        self._plug = line.plug
        self._arriving: deque[tuple[float, int]] = deque()
        self._check()

    def _check(self) -> None:
        if self._plug is None or self._plug is not self.line.plug:
            raise serial.SerialException("the adapter is gone")

    def write(self, data: bytes) -> int:
        self._check()
        self.clock.sleep(len(data) * BYTE)
        self._check()
        first = self.clock.now()
        for place, byte in enumerate(self.line.exchange(bytes(data))):
            self._arriving.append((first + (place + 1) * BYTE, byte))
        return len(data)

    def read(self, size: int = 1) -> bytes:
        self._check()
        now = self.clock.now()
        wanted = self._arriving[size - 1][0] if len(self._arriving) >= size else float("inf")
        wait = min(wanted - now, self.timeout)
        if wait <= 0.0 and not self.in_waiting:
            wait = POLL
        self.clock.sleep(max(wait, 0.0))
        self._check()
        return bytes(self._arriving.popleft()[1] for _ in range(min(size, self.in_waiting)))

    @property
    def in_waiting(self) -> int:
        now = self.clock.now()
        return sum(at <= now for at, _ in self._arriving)

    def reset_input_buffer(self) -> None:
        if self._plug is not self.line.plug:
            # As a terminal's flush does, and pyserial lets it pass.
            raise termios.error(5, "Input/output error")
        for _ in range(self.in_waiting):
            self._arriving.popleft()

    def flush(self) -> None:
        self._check()

    def close(self) -> None:
        self._plug = None


class Remote:
    """The line of another process, which waits for each exchange as long as it takes; time is this
    process's own."""

    def __init__(self, address: str):
        self.clock, self.plug = Clock(), object()
        self._client = Client(address)

    def exchange(self, data: bytes) -> bytes:
        self._client.send_bytes(data)
        return self._client.recv_bytes()


def install() -> None:
    """From now on the SDK opens a line of `LINES` as a port and counts its timeouts in that line's
    time."""

    def opened(port, timeout=0.0, **settings):
        return Port(LINES[port], timeout) if port in LINES else serial.Serial(port, timeout=timeout, **settings)

    port_handler.serial = SimpleNamespace(Serial=opened, EIGHTBITS=serial.EIGHTBITS)
    port_handler.PortHandler.getCurrentTime = lambda self: 1000.0 * self.ser.clock.now()
