"""A second process that lowers the arm if the first ends without having done so.

It waits at a pipe whose other end the first process holds: however that one ends, the pipe closes.
The byte `d` before the end says that the torque is off; anything else, or none, makes the guardian
open the port and lower the arm until the servos confirm that their torque is off.

    python guardian.py PORT BAUD_RATE SECONDS ID…
"""

import os
import signal
import subprocess
import sys
import time
import types
from pathlib import Path


class Guardian:
    """The guardian of this process."""

    def __init__(self, port: str, baud_rate: int, servos: list[int], seconds: float = 60.0):
        # As a file, not as a module: the package imports LeRobot, which takes seconds.
        command = [sys.executable, str(Path(__file__)), port, str(baud_rate), str(seconds), *map(str, servos)]
        # A group of its own: Ctrl-C in a terminal is for the first process.
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, start_new_session=True)

    def dismiss(self) -> None:
        """The torque is off: nothing is left to do."""
        self._end(b"d")

    def take_over(self) -> None:
        """The torque may be on: the guardian tries on, also after this process."""
        self._end(b"")

    def _end(self, last: bytes) -> None:
        pipe = self._process.stdin
        if pipe is None or pipe.closed:
            return
        try:
            pipe.write(last)
            pipe.close()
        except OSError:
            pass  # It has ended.


def main() -> int:
    port, baud_rate, seconds = sys.argv[1], int(sys.argv[2]), float(sys.argv[3])
    servos = [int(servo) for servo in sys.argv[4:]]
    for each in (signal.SIGINT, signal.SIGHUP):
        signal.signal(each, signal.SIG_IGN)
    # The submodules alone: the package imports LeRobot, which takes seconds.
    package = types.ModuleType("floating")
    package.__path__ = [str(Path(__file__).parent)]
    sys.modules["floating"] = package
    import serial
    from floating import clock, lowering, wire

    said = b""
    while chunk := os.read(0, 64):
        said += chunk
    if said.endswith(b"d"):
        return 0
    until = time.monotonic() + seconds
    descent = lowering.Lowering({}, time.monotonic())
    last = False
    while not last:
        # Once the time is over the torque is switched off unseen, whether the arm is down or not.
        last = time.monotonic() > until
        try:
            with serial.Serial(port, baud_rate, timeout=0) as opened:
                bus = wire.Wire(opened, servos, 0.02)
                if bus.release(5) if last else descent.run(bus, clock.Clock):
                    return 0
        except wire.PORT_ERRORS:
            pass  # The adapter may be plugged in again.
        time.sleep(0.1)
    print(f"the servos on {port} did not confirm that their torque is off: switch off their supply", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
