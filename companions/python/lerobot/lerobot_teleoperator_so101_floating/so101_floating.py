"""The teleoperator: LeRobot's interface over the loop."""

import atexit
import logging
import threading
import weakref
from typing import Any

import numpy as np
from lerobot.motors import Motor, MotorNormMode
from lerobot.motors.feetech import FeetechMotorsBus, OperatingMode
from lerobot.processor import RobotAction
from lerobot.teleoperators.so_leader import SOLeader
from lerobot.teleoperators.teleoperator import Teleoperator
from lerobot.utils.decorators import check_if_already_connected, check_if_not_connected

from . import calibration as calibrations
from . import wire as wires
from .clock import Clock
from .config_so101_floating import So101FloatingConfig
from .dynamics import floating_dynamics
from .errors import BusLost, FloatingError, LoopLate, WrongCalibration, WrongConfiguration, WrongServos
from .guardian import Guardian
from .loop import Loop
from .lowering import LONGEST, Lowering
from .motors import JOINTS, Motors

logger = logging.getLogger(__name__)


class So101Floating(Teleoperator):
    """An SO-101 leader whose servos carry its weight and most of its friction, and which can feel
    the follower's load."""

    config_class = So101FloatingConfig
    name = "so101_floating"
    clock = Clock()

    def __init__(self, config: So101FloatingConfig):
        super().__init__(config)
        self.config = config
        body = MotorNormMode.DEGREES if config.use_degrees else MotorNormMode.RANGE_M100_100
        norms = [body] * 5 + [MotorNormMode.RANGE_0_100]
        motors = {joint: Motor(place + 1, "sts3215", norms[place]) for place, joint in enumerate(JOINTS)}
        self.bus = FeetechMotorsBus(config.port, motors, self.calibration)
        self.dynamics = floating_dynamics(Motors(config.gears), config.urdf)
        self.loop: Loop | None = None
        self._wire: wires.Wire | None = None
        self._guardian: Guardian | None = None
        self._connected = False
        self._torque_may_be_on = False
        self._error: FloatingError | None = None
        self._ignored: set[str] = set()
        self._lock = threading.Lock()
        self._ended = threading.Event()
        self._thread: threading.Thread | None = None
        # Not through a method of self, which would keep it from being collected.
        this = weakref.ref(self)
        atexit.register(lambda: (alive := this()) and alive._at_exit())

    @property
    def action_features(self) -> dict[str, type]:
        return {f"{joint}.pos": float for joint in JOINTS}

    @property
    def feedback_features(self) -> dict[str, type]:
        """The torques with which its surroundings load each joint of the follower, N·m."""
        return {f"{joint}.torque": float for joint in JOINTS}

    @property
    def is_connected(self) -> bool:
        return self._connected

    @property
    def is_calibrated(self) -> bool:
        return bool(self.calibration) and self.bus.is_calibrated

    @check_if_already_connected
    def connect(self, calibrate: bool = True) -> None:
        """Opens the port, checks servos and calibration, and lets the arm float.

        With `calibrate` and without a calibration that the servos have, LeRobot's own is run, which
        asks the user. Without, as `lerobot-calibrate` connects, an arm that is not calibrated stays
        without torque, and so does an arm of which the calibration is wrong: that raises
        `WrongCalibration`.
        """
        self._error, self._ended = None, threading.Event()
        self._open()
        try:
            self._translated(self._count_within_a_turn)
            if self.calibration:
                # Before LeRobot offers to write it to the servos.
                calibrations.check(self.calibration, f"delete {self.calibration_fpath} and run lerobot-calibrate")
            calibrated = self._translated(lambda: self.is_calibrated)
            if not calibrate and (not calibrated or self._wrist_is_unknown):
                logger.warning("%s is not calibrated, or wrist_roll_zero is not stated: it does not float", self)
                return
            if not calibrated:
                self.calibrate()
            self._check_calibration()
            self.configure()
            self._float()
        except BaseException as error:
            self._fail(error)
            self._close()
            raise
        logger.info("%s connected.", self)

    def _open(self) -> None:
        try:
            self.bus.connect()
        except wires.PORT_ERRORS as error:
            self._close_port()
            raise BusLost(f"the port {self.config.port} did not open, or failed: {error}") from error
        except RuntimeError as error:
            self._close_port()
            raise WrongServos(str(error)) from error
        self._wire = wires.Wire(self.bus.port_handler.ser, self.bus.ids, self.config.reply_time, self.clock.now)
        self._connected = True

    def _translated(self, call):
        """Returns the result of a call of LeRobot's bus, and raises its errors as those of this
        package."""
        try:
            return call()
        except FloatingError:
            raise
        except wires.PORT_ERRORS as error:
            raise BusLost(f"the port {self.config.port} failed: {error}") from error
        except RuntimeError as error:
            raise WrongServos(str(error)) from error

    def _count_within_a_turn(self) -> None:
        """Clears bit 4 of the phase, with which positions count on over turns, as LeRobot does from
        0.6 on."""
        for joint in JOINTS:
            phase = int(self.bus.read("Phase", joint))
            if phase & wires.COUNTS_TURNS:
                self.bus.disable_torque(joint)
                self.bus.write("Phase", joint, phase & ~wires.COUNTS_TURNS)

    def _check_calibration(self) -> None:
        calibrations.check(self.calibration)
        if not self._translated(lambda: self.bus.is_calibrated):
            raise WrongCalibration("the servos do not have the calibration of the file: run lerobot-calibrate")
        readings, replies = self._present()
        if replies.missing:
            joint = JOINTS[self.bus.ids.index(replies.missing[0])]
            raise WrongServos(f"the servo of {joint} did not reply", joint)
        calibrations.check_posture(self.calibration, readings)
        if self._wrist_is_unknown:
            angles = calibrations.Angles(self.calibration).of(np.array([readings[servo].position for servo in self.bus.ids]))
            raise WrongCalibration(
                "LeRobot's calibration has a full turn of wrist_roll, which says nothing of its zero: turn it until the axis of "
                "the jaw is level and the moving jaw on top, and state the angle that LeRobot then gives it by "
                f"--teleop.wrist_roll_zero=ANGLE; now it is at {round(np.degrees(angles[4]))}",
                "wrist_roll",
            )

    @property
    def _wrist_is_unknown(self) -> bool:
        return self.config.wrist_roll_zero is None and calibrations.turns_fully(self.calibration)

    def _present(self):
        return self._translated(self._wire.present)

    def calibrate(self) -> None:
        """LeRobot's calibration of a leader, without torque, and then the check of what it found.

        It asks the user; where nobody can answer, `WrongCalibration` is raised. The arm floats
        after the next `connect`.
        """
        self._stop_thread()
        if self._torque_may_be_on:
            self._lower()
        self.loop = None
        try:
            self._translated(lambda: SOLeader.calibrate(self))
        except EOFError as error:
            raise WrongCalibration("the servos do not have the calibration of the file: run lerobot-calibrate") from error
        calibrations.check(self.calibration)

    def configure(self) -> None:
        """The PWM mode, without torque, and a check of what the servos have."""
        self._translated(self._configure)

    def _configure(self) -> None:
        self.bus.disable_torque()
        self.bus.configure_motors()
        for joint, servo in zip(JOINTS, self.bus.ids, strict=True):
            # The mode is in the EPROM, which wears: it is written if it is another one.
            if self.bus.read("Operating_Mode", joint) != OperatingMode.PWM.value:
                self.bus.write("Operating_Mode", joint, OperatingMode.PWM.value)
            self.bus.write("Goal_Time", joint, 0)
            if self.bus.read("Operating_Mode", joint) != wires.PWM_MODE or self.bus.read("Goal_Time", joint) != 0:
                raise WrongConfiguration(f"the servo {servo} of {joint} did not take the PWM mode with duty zero", joint)
            phase = int(self.bus.read("Phase", joint))
            if phase & (wires.REVERSED | wires.COUNTS_TURNS):
                raise WrongConfiguration(
                    f"the servo of {joint} has the phase {phase:#04x}: bits 0 and 7 reverse it, bit 4 counts turns; "
                    "clear them with Feetech's software and calibrate the arm anew",
                    joint,
                )

    def _float(self) -> None:
        angles = calibrations.Angles(self.calibration, self.config.wrist_roll_zero or 0.0)
        self.loop = Loop(self.config, self._wire, angles, self.dynamics)
        if self.config.guardian:
            self._guardian = Guardian(self.config.port, self.bus.default_baudrate, self.bus.ids)
        self._torque_may_be_on = True
        self._translated(self.bus.enable_torque)
        if self.config.background:
            self.tick()
            self._thread = threading.Thread(target=self._run, name="so101_floating", daemon=True)
            self.clock.start(self._thread)

    def _run(self) -> None:
        """The thread: ticks at the rate until the end or an error, which the next call of the user
        gets."""
        due = self.clock.now()
        while not self._ended.is_set():
            due = max(due + self.loop.tick_time, self.clock.now() - self.loop.tick_time)
            if self.clock.wait(self._ended, max(due - self.clock.now(), 0.0)):
                return
            try:
                self.tick()
            except FloatingError as error:
                logger.error("%s: %s", self, error)
                return

    def tick(self) -> None:
        """One tick of the loop; after an error the arm is lowered, and each further call raises the
        same error."""
        if self._error is not None:
            raise self._error
        if self.loop is None:
            raise WrongCalibration("the arm is not calibrated: it does not float")
        try:
            with self._lock:
                self.loop.tick(self.clock.now())
        except FloatingError as error:
            self._fail(error)
            raise
        except wires.PORT_ERRORS as error:
            lost = BusLost(f"the port {self.config.port} failed: {error}")
            self._fail(lost)
            raise lost from error
        except BaseException as error:
            self._fail(error)
            raise

    @check_if_not_connected
    def get_action(self) -> RobotAction:
        """The positions of the last tick, as LeRobot's so101_leader gives them."""
        self._raise_if_failed()
        if self.loop is None or not self.config.background:
            self.tick()
        self._raise_if_late()
        ids = dict(zip(self.bus.ids, self.loop.counts.tolist(), strict=True))
        values = self.bus._normalize(ids)
        return {f"{joint}.pos": values[servo] for joint, servo in zip(JOINTS, self.bus.ids, strict=True)}

    @check_if_not_connected
    def send_feedback(self, feedback: dict[str, Any]) -> None:
        """Lets the user feel the follower's load: the torque with which its surroundings act on a
        joint, N·m.

        The load is felt by `feedback_gain` beyond the dead band, and forgotten after
        `feedback_timeout`.
        """
        self._raise_if_failed()
        torque = np.zeros(6)
        for key, value in feedback.items():
            joint = key.removesuffix(".torque")
            known = key.endswith(".torque") and joint in JOINTS
            if known and isinstance(value, (int, float, np.number)) and np.isfinite(value):
                torque[JOINTS.index(joint)] = value
            elif key not in self._ignored:
                # Others may send more than torques, positions for instance.
                self._ignored.add(key)
                logger.warning("%s: the feedback %s, %r, is no torque of a joint and is ignored", self, key, value)
        if self.loop is not None:
            self.loop.feedback.set(torque, self.clock.now())

    def _raise_if_failed(self) -> None:
        if self._error is not None:
            raise self._error

    def _raise_if_late(self) -> None:
        last = self.loop.last
        if last is None or self.clock.now() - last > self.config.most_age:
            self._stop_thread()
            self._raise_if_failed()
            age = "never" if last is None else f"{self.clock.now() - last:.2f} s ago"
            error = LoopLate(f"the servos were last read {age}")
            self._fail(error)
            raise error

    def _fail(self, error: BaseException) -> None:
        """Keeps the error for the calls to come, and lowers the arm."""
        self._ended.set()
        if not isinstance(error, FloatingError):
            error = FloatingError(f"the loop ended: {error!r}")
        self._error = self._error or error
        self._error.released = error.released = self._lower() if self._torque_may_be_on else None

    def _lower(self) -> bool:
        """Lowers the arm. Whether all servos confirm that their torque is off; if not, the guardian
        goes on trying."""
        with self._lock:
            logger.info("%s: the arm comes down", self)
            descent, until = Lowering(self._wire.duties, self.clock.now()), None
            released = False
            while not released and (until is None or self.clock.now() < until):
                try:
                    released = descent.run(self._wire, self.clock)
                    if not released and not self.config.guardian and until and self.clock.now() >= until:
                        # Nobody goes on trying: the torque is switched off unseen.
                        released = self._wire.release(1)
                except wires.PORT_ERRORS:
                    self._reopen()
                until = until or self.clock.now() + self.config.release_time
            if released or self._guardian is not None:
                # It is off, or the guardian's concern: two on one bus would disturb each other.
                self._torque_may_be_on = False
            if self._guardian is not None:
                self._guardian.dismiss() if released else self._guardian.take_over()
                self._guardian = None
            return released

    def _reopen(self) -> None:
        """A port that failed may be there again: an adapter that was plugged in."""
        self.clock.sleep(0.05)
        try:
            self._close_port()
            self.bus.port_handler.openPort()
            self._wire = wires.Wire(self.bus.port_handler.ser, self.bus.ids, self.config.reply_time, self.clock.now)
        except wires.PORT_ERRORS:
            pass

    def _stop_thread(self) -> None:
        self._ended.set()
        thread, self._thread = self._thread, None
        if thread is not None and thread is not threading.current_thread():
            self.clock.join(thread, 2.0 + LONGEST + self.config.release_time)

    @check_if_not_connected
    def disconnect(self) -> None:
        """Lowers the arm, switches the torque off and closes the port. Raises `BusLost` if the servos
        do not confirm, once the port is closed."""
        self._stop_thread()
        released = self._lower() if self._torque_may_be_on else True
        if released and self._error is None:
            self._to_position_mode()
        already = self._error
        self._close()
        logger.info("%s disconnected.", self)
        if not released and already is None:
            error = BusLost("the servos did not confirm that their torque is off")
            error.released = False
            raise error

    def _to_position_mode(self) -> None:
        """The mode in which LeRobot's own leader expects its servos."""
        try:
            self.bus.disable_torque()
            for joint in JOINTS:
                if self.bus.read("Operating_Mode", joint) != OperatingMode.POSITION.value:
                    self.bus.write("Operating_Mode", joint, OperatingMode.POSITION.value)
        except (RuntimeError, *wires.PORT_ERRORS) as error:
            logger.warning("%s: the servos stay in the PWM mode, without torque: %s", self, error)

    def _close(self) -> None:
        self._close_port()
        self._connected, self.loop = False, None

    def _close_port(self) -> None:
        try:
            if self.bus.port_handler.is_open:
                self.bus.port_handler.closePort()
        except wires.PORT_ERRORS:
            pass
        self.bus.port_handler.is_open = False
        self.bus.port_handler.is_using = False

    def _at_exit(self) -> None:
        if self._torque_may_be_on and self._wire is not None:
            self._stop_thread()
            self._lower()

    def setup_motors(self) -> None:
        """As LeRobot's so101_leader: gives each servo its identity."""
        SOLeader.setup_motors(self)
