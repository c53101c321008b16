"""The servos' bus: a pseudo-terminal, the packets on it, and faults of the line."""

import contextlib
import os
import pty
import select
import threading
import time
import tty
from pathlib import Path

from .servo import Servo

HEADER = b"\xff\xff"
BROADCAST = 0xFE
PING, READ, WRITE, REG_WRITE, ACTION, SYNC_READ, SYNC_WRITE = 1, 2, 3, 4, 5, 0x82, 0x83
PRESENT_POSITION, GOAL_DUTY = 56, 44


def checksum(body: bytes) -> int:
    return 255 - sum(body) % 256


class Bus:
    """Six servos behind a port named `port`, a symbolic link as those under /dev/serial/by-id.

    In lockstep the arm moves by `step` seconds at each synchronous read of positions, and `clock` is its time: a run is the same
    however fast the machine is. Otherwise the arm follows the wall clock.
    """

    def __init__(self, folder: Path, arm, servos: list[Servo], step: float | None = None, delay: float = 0.0):
        self.arm, self.servos, self.step, self.delay = arm, servos, step, delay
        self.port = str(folder / "ttySO101")
        self.lock = threading.RLock()
        self.time = 0.0
        self.received: list[tuple[int, int, bytes]] = []
        """The instructions that came: identity, instruction, parameters."""
        self.duties: list[dict[int, int]] = []
        """The synchronous writes of duties, as the bytes say, by servo."""
        self.mute = False
        """Replies get lost."""
        self.deaf = False
        """Requests get lost."""
        self.corrupt: set[int] = set()
        """Servos of which each reply has a wrong bit."""
        self.noise = b""
        """Bytes before each reply."""
        self._registered: dict[int, tuple[int, bytes]] = {}
        self._buffer = b""
        self._master = -1
        self._slave = -1
        self._stop = threading.Event()
        self._last = time.monotonic()
        self._move(0.0)
        self.plug_in()
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def clock(self) -> float:
        return self.time

    def plug_in(self) -> None:
        """A new pseudo-terminal under the same name, as after an adapter was plugged in."""
        with self.lock:
            self._master, self._slave = pty.openpty()
            tty.setraw(self._master)
            link = Path(self.port)
            link.unlink(missing_ok=True)
            link.symlink_to(os.ttyname(self._slave))

    def unplug(self) -> None:
        """The adapter is gone: the port fails, and nothing reaches the servos, which keep their power."""
        with self.lock:
            master, slave, self._master, self._slave = self._master, self._slave, -1, -1
            os.close(slave)
            os.close(master)
            Path(self.port).unlink(missing_ok=True)

    def close(self) -> None:
        self._stop.set()
        self._thread.join()
        if self._master >= 0:
            self.unplug()

    def settle(self) -> None:
        """Waits until what was sent has been read: nothing replies to a synchronous write."""
        time.sleep(0.02)
        while self._master >= 0 and select.select([self._master], [], [], 0)[0]:
            time.sleep(0.01)
        with self.lock:
            pass

    def advance(self, seconds: float, each: float = 0.005) -> None:
        """Time passes without anything on the bus."""
        with self.lock:
            for _ in range(round(seconds / each)):
                self._move(each)

    def _move(self, seconds: float) -> None:
        self.time += seconds
        if seconds > 0.0:
            self.arm.advance(self.servos, seconds)
        for servo, angle, speed in zip(self.servos, self.arm.q, self.arm.qd, strict=True):
            servo.move(float(angle), float(speed))

    def _serve(self) -> None:
        while not self._stop.is_set():
            master = self._master
            if master < 0:
                time.sleep(0.005)
                continue
            try:
                if not select.select([master], [], [], 0.02)[0]:
                    continue
                received = os.read(master, 1024)
            except (OSError, ValueError):
                time.sleep(0.005)  # Nobody has the port open, or it was unplugged.
                continue
            with self.lock:
                if not self.deaf:
                    self._buffer += received
                    self._packets()

    def _packets(self) -> None:
        while len(self._buffer) >= 6:
            if self._buffer[:2] != HEADER:
                self._buffer = self._buffer[1:]
                continue
            end = self._buffer[3] + 4
            if len(self._buffer) < end:
                return
            body, total = self._buffer[2 : end - 1], self._buffer[end - 1]
            self._buffer = self._buffer[end:]
            if checksum(body) == total and len(body) >= 3:
                self.received.append((body[0], body[2], bytes(body[3:])))
                self._instruction(body[0], body[2], bytes(body[3:]))

    def _instruction(self, identity: int, instruction: int, parameters: bytes) -> None:
        if self.step is None:
            now = time.monotonic()
            # After a pause the arm has stood still for most of it: a reply must not wait for long steps.
            self._move(min(now - self._last, 0.02))
            self._last = now
        by_identity = {servo.identity: servo for servo in self.servos}
        addressed = self.servos if identity == BROADCAST else [by_identity[identity]] if identity in by_identity else []
        if instruction == SYNC_READ:
            if parameters[0] == PRESENT_POSITION and self.step is not None:
                self._move(self.step)
            for each in parameters[2:]:
                if each in by_identity:
                    self._reply(by_identity[each], by_identity[each].read(parameters[0], parameters[1]))
        elif instruction == SYNC_WRITE:
            self._sync_write(by_identity, parameters)
        elif instruction == PING:
            for servo in addressed:
                self._reply(servo, b"")
        elif instruction == READ:
            for servo in addressed:
                self._reply(servo, servo.read(parameters[0], parameters[1]))
        elif instruction == WRITE:
            for servo in addressed:
                servo.write(parameters[0], parameters[1:])
                servo.refresh()
                if identity != BROADCAST and servo.registers[8]:
                    self._reply(servo, b"")

    def _sync_write(self, by_identity: dict[int, Servo], parameters: bytes) -> None:
        address, length, data = parameters[0], parameters[1], parameters[2:]
        written = {}
        for at in range(0, len(data), length + 1):
            servo = by_identity.get(data[at])
            value = data[at + 1 : at + 1 + length]
            if servo is not None:
                servo.write(address, value)
                servo.refresh()
            bits = int.from_bytes(value, "little")
            written[data[at]] = -(bits & 1023) if bits & 1024 else bits & 1023
        if address == GOAL_DUTY:
            self.duties.append(written)

    def _reply(self, servo: Servo, data: bytes) -> None:
        if self.mute or servo.silent:
            return
        body = bytes([servo.identity, len(data) + 2, 0]) + data
        total = checksum(body)
        if servo.identity in self.corrupt:
            body = body[:3] + bytes([body[3] ^ 0x10]) + body[4:] if data else body
            total ^= 0 if data else 1
        if self.delay:
            time.sleep(self.delay)
        with contextlib.suppress(OSError):
            os.write(self._master, self.noise + HEADER + body + bytes([total]))
