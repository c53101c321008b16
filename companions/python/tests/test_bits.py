"""float32 has the bits of the host's and so of the target's programs, which agree by the tests of
the library."""

import os
import subprocess

import numpy as np
import pytest

import machines
import robot_dynamics as rd
from trees import states

PROGRAM = os.environ.get("ROBOT_DYNAMICS_BITS")
QUANTITIES = ["rnea", "bias", "gravity", "crba", "aba", "forward_dynamics"]

pytestmark = pytest.mark.skipif(PROGRAM is None, reason="ROBOT_DYNAMICS_BITS names the referee, as check does")


def firmware(robot, quantity, rows):
    packed = np.concatenate(rows, axis=1).astype("<f4")
    done = subprocess.run([PROGRAM, getattr(robot, "name", robot), quantity], input=packed.tobytes(), capture_output=True, check=True)
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
    # Bits, but that zeros have no sign: a scene without gravity adds a zero where firmware adds
    # nothing.
    assert (found + np.float32(0)).tobytes() == (expected + np.float32(0)).tobytes()
    if quantity in ("rnea", "crba", "aba", "forward_dynamics"):
        assert found.tobytes() == expected.tobytes()


def joined(*parts):
    """Results of a batch, one after the other of each state."""
    return np.concatenate([part.reshape(len(part), -1) for part in parts], axis=1)


def factored(robot, q, tau):
    l, d_inv = robot.ltdl(robot.crba(q))
    return joined(l, d_inv, robot.solve(l, d_inv, tau), robot.inverse(l, d_inv))


def by_roots(robot, q, tau):
    l, l_inv = robot.cholesky(robot.crba(q))
    return joined(l_inv, robot.cholesky_solve(l, l_inv, tau))


ALGORITHMS = {
    "ltdl": lambda robot, q, v, a, tau: factored(robot, q, tau),
    "rnea_and_wrenches": lambda robot, q, v, a, tau: joined(*robot.rnea_and_wrenches(q, v, a)),
    "cholesky": lambda robot, q, v, a, tau: by_roots(robot, q, tau),
    "spatial_operator": lambda robot, q, v, a, tau: joined(*robot.spatial_operator_ltdl(q), robot.spatial_operator_inverse(q)),
    "crba_jacobian": lambda robot, q, v, a, tau: joined(*robot.crba_jacobian(q, robot.bodies[-1])),
    "forward_dynamics_with_error": lambda robot, q, v, a, tau: joined(*robot.forward_dynamics_with_error(q, v, tau)),
    "rnea_derivatives": lambda robot, q, v, a, tau: joined(*robot.rnea_derivatives(q, v, a)),
    "forward_dynamics_derivatives": lambda robot, q, v, a, tau: joined(*robot.forward_dynamics_derivatives(q, v, tau)[:2]),
    "regressor_row": lambda robot, q, v, a, tau: robot.regressor_row(q, v, a, robot.nv - 1),
    "friction_regressor": lambda robot, q, v, a, tau: robot.friction_regressor(v, 0.3),
    "elastic_inverse_dynamics": lambda robot, q, v, a, tau: joined(
        *robot.elastic_inverse_dynamics(q, v, a, tau, tau, *([x] * robot.nv for x in (1e4, 0.7, 3.0)))
    ),
}


@pytest.mark.parametrize("quantity", ALGORITHMS)
@pytest.mark.parametrize("name", rd.robots())
def test_other_algorithms_have_the_bits_of_the_library(name, quantity):
    if quantity.startswith("elastic") and name.endswith("free"):
        pytest.skip("of joints of one coordinate")
    robot = rd.Robot(name)
    rows = [x.astype(np.float32) for x in states(robot, 100)]
    found, expected = ALGORITHMS[quantity](robot, *rows).ravel(), firmware(robot, f"algorithms {quantity}", rows)
    if "derivatives" in quantity:  # a zero of few entries has another sign
        found, expected = found + np.float32(0), expected + np.float32(0)
    assert found.tobytes() == expected.tobytes()


def test_loops_and_linkages_have_the_bits_of_the_library():
    robot = machines.bars()
    loops, linkages = rd.Loops(robot, [machines.pin()], [0]), rd.Linkages(robot, [("bars", machines.four_bar(), [0, 1, 2])])
    random = np.random.default_rng(5)
    y, yd, ydd, tau = (random.uniform(-3.0, 3.0, (200, 1)) for _ in range(4))
    closed, rates, *_ = linkages.motion(y, yd, ydd)
    q, qd, y, yd, ydd, tau = (x.astype(np.float32) for x in (loops.assemble(closed), rates, y, yd, ydd, tau))
    rows = [q, qd, np.repeat(ydd, 3, axis=1), np.repeat(tau, 3, axis=1)]
    inverse = joined(*loops.inverse_dynamics(q, qd[:, :1].copy(), ydd)[:4])
    assert inverse.ravel().tobytes() == firmware("bars", "loops inverse", rows).tobytes()
    forward = joined(*loops.forward_dynamics(q, qd, tau, stabilisation=[100.0, 20.0])[:2])
    assert forward.ravel().tobytes() == firmware("bars", "loops forward", rows).tobytes()
    rows = [np.repeat(x, 3, axis=1) for x in (y, yd, ydd, tau)]
    assert linkages.rnea(y, yd, ydd).tobytes() == firmware("bars", "linkages", rows).tobytes()


def test_linkages_on_a_chain_have_the_bits_of_the_library():
    robot = rd.Robot("ur5e")
    wrist = rd.Linkages(robot, [("wrist", rd.Differential([1.0, 2.5]), [4, 5])])
    rows = [x.astype(np.float32) for x in states(robot, 200)]
    assert wrist.rnea(*rows[:3]).tobytes() == firmware("wrist", "rnea", rows).tobytes()


def test_links_that_bend_have_the_bits_of_the_library():
    boom, random = machines.boom(), np.random.default_rng(6)
    q, qd, qdd, tau = (random.uniform(-2.0, 2.0, (200, 2)).astype(np.float32) for _ in range(4))
    eta, etad, etadd = (random.uniform(-0.05, 0.05, (200, 3)).astype(np.float32) for _ in range(3))
    rows = [q, qd, qdd, tau, eta, etad, etadd]
    inverse = joined(*boom.rnea(q, qd, qdd, eta, etad, etadd))
    assert inverse.ravel().tobytes() == firmware("boom", "rnea", rows).tobytes()
    forward = joined(*boom.forward_dynamics(q, qd, tau, eta, etad))
    assert forward.ravel().tobytes() == firmware("boom", "forward", rows).tobytes()


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
