"""Whatever fails while the arm floats ends in an error of its own type, and in servos without
torque."""

import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from conftest import run

from lerobot_teleoperator_so101_floating import (
    BusLost,
    CorruptReplies,
    DynamicsFailed,
    FloatingError,
    ImplausibleMotion,
    LoopLate,
    ServoFault,
    ServoSilent,
    StaleServo,
    WrongSupply,
)

WARM = 250
"""Ticks after which the torque has risen."""


def ends(teleoperator, error, ticks=200):
    """The error that comes within these ticks, and after how many."""
    for tick in range(ticks):
        try:
            teleoperator.tick()
        except FloatingError as caught:
            assert type(caught) is error, repr(caught)
            return caught, tick + 1
    raise AssertionError(f"no error within {ticks} ticks")


def no_torque(bus):
    assert [servo.torque_enabled for servo in bus.servos] == [False] * 6
    assert [servo.motor() for servo in bus.servos] == [(0.0, 0.0)] * 6
    assert [servo.signed(44, 10) for servo in bus.servos] == [0] * 6


@pytest.fixture
def warm(bench, at_rest):
    bus, teleoperator = bench.floating(at_rest)
    run(teleoperator, WARM)
    # The check of the torque's end is one if there was torque before.
    assert all(servo.torque_enabled for servo in bus.servos) and abs(bus.servos[1].duty()) > 0.1
    return bus, teleoperator


# For each fault of the bus, the error with its joint and words, whether servos confirmed, and in how
# many ticks.
FAULTS = {
    "lost replies": (lambda bus: setattr(bus, "mute", True), BusLost, None, "switch off their supply", False, 3),
    "unplugged": (lambda bus: bus.unplug(), BusLost, None, "", False, 3),
    "silent": (lambda bus: setattr(bus.servos[3], "silent", True), ServoSilent, "wrist_flex", "", None, 3),
    "without its cable": (lambda bus: bus.servos[5].cut(), ServoSilent, "gripper", "", None, 200),
    "wrong checksums": (lambda bus: setattr(bus, "corrupt", {4}), CorruptReplies, "wrist_flex", "", None, 3),
    "fault": (lambda bus: bus.servos[1].set(65, 0b10_0100, 1), ServoFault, "shoulder_lift", "temperature, load", True, 1),
    "hot": (lambda bus: bus.servos[4].set(63, 90, 1), ServoFault, "wrist_roll", "", None, 200),
    "late": (lambda bus: bus.clock.sleep(0.5), LoopLate, None, "", None, 200),
}


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_is_named_and_ends_without_torque(warm, name):
    (bus, teleoperator), (fault, error, joint, words, released, most) = warm, FAULTS[name]
    fault(bus)
    found, ticks = ends(teleoperator, error)
    assert ticks <= most and found.joint == joint and words in str(found)
    assert released is None or found.released is released
    if name == "without its cable":
        # Nothing reaches its registers any more.
        assert [servo.motor() for servo in bus.servos] == [(0.0, 0.0)] * 6
    elif name != "unplugged":
        no_torque(bus)


def test_an_adapter_that_returns_ends_without_torque(bench, at_rest):
    bus, teleoperator = bench.floating(at_rest, release_time=3.0)
    run(teleoperator, WARM)
    bus.unplug()
    bench.clock.at(0.5, bus.plug_in)
    error, _ = ends(teleoperator, BusLost)
    assert error.released is True
    no_torque(bus)


def until(condition):
    """Waits for another process, as long as it takes."""
    while not condition():
        time.sleep(0.02)


def test_the_guardian_waits_for_the_adapter(bench, at_rest, monkeypatch):
    from lerobot_teleoperator_so101_floating.guardian import Guardian

    # It keeps the machine's time, and gives up after a minute of it.
    monkeypatch.setattr(Guardian.__init__, "__defaults__", (3600.0,))
    bus = bench.bus(at_rest, terminal=True)
    teleoperator = bench.teleoperator(bus, guardian=True)
    teleoperator.connect(calibrate=False)
    run(teleoperator, WARM)
    bus.unplug()
    error, _ = ends(teleoperator, BusLost)
    assert error.released is False
    bus.plug_in()
    until(lambda: not any(servo.torque_enabled for servo in bus.servos))
    no_torque(bus)


def test_a_single_lost_reply_is_no_fault(warm):
    bus, teleoperator = warm
    for _ in range(5):
        bus.servos[2].silent = True
        teleoperator.tick()
        teleoperator.tick()
        bus.servos[2].silent = False
        teleoperator.tick()
    assert teleoperator.loop.misses._missed[3] == 0


def test_noise_before_replies_is_skipped(warm):
    bus, teleoperator = warm
    bus.noise = b"\x00\xff\x12"
    run(teleoperator, 20)
    assert teleoperator._error is None


def test_a_servo_that_freezes_in_motion_is_stale(bench, at_rest):
    bus, teleoperator = bench.floating(at_rest)
    run(teleoperator, WARM)
    base = at_rest.q.copy()
    rows = [base + np.array([0.0, 0.3 * np.sin(0.01 * tick), 0, 0, 0, 0]) for tick in range(1000)]
    at_rest.rows, at_rest.row = rows, -1
    run(teleoperator, 40)
    bus.servos[1].freeze()
    error, ticks = ends(teleoperator, StaleServo)
    assert error.joint == "shoulder_lift" and ticks <= 0.35 * 200
    no_torque(bus)


def test_a_servo_that_froze_at_rest_is_stale_once_its_command_changes(bench, at_rest):
    bus, teleoperator = bench.floating(at_rest)
    run(teleoperator, WARM)
    bus.servos[2].freeze()
    run(teleoperator, 100)
    # The hand lifts the shoulder, which takes load off the elbow.
    base = at_rest.q.copy()
    at_rest.rows = [base - np.array([0.0, min(0.004 * tick, 1.5), 0, 0, 0, 0]) for tick in range(1000)]
    at_rest.row = -1
    reported, off = bus.servos[2].signed_frozen(60, 10), []
    for _ in range(400):
        off.append(abs(teleoperator.loop.plausibility._sent[-1][1][2] - reported) > 20)
        try:
            teleoperator.tick()
        except StaleServo as error:
            assert error.joint == "elbow_flex"
            break
    # Within twice the time that a servo may contradict its commands.
    assert teleoperator._error is not None and sum(off) * 0.005 <= 2.0 * 0.15 + 0.02
    # A servo that replies with old registers cannot confirm it.
    assert teleoperator._error.released is False
    no_torque(bus)


@pytest.mark.parametrize("volts", [12.0, 3.7])
def test_another_supply_is_refused_before_torque_acts(bench, at_rest, volts):
    bus = bench.bus(at_rest, supply=volts)
    teleoperator = bench.teleoperator(bus)
    with pytest.raises(WrongSupply):
        teleoperator.connect(calibrate=False)
        teleoperator.tick()
    no_torque(bus)
    assert not bus.duties or all(not any(duties.values()) for duties in bus.duties)


def test_a_jump_of_a_position_ends_without_torque(warm, at_rest):
    bus, teleoperator = warm
    at_rest.rows, at_rest.row = [at_rest.q + np.array([0.3, 0, 0, 0, 0, 0])], -1
    error, ticks = ends(teleoperator, ImplausibleMotion)
    assert error.joint == "shoulder_pan" and ticks == 1
    no_torque(bus)


@pytest.mark.parametrize("answer", [(np.full(6, np.nan), np.zeros(6)), None])
def test_a_model_without_numbers_ends_without_torque(warm, answer):
    bus, teleoperator = warm

    def wrong(q, qd):
        if answer is None:
            raise ZeroDivisionError
        return answer

    teleoperator.loop.dynamics = wrong
    ends(teleoperator, DynamicsFailed)
    no_torque(bus)


@pytest.mark.parametrize(
    "feedback", [{"elbow_flex.torque": float("nan")}, {"elbow.torque": 0.1}, {"gripper.pos": 0.1}, {"gripper.torque": "x"}]
)
def test_wrong_feedback_is_ignored_with_one_warning(warm, feedback, caplog):
    bus, teleoperator = warm
    before = teleoperator.loop.torque.copy()
    for _ in range(20):
        teleoperator.send_feedback(feedback | {"shoulder_pan.torque": 0.55})
        teleoperator.tick()
    # The torques beside it are felt all the same.
    assert np.abs(teleoperator.loop.torque - before - [0.15, 0, 0, 0, 0, 0]).max() < 1e-6
    assert [record.levelname for record in caplog.records] == ["WARNING"] and next(iter(feedback)) in caplog.text


def test_each_call_after_an_error_raises_it_again(warm):
    bus, teleoperator = warm
    bus.servos[1].set(65, 1, 1)
    error, _ = ends(teleoperator, ServoFault)
    for call in (teleoperator.tick, teleoperator.get_action, lambda: teleoperator.send_feedback({})):
        with pytest.raises(ServoFault) as caught:
            call()
        assert caught.value is error
    teleoperator.disconnect()
    assert not teleoperator.is_connected
    # It can float again.
    bus.servos[1].set(65, 0, 1)
    teleoperator.connect(calibrate=False)
    run(teleoperator, 10)
    assert all(servo.torque_enabled for servo in bus.servos)


def test_the_end_of_a_connection_leaves_the_position_mode_without_torque(warm):
    bus, teleoperator = warm
    teleoperator.disconnect()
    no_torque(bus)
    assert [servo.registers[33] for servo in bus.servos] == [0] * 6


def test_a_raised_exception_in_a_with_block_ends_without_torque(bench, at_rest):
    bus = bench.bus(at_rest)
    teleoperator = bench.teleoperator(bus)
    with pytest.raises(KeyError), teleoperator:
        run(teleoperator, 10)
        assert all(servo.torque_enabled for servo in bus.servos)
        raise KeyError
    no_torque(bus)


CHILD = """
import sys, os, signal
sys.path.insert(0, {here!r})
import stand_ins
stand_ins.install()
from pathlib import Path
from lerobot_teleoperator_so101_floating import So101Floating, So101FloatingConfig, simulated
simulated.install()
line = simulated.LINES[{port!r}] = simulated.Remote({address!r})
So101Floating.clock = line.clock
config = So101FloatingConfig(id="bench", calibration_dir=Path({folder!r}), port={port!r}, gears=(345.0,) * 6, wrist_roll_zero=0)
teleoperator = So101Floating(config)
teleoperator.connect(calibrate=False)
line.clock.sleep(0.3)
print("floats", flush=True)
{then}
"""


@pytest.mark.parametrize(
    "end",
    [
        "sys.exit(0)",
        "raise KeyError",
        "os._exit(3)",
        "os.kill(os.getpid(), signal.SIGTERM)",
        "os.kill(os.getpid(), signal.SIGKILL)",
    ],
)
def test_however_the_process_ends_the_torque_does(bench, at_rest, end):
    # The plug-in and its guardian are processes: that one keeps its own time, and the guardian
    # waits until servos confirm.
    bus = bench.bus(at_rest, terminal=True)
    names = {"here": str(Path(__file__).parent), "folder": str(bench.folder), "port": bus.port, "address": bus.listen()}
    with open(bench.folder / "errors", "w") as errors:
        program = [sys.executable, "-c", CHILD.format(then=end, **names)]
        child = subprocess.Popen(program, stdout=subprocess.PIPE, stderr=errors, text=True)
    assert child.stdout.readline() == "floats\n", (bench.folder / "errors").read_text()
    child.wait()
    until(lambda: not any(servo.torque_enabled for servo in bus.servos))
    no_torque(bus)
    assert bus.duties and any(any(duties.values()) for duties in bus.duties)
