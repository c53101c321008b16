"""Simulated time: what happens in it is the same on an idle machine and on a busy one."""

import heapq
import itertools
import threading


class Clock:
    """A clock that one thread or several sleep by.

    It advances when all of them sleep, to the moment at which the first is due, and that one alone
    runs on. Nothing else takes time: bytes on a line and waiting for them are sleeps too
    (`port.py`).
    """

    def __init__(self):
        self.seconds = 0.0
        self._turn = threading.Condition()
        self._number = itertools.count()
        self._running = threading.get_ident()
        self._due: dict[int, tuple[float, int]] = {}
        self._threads: set[int] = set()
        self._events: list = []

    def now(self) -> float:
        return self.seconds

    def at(self, seconds: float, happens) -> None:
        """Calls a function when this much time has passed."""
        heapq.heappush(self._events, (self.seconds + seconds, next(self._number), happens))

    def sleep(self, seconds: float) -> None:
        me = threading.get_ident()
        with self._turn:
            self._due[me] = (self.seconds + max(seconds, 0.0), next(self._number))
            self._pass_on()
            self._turn.wait_for(lambda: self._running == me)

    def wait(self, event: threading.Event, seconds: float) -> bool:
        self.sleep(seconds)
        return event.is_set()

    def start(self, thread: threading.Thread) -> None:
        run = thread.run

        def in_turn():
            me = threading.get_ident()
            with self._turn:
                self._turn.wait_for(lambda: self._running == me)
            try:
                run()
            finally:
                with self._turn:
                    self._threads.discard(me)
                    self._pass_on()

        thread.run = in_turn
        thread.start()
        with self._turn:
            self._threads.add(thread.ident)
            self._due[thread.ident] = (self.seconds, next(self._number))

    def join(self, thread: threading.Thread, seconds: float) -> None:
        until = self.seconds + seconds
        while thread.ident in self._threads and self.seconds < until:
            self.sleep(0.001)

    def _pass_on(self) -> None:
        """The turn of the thread that is due first, after what happens before it is."""
        if not self._due:
            return
        who = min(self._due, key=self._due.get)
        due, _ = self._due.pop(who)
        while self._events and self._events[0][0] <= due:
            at, _, happens = heapq.heappop(self._events)
            self.seconds = max(self.seconds, at)
            happens()
        self.seconds = max(self.seconds, due)
        self._running = who
        self._turn.notify_all()
