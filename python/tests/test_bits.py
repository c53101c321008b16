"""float32 has the bits of the host's and so of the target's programs, of which the step `bits` says that they agree."""

import os
import subprocess

import numpy as np
import pytest

import robot_dynamics as rd
from trees import states

PROGRAM = os.environ.get("ROBOT_DYNAMICS_BITS")
QUANTITIES = ["rnea", "bias", "gravity", "crba", "aba", "forward_dynamics"]

pytestmark = pytest.mark.skipif(PROGRAM is None, reason="ROBOT_DYNAMICS_BITS names the referee, as test.py does")


def firmware(robot, quantity, rows):
    packed = np.concatenate(rows, axis=1).astype("<f4")
    done = subprocess.run([PROGRAM, robot.name, quantity], input=packed.tobytes(), capture_output=True, check=True)
    return np.frombuffer(done.stdout, "<f4")


def ours(robot, quantity, rows):
    q, v, a, tau = rows
    call = getattr(robot, quantity)
    given = {"rnea": (q, v, a), "bias": (q, v), "gravity": (q,), "crba": (q,)}.get(quantity, (q, v, tau))
    return call(*given)


@pytest.mark.parametrize("quantity", QUANTITIES)
@pytest.mark.parametrize("name", rd.robots())
def test_single_precision_has_the_bits_of_core(name, quantity):
    robot = rd.Robot(name)
    rows = [x.astype(np.float32) for x in states(robot, 1000)]
    expected = firmware(robot, f"core {quantity}", rows)
    found = ours(robot, quantity, rows).ravel()
    # Bits, but that zeros have no sign: a scene without gravity adds a zero where firmware adds nothing.
    assert (found + np.float32(0)).tobytes() == (expected + np.float32(0)).tobytes()
    if quantity in ("rnea", "crba", "aba", "forward_dynamics"):
        assert found.tobytes() == expected.tobytes()


@pytest.mark.parametrize("quantity", ["rnea", "aba"])
@pytest.mark.parametrize("name", ["ur5e", "a1", "a1_free"])
def test_spinning_rotors_have_the_bits_of_core(name, quantity):
    robot = rd.Robot(name)
    rows = [x.astype(np.float32) for x in states(robot, 1000)]
    inertia = np.where(np.arange(robot.nv) < 6 * name.endswith("free"), 0.0, np.float32(1e-4))
    scene = rd.RIGID_BODY + rd.GyroscopicRotors(inertia, 5.0 - 2.0 * np.arange(robot.nv))
    q, v, a, tau = rows
    found = robot.rnea(q, v, a, scene) if quantity == "rnea" else robot.aba(q, v, tau, scene)
    assert found.tobytes() == firmware(robot, f"core {quantity} spinning", rows).tobytes()
    assert found.tobytes() != ours(robot, quantity, rows).tobytes()


def test_another_state_has_other_bits():
    robot = rd.Robot("ur5e")
    rows = [x.astype(np.float32) for x in states(robot, 10)]
    expected = firmware(robot, "core rnea", rows)
    rows[0] = np.nextafter(rows[0], np.float32(9))
    assert ours(robot, "rnea", rows).tobytes() != expected.tobytes()


@pytest.mark.parametrize("quantity", ["rnea", "bias", "gravity"])
@pytest.mark.parametrize("name", [name for name in rd.robots() if not name.startswith("g1")])
def test_the_engine_has_the_bits_of_engine(name, quantity):
    robot = rd.Robot(name)
    rows = [x.astype(np.float32) for x in states(robot, 1000)]
    expected = firmware(robot, f"engine {quantity}", rows)
    given = {"rnea": rows[:3], "bias": rows[:2], "gravity": rows[:1]}[quantity]
    found = getattr(robot, quantity)(*given, form="engine")
    assert found.tobytes() == expected.tobytes()
    core = getattr(robot, quantity)(*given)
    assert np.abs(found - core).max() < 1e-5 * np.abs(core).max()


def test_the_engine_says_what_it_does_not_have():
    q = np.zeros(6)
    robot = rd.Robot("ur5e")
    with pytest.raises(rd.EffectError, match="RIGID_BODY"):
        robot.rnea(q, q, q, rd.Gravity() + rd.Viscous([1.0] * 6), form="engine")
    for other, form in ((rd.Robot("g1"), "engine"), (robot, "fast")):
        with pytest.raises(rd.NoEngine) as error:
            other.gravity(np.zeros(other.nq), form=form)
        assert error.value.robot == other.name
