"""The time that the plug-in keeps: the machine's, in place of which tests put a simulated one."""

import threading
import time


class Clock:
    """Seconds, pauses, and threads that pause."""

    now = staticmethod(time.monotonic)
    sleep = staticmethod(time.sleep)

    @staticmethod
    def wait(event: threading.Event, seconds: float) -> bool:
        """Whether the event came within this time."""
        return event.wait(seconds)

    @staticmethod
    def start(thread: threading.Thread) -> None:
        thread.start()

    @staticmethod
    def join(thread: threading.Thread, seconds: float) -> None:
        thread.join(timeout=seconds)
