"""An arm that is released stays where it is, and falls without compensation."""

import signal

import numpy as np
import pytest
from conftest import SCENE_GEARS, TICK, Arm, run

from lerobot_teleoperator_so101_floating import BusLost
from lerobot_teleoperator_so101_floating.lowering import Lowering
from lerobot_teleoperator_so101_floating.motors import LEADER_GEARS

HELD, RAMP, RELEASED = 0.5, 0.3, 2.0
"""A hand holds the arm while the torque rises, and then it is released, s."""
BAR, FALL = 1.0, 20.0
"""The greatest drift of any joint with compensation, and the least motion of an arm without,
degrees."""
SINKS = 10.0
"""The greatest drift of an arm whose bus is lost, degrees."""


def hold(posture):
    return lambda q, qd, time: 20.0 * (posture - q) - 1.0 * qd


def released(bench, posture, gears, plant=None, moving=None, time=RELEASED, **options):
    """The largest angle by which a joint moves after the release, and the greatest speed at the
    end, in degrees."""
    arm = Arm(posture, gears, **(plant or {}))
    arm.hand = hold(posture)
    bus, teleoperator = bench.floating(arm, gears, ramp=RAMP, **options)
    run(teleoperator, round(HELD / TICK))
    assert all(servo.torque_enabled for servo in bus.servos)
    start = arm.q.copy()
    if moving is not None:
        arm.qd = arm.qd + moving
    arm.hand = lambda q, qd, time: np.zeros(6)
    most = np.zeros(6)
    for _ in range(round(time / TICK)):
        teleoperator.tick()
        most = np.maximum(most, np.abs(arm.q - start))
    return np.degrees(most.max()), np.degrees(np.abs(arm.qd).max())


def fallen(bench, posture, gears):
    """As `released`, of an arm whose servos have no torque."""
    arm = Arm(posture, gears)
    bus = bench.bus(arm, gears)
    most = np.zeros(6)
    for _ in range(round(RELEASED / TICK)):
        bus.advance(TICK)
        most = np.maximum(most, np.abs(arm.q - posture))
    return np.degrees(most.max())


@pytest.fixture
def postures(scene):
    return np.array(scene["angles"])


@pytest.mark.parametrize("gears", [SCENE_GEARS, LEADER_GEARS], ids=["scene", "leader"])
def test_a_released_arm_stays_and_falls_without(bench, postures, gears):
    drift = [released(bench, posture, gears)[0] for posture in postures]
    falls = [fallen(bench, posture, gears) for posture in postures]
    assert max(drift) <= BAR and min(falls) >= FALL, (drift, falls)


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_a_released_arm_stays_with_parameters_that_are_off(bench, postures, sign):
    """Gravity by 3 % and the plant's friction by 10 % less than the model's, as the law's
    configuration allows."""
    off = {"gravity_scale": (1.0 + 0.03 * sign,) * 6}
    drift = [released(bench, posture, LEADER_GEARS, {"friction": 1.0 / 1.1}, **off)[0] for posture in postures[1::2]]
    assert max(drift) <= 3.0 * BAR, drift


def test_a_moving_arm_comes_to_rest(bench, postures):
    """The friction that is left stops an arm that is let go in motion, at whichever wall or
    before."""
    push = np.array([0.6, -0.3, 0.3, 0.3, 0.6, 0.0])
    _, soon = released(bench, postures[0], LEADER_GEARS, {"friction": 1.0 / 1.1}, push, time=0.1)
    _, late = released(bench, postures[0], LEADER_GEARS, {"friction": 1.0 / 1.1}, push, time=10.0)
    assert soon > 10.0 and late < 0.1, (soon, late)


def test_an_arm_that_loses_its_bus_sinks_slowly(bench, postures):
    """The servos keep their last duties, which nothing can take from them without a bus: what that
    means for the arm."""
    ways = []
    for posture in postures:
        arm = Arm(posture, LEADER_GEARS)
        arm.hand = hold(posture)
        bus, teleoperator = bench.floating(arm, LEADER_GEARS, ramp=RAMP)
        run(teleoperator, round(HELD / TICK))
        bus.unplug()
        start = arm.q.copy()
        arm.hand = lambda q, qd, time: np.zeros(6)
        bus.advance(RELEASED)
        assert all(servo.torque_enabled for servo in bus.servos)
        ways.append(np.degrees(np.abs(arm.q - start).max()))
    assert max(ways) <= SINKS, ways


FALL_BAR, SPEED_BAR = 2.0, 0.6
"""The greatest motion of any joint in two seconds after its torque is off, degrees, and the greatest
speed of any while the arm comes down, rad/s."""


def comes_down(bench, posture, gears, ends):
    """What each joint falls once its torque is off, in degrees, the greatest speed of any before, and
    how far the arm had come down."""
    # Friction holds below 0.01 rad/s, as that of gears does; by the scene's, which fades below 0.05,
    # an arm creeps on for a minute.
    arm = Arm(posture, gears, width=0.01)
    arm.hand = hold(posture)
    bus, teleoperator = bench.floating(arm, gears, ramp=RAMP)
    run(teleoperator, round(HELD / TICK))
    arm.hand = lambda q, qd, time: np.zeros(6)
    fastest, advance = [0.0], arm.advance

    def watched(servos, seconds):
        if all(servo.torque_enabled for servo in servos):
            fastest.append(np.abs(arm.qd).max())
        advance(servos, seconds)

    arm.advance = watched
    ends(bus, teleoperator)
    assert not any(servo.torque_enabled for servo in bus.servos)
    off = arm.q.copy()
    bus.advance(RELEASED)
    return np.degrees(np.abs(arm.q - off)), max(fastest), np.degrees(np.abs(off - posture).max())


def by_ctrl_c(bus, teleoperator):
    # A shell lets what it starts in the background ignore it.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    with pytest.raises(KeyboardInterrupt):
        teleoperator.loop.dynamics = lambda q, qd: signal.raise_signal(signal.SIGINT)
        teleoperator.tick()
    signal.signal(signal.SIGINT, before)


def by_a_bus_that_was_lost(bus, teleoperator):
    bus.deaf = bus.mute = True
    bus.clock.at(0.5, lambda: setattr(bus, "deaf", False) or setattr(bus, "mute", False))
    teleoperator.config.release_time = 3.0
    with pytest.raises(BusLost):
        run(teleoperator, 5)


@pytest.mark.parametrize("gears", [SCENE_GEARS, LEADER_GEARS], ids=["scene", "leader"])
def test_an_arm_that_is_disconnected_comes_down_and_does_not_fall(bench, postures, gears):
    some = postures if gears == LEADER_GEARS else postures[::2]
    results = [comes_down(bench, posture, gears, lambda _, teleoperator: teleoperator.disconnect()) for posture in some]
    fall, speed, way = (np.array(each) for each in zip(*results, strict=True))
    assert (fall <= FALL_BAR).all() and speed.max() <= SPEED_BAR and way.min() > FALL, (fall, speed, way)


@pytest.mark.parametrize("ends", [by_ctrl_c, by_a_bus_that_was_lost])
def test_an_arm_does_not_fall_however_its_loop_ends(bench, postures, ends):
    for posture in postures[3:5]:
        fall, speed, way = comes_down(bench, posture, LEADER_GEARS, ends)
        assert (fall <= FALL_BAR).all() and speed <= SPEED_BAR and way > FALL, (fall, speed, way)


def test_the_measure_of_a_fall_finds_one(bench, postures, monkeypatch):
    """As the arm ended before: its torque is switched off at once."""
    monkeypatch.setattr(Lowering, "run", lambda self, wire, clock: wire.release(5))
    fall, _, _ = comes_down(bench, postures[3], LEADER_GEARS, lambda _, teleoperator: teleoperator.disconnect())
    assert fall.max() > 20.0 * FALL_BAR
