"""The servos' bus: the packets on it, and faults of the line."""

import os
import pty
import select
import threading
import tty
from multiprocessing.connection import Listener
from pathlib import Path

from .clock import Clock
from .port import LINES
from .servo import Servo

HEADER = b"\xff\xff"
BROADCAST = 0xFE
PING, READ, WRITE, REG_WRITE, ACTION, SYNC_READ, SYNC_WRITE = 1, 2, 3, 4, 5, 0x82, 0x83
PRESENT_POSITION, GOAL_DUTY = 56, 44


def checksum(body: bytes) -> int:
    return 255 - sum(body) % 256


class Bus:
    """Six servos behind a port named `port`.

    The arm moves with the clock at each synchronous read of positions, by at most `step` seconds:
    while LeRobot connects, for a second or two, it stands. Processes of their own have ways that
    wait for them: `listen` for a plug-in with a simulated clock, and `terminal`, a pseudo-terminal
    under the name of the port, for one that knows the machine's ports alone.
    """

    def __init__(self, folder: Path, arm, servos: list[Servo], clock: Clock, step: float, terminal: bool = False):
        self.folder, self.arm, self.servos, self.clock, self.step = folder, arm, servos, clock, step
        self.port = str(folder / "ttySO101")
        self.lock = threading.RLock()
        self.received: list[tuple[int, int, bytes]] = []
        """The instructions that came: identity, instruction, parameters."""
        self.duties: list[dict[int, int]] = []
        """The synchronous writes of duties, as the bytes say, by servo."""
        self.mute = False
        """Whether all replies get lost."""
        self.deaf = False
        """Whether all requests get lost."""
        self.corrupt: set[int] = set()
        """Servos of which each reply has a wrong bit."""
        self.noise = b""
        """Bytes that come before each reply."""
        self._buffer, self._replies = b"", b""
        self._terminal = terminal
        self._stop = threading.Event()
        self._last = clock.now()
        self._move(0.0)
        LINES[self.port] = self
        self.plug_in()

    def plug_in(self) -> None:
        """The port is there, and another one than before."""
        self.plug = object()
        if self._terminal:
            master, slave = pty.openpty()
            tty.setraw(master)
            Path(self.port).symlink_to(os.ttyname(slave))
            threading.Thread(target=self._serve, args=(master, slave, self.plug), daemon=True).start()

    def unplug(self) -> None:
        """The adapter is gone: the port fails, and nothing reaches the servos, which keep their
        power."""
        self.plug = None
        Path(self.port).unlink(missing_ok=True)

    def close(self) -> None:
        self.unplug()
        LINES.pop(self.port, None)

    def advance(self, seconds: float, each: float = 0.005) -> None:
        """Time passes without anything on the bus."""
        for _ in range(round(seconds / each)):
            self.clock.sleep(each)
            self._move(each)

    def exchange(self, data: bytes) -> bytes:
        """The replies to what came on the line."""
        with self.lock:
            self._replies = b""
            if not self.deaf:
                self._buffer += data
                self._packets()
            return self._replies

    def listen(self) -> str:
        """The address at which another process exchanges with the bus."""
        listener = Listener(str(self.folder / "line"), family="AF_UNIX")

        def serve():
            with listener.accept() as connection:
                try:
                    while True:
                        connection.send_bytes(self.exchange(connection.recv_bytes()))
                except (EOFError, ConnectionError):
                    pass  # The process has ended.

        threading.Thread(target=serve, daemon=True).start()
        return listener.address

    def _serve(self, master: int, slave: int, plug: object) -> None:
        while self.plug is plug:
            if select.select([master], [], [], 0.02)[0]:
                os.write(master, self.exchange(os.read(master, 1024)))
        os.close(slave)
        os.close(master)

    def _move(self, seconds: float) -> None:
        if seconds > 0.0:
            self.arm.advance(self.servos, seconds)
        for servo, angle, speed in zip(self.servos, self.arm.q, self.arm.qd, strict=True):
            servo.move(float(angle), float(speed))

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
        by_identity = {servo.identity: servo for servo in self.servos}
        addressed = self.servos if identity == BROADCAST else [by_identity[identity]] if identity in by_identity else []
        if instruction == SYNC_READ:
            if parameters[0] == PRESENT_POSITION:
                now = self.clock.now()
                self._move(min(now - self._last, self.step))
                self._last = now
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
        self._replies += self.noise + HEADER + body + bytes([total])
