"""The torques on the bus are those of the firmware's scene, which were computed without Python."""

import numpy as np
import pytest
from conftest import SCENE_GEARS, TICK, Still, run

from lerobot_teleoperator_so101_floating.motors import LEADER_GEARS

SCENE_LAW = {"friction_share": 1.0, "friction_error": 0.0, "gravity_error": 0.0, "rest_speed": 1e-6, "most_friction": 10.0}
"""The scene's compensation is whole; hand guiding, the default, compensates a share."""
WARM = 250
BAR = 0.01

LAWS = {"scene": (SCENE_GEARS, SCENE_LAW), "leader": (LEADER_GEARS, {})}


def zero(bus):
    """The counts of the joints' zeros."""
    return np.array([servo.zero for servo in bus.servos])


def angles(counts):
    return np.asarray(counts) * (2.0 * np.pi / 4096)


def decoded(bus, stall, first=0):
    """The torques at rest of the duties on the bus, from their bytes, N·m."""
    duties = [[each[servo.identity] for servo in bus.servos] for each in bus.duties[first:]]
    return np.array(duties) / 1000.0 * np.asarray(stall)


def floats_at(bench, arm, law, **more):
    gears, options = LAWS[law]
    bus, teleoperator = bench.floating(arm, gears, supply=7.4, **options, **more)
    run(teleoperator, WARM)
    return bus, teleoperator


def off_at_rest(bench, scene, law, postures, **options):
    """The largest error of a mean torque as a share of the joint's own, and of one tick's as a
    share of the arm's largest."""
    arm = Still(angles(postures[0]["counts"]))
    bus, teleoperator = floats_at(bench, arm, law, **options)
    worst, rounding = 0.0, 0.0
    for posture in postures:
        # The hand moves the arm there, and holds it until the estimate is at rest.
        arm.rows, arm.row = np.linspace(arm.q, angles(posture["counts"]), 200), -1
        run(teleoperator, 500)
        wanted = np.array(posture["commands"][law])
        sent = decoded(bus, scene["stall"][law], -200)
        # Joints that hardly carry anything are held to a share of 10 mN·m, three steps of the duty.
        shares = np.abs(sent.mean(axis=0) - wanted) / np.maximum(np.abs(wanted), 0.01)
        worst = max(worst, shares.max())
        rounding = max(rounding, np.abs(sent - wanted).max() / np.abs(wanted).max())
    return worst, rounding


@pytest.mark.parametrize("law", LAWS)
def test_torques_at_rest_are_the_scenes(bench, scene, law):
    worst, rounding = off_at_rest(bench, scene, law, scene["postures"])
    assert worst <= BAR and rounding <= BAR, (worst, rounding)


def test_the_comparison_finds_a_model_that_is_two_per_cent_off(bench, scene):
    assert off_at_rest(bench, scene, "leader", scene["postures"][:2], gravity_scale=(1.02,) * 6)[0] > BAR


@pytest.mark.parametrize("law", LAWS)
def test_torques_in_motion_are_the_scenes(bench, scene, law):
    assert abs(scene["tick"] - TICK) < 1e-6 and abs(scene["bandwidth"] - 30.0) < 1e-6
    path = [row["counts"] for row in scene["path"]]
    wanted = np.array([row["commands"][law] for row in scene["path"]])
    arm = Still(angles(path[0]))
    bus, teleoperator = floats_at(bench, arm, law)
    arm.rows, arm.row = angles(path), -1
    first = len(bus.duties)
    for _ in path:
        teleoperator.tick()
    sent = decoded(bus, scene["stall"][law], first)
    assert sent.shape == wanted.shape
    largest = np.abs(wanted).max(axis=0)
    # Over 50 ms, which the rotors cannot follow, the steps of the duty are gone.
    window = np.ones(10) / 10.0
    smooth = np.array([np.convolve(off, window, "valid") for off in (sent - wanted).T]).T
    each = (np.abs(smooth).max(axis=0) / largest).max()
    whole = np.abs(sent - wanted).max() / largest.max()
    assert each <= BAR and whole <= BAR, (np.abs(smooth).max(axis=0) / largest, whole)
    # The check is one: the torque of friction alone is more than the bar.
    gravity = np.array([row["commands"]["gravity"] for row in scene["path"]])
    assert (np.abs(wanted - gravity).max(axis=0) > 5.0 * BAR * largest).all()


def test_a_supply_that_is_measured_gives_the_same_torque(bench, scene):
    """A lower supply takes a larger duty."""
    posture = scene["postures"][3]
    arm = Still(angles(posture["counts"]))
    bus = bench.bus(arm, supply=5.0)
    teleoperator = bench.teleoperator(bus, **SCENE_LAW)
    teleoperator.connect(calibrate=False)
    run(teleoperator, 500)
    sent = decoded(bus, np.array(scene["stall"]["scene"]) * 5.0 / 7.4, -200).mean(axis=0)
    assert np.abs(sent - posture["commands"]["scene"]).max() <= BAR * np.abs(posture["commands"]["scene"]).max()


def test_the_observer_and_the_model_are_the_firmwares(bench, scene):
    """Before duties are rounded, to the rounding of f32."""
    from lerobot_teleoperator_so101_floating.dynamics import floating_dynamics
    from lerobot_teleoperator_so101_floating.law import Observer
    from lerobot_teleoperator_so101_floating.motors import Motors

    observer, motors = Observer(30.0, TICK), Motors(SCENE_GEARS)
    dynamics = floating_dynamics(motors, None)
    for row in scene["path"]:
        q, qd = observer.update(angles(row["counts"]))
        assert np.abs(q - row["commands"]["q"]).max() < 1e-5 and np.abs(qd - row["commands"]["qd"]).max() < 2e-4
        gravity, friction = dynamics(q, qd)
        command = gravity + friction + motors.back_emf * qd
        assert np.abs(gravity - row["commands"]["gravity"]).max() < 1e-5
        assert np.abs(command - row["commands"]["scene"]).max() < 5e-4
