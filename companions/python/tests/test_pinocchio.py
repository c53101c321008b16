"""float64 against Pinocchio, on robots of random shape: fixed and floating base, chains and
trees."""

import numpy as np
import pytest

import robot_dynamics as rd
from trees import Peer, states, urdf

pin = pytest.importorskip("pinocchio")

# Within this share of the largest entry.
FULL_SCALE = 1e-12
ROBOTS = {
    "arm": (dict(seed=1, joints=6, chain=True, kinds=("revolute",)), False),
    "turning": (dict(seed=2, joints=7, chain=True, kinds=("revolute", "continuous")), False),
    "tree": (dict(seed=3, joints=12, kinds=("revolute",)), False),
    "mixed": (dict(seed=4, joints=10), False),
    "large": (dict(seed=5, joints=40), False),
    "floating": (dict(seed=6, joints=8, kinds=("revolute", "prismatic")), True),
    "walker": (dict(seed=7, joints=29, kinds=("revolute",)), True),
    "integers": (dict(seed=4, joints=10), False),
}


@pytest.fixture(params=ROBOTS, scope="module")
def pair(request):
    shape, free = ROBOTS[request.param]
    text = urdf(**shape)
    robot = rd.Robot.from_text(text, free_base=free, exact=False)
    given = states(robot, 20)
    return robot, Peer(text, free), tuple(x.astype(int) for x in given) if request.param == "integers" else given


def near(found, expected, share=FULL_SCALE):
    scale = np.abs(expected).max()
    assert np.abs(found - expected).max() <= share * scale


def matrix(peer, robot, m):
    """A matrix of Pinocchio's velocity coordinates in ours."""
    columns = np.array([peer.back(robot, row) for row in m])
    return np.array([peer.back(robot, column) for column in columns.T]).T


def test_inverse_dynamics_is_pinocchios(pair):
    robot, peer, (q, v, a, _) = pair

    def theirs(function, positions, *rates):
        """The peer's results for each state, in our order of coordinates."""
        rows = zip(positions, *rates)
        given = [(peer.q(robot, x), *(peer.v(robot, y) for y in more)) for x, *more in rows]
        return np.array([peer.back(robot, function(peer.model, peer.data, *row)) for row in given])

    near(robot.rnea(q, v, a), theirs(pin.rnea, q, v, a))
    near(robot.bias(q, v), theirs(pin.nonLinearEffects, q, v))
    near(robot.gravity(q), theirs(pin.computeGeneralizedGravity, q))


def test_wrenches_in_joints_are_pinocchios(pair):
    robot, peer, (q, v, a, _) = pair
    torques, wrenches = robot.rnea_and_wrenches(q, v, a)
    near(torques, robot.rnea(q, v, a))
    names = ["root_joint", *robot.joints[1:]] if peer.free else robot.joints
    joints = [peer.model.getJointId(name) for name in names]
    for x, y, z, found in zip(q, v, a, wrenches):
        pin.rnea(peer.model, peer.data, peer.q(robot, x), peer.v(robot, y), peer.v(robot, z))
        forces = [peer.data.f[joint] for joint in joints]
        near(found, np.array([np.concatenate([force.angular, force.linear]) for force in forces]))


def test_inertia_matrix_is_pinocchios(pair):
    robot, peer, (q, *_) = pair
    for x, m in zip(q, robot.crba(q)):
        found = pin.crba(peer.model, peer.data, peer.q(robot, x))
        found = np.triu(found) + np.triu(found, 1).T
        near(m, matrix(peer, robot, found))
        near(robot.inverse_mass(x) @ m, np.eye(robot.nv), 1e-9)


def test_factors_and_solutions_are_numpys(pair):
    robot, _, (q, _, _, tau) = pair
    for x, t in zip(q[:5], tau):
        m = robot.crba(x)
        share = np.linalg.cond(m) * 2.0**-50
        (l, d_inv), (root, l_inv) = robot.ltdl(m), robot.cholesky(m)
        assert np.array_equal(l, np.tril(l)) and np.array_equal(root, np.tril(root))
        near(l.T @ np.diag(1.0 / d_inv) @ l, m)
        near(root.T @ root, m)
        near(1.0 / l_inv, np.diag(root))
        for found in (robot.solve(l, d_inv, t), robot.cholesky_solve(root, l_inv, t)):
            near(found, np.linalg.solve(m, t), share)
        for found in (robot.inverse(l, d_inv), robot.inverse_mass(x), robot.spatial_operator_inverse(x)):
            near(found, np.linalg.inv(m), share)
        again, d_again = robot.spatial_operator_ltdl(x)
        near(again, l, share)
        near(d_again, d_inv, share)
        both, jacobian = robot.crba_jacobian(x, robot.bodies[-1])
        near(both, m)
        near(jacobian, robot.jacobian(x, robot.bodies[-1]))


def test_estimated_errors_bound_those_of_float32(pair):
    robot, _, (q, v, _, tau) = pair
    single = [x.astype(np.float32) for x in (q, v, tau)]
    found, estimate = robot.forward_dynamics_with_error(*single)
    assert np.array_equal(found, robot.forward_dynamics(*single))
    m = robot.crba(single[0])
    terms = np.abs(single[2]) + np.abs(robot.bias(*single[:2]))
    assert np.array_equal(robot.acceleration_error(m, *robot.ltdl(m), found, terms), estimate)
    exact = robot.forward_dynamics(*(x.astype(float) for x in single))
    off, most = np.abs(found - exact).max(axis=1), estimate.max(axis=1)
    assert (off <= most).all() and off.max() > 1e-3 * most.max()


def test_elastic_joints_are_the_derivatives_of_torque(pair):
    """θ = q + τ/k and τ_m = J θ̈ + b θ̇ + τ, with τ̇ and τ̈ by differences along a polynomial."""
    robot, _, (q, v, a, jerk) = pair
    if robot.joint_kinds[0] == "free":
        pytest.skip("of joints of one coordinate")
    snap, k, rotor, b = 0.5 * jerk[0], *(np.full(robot.nv, x) for x in (1e3, 0.3, 2.0))
    scene = rd.RIGID_BODY + rd.Viscous([0.4] * robot.nv) + rd.Payload(robot.bodies[-1], 0.3)
    found = robot.elastic_inverse_dynamics(q[0], v[0], a[0], jerk[0], snap, k, rotor, b, scene)

    def torque(t):
        path = [q[0], v[0], a[0], jerk[0], snap]
        at = [sum(x * t**n / np.prod(range(1, n + 1)) for n, x in enumerate(path[i:])) for i in range(3)]
        return robot.rnea(*at, scene)

    h = 1e-3
    before, now, after = (torque(t) for t in (-h, 0.0, h))
    rate, second = (after - before) / (2 * h), (after - 2 * now + before) / h**2
    near(found[1], q[0] + now / k, 1e-14)
    near(found[2], v[0] + rate / k, 1e-4)
    near(found[0], rotor * (a[0] + second / k) + b * (v[0] + rate / k) + now, 1e-4)


def test_forward_dynamics_is_pinocchios(pair):
    robot, peer, (q, v, _, tau) = pair
    for x, y, t in zip(q, v, tau):
        expected = peer.back(
            robot, pin.aba(peer.model, peer.data, peer.q(robot, x), peer.v(robot, y), peer.v(robot, t))
        )
        # Accelerations are off by the condition of M times the rounding of torques.
        condition = np.linalg.cond(robot.crba(x))
        share = max(FULL_SCALE, condition * 2.0**-50)
        near(robot.aba(x, y, t), expected, share)
        near(robot.forward_dynamics(x, y, t), expected, share)


def test_derivatives_are_pinocchios(pair):
    """For all states at once, and in float32 for states of float32."""
    robot, peer, (q, v, a, tau) = pair
    single = [x.astype(np.float32) for x in (q, v, a, tau)]
    for dtype, share in ((np.float64, FULL_SCALE), (np.float32, 2e-5)):
        x, y, z, t = given = single if dtype is np.float32 else (q, v, a, tau)
        inverse = robot.rnea_derivatives(x, y, z)
        forward = robot.forward_dynamics_derivatives(x, y, t)
        for i, state in enumerate(zip(*(x.astype(float) for x in given))):
            pq, pv, pa, pt = peer.q(robot, state[0]), *(peer.v(robot, x) for x in state[1:])
            expected = [matrix(peer, robot, m) for m in pin.computeRNEADerivatives(peer.model, peer.data, pq, pv, pa)]
            for found, theirs in zip(inverse, expected):
                assert found.dtype == dtype
                near(found[i], theirs, share)
            expected = [matrix(peer, robot, m) for m in pin.computeABADerivatives(peer.model, peer.data, pq, pv, pt)]
            condition = np.linalg.cond(robot.crba(state[0]))
            for found, theirs in zip(forward, expected):
                near(found[i], theirs, max(share, condition * (2.0**-50 if dtype is np.float64 else 2.0**-20)))


def test_kinematics_are_pinocchios(pair):
    robot, peer, (q, v, a, _) = pair
    body = robot.bodies[-1]
    joint = robot.joints[-1]
    index = peer.model.getJointId(joint)
    for x, y, z in zip(q, v, a):
        pq, pv, pa = peer.q(robot, x), peer.v(robot, y), peer.v(robot, z)
        pin.forwardKinematics(peer.model, peer.data, pq, pv, pa)
        pose = peer.data.oMi[index]
        rotations, positions = robot.poses(x)
        near(rotations[-1], pose.rotation)
        near(positions[-1], pose.translation)
        velocities, accelerations = robot.kinematics(x, y, z)
        motion = peer.data.v[index]
        near(velocities[-1], np.concatenate([motion.angular, motion.linear]))
        motion = peer.data.a[index]
        near(accelerations[-1], np.concatenate([motion.angular, motion.linear]))
        pin.computeJointJacobians(peer.model, peer.data, pq)
        for frame, reference in [("local", pin.LOCAL), ("world", pin.WORLD), ("local_world_aligned", pin.LOCAL_WORLD_ALIGNED)]:
            theirs = pin.getJointJacobian(peer.model, peer.data, index, reference)
            rows = np.array([peer.back(robot, row) for row in theirs])
            near(robot.jacobian(x, body, frame), np.vstack([rows[3:], rows[:3]]))


def test_energy_and_momentum_are_pinocchios(pair):
    robot, peer, (q, v, _, _) = pair
    loose = robot.parents[0] is None and robot.joint_kinds[0] == "free"
    for x, y in zip(q, v):
        pq, pv = peer.q(robot, x), peer.v(robot, y)
        near(robot.kinetic_energy(x, y), pin.computeKineticEnergy(peer.model, peer.data, pq, pv))
        pin.computeCentroidalMomentum(peer.model, peer.data, pq, pv)
        found = peer.data.hg
        if loose:
            near(robot.centroidal_momentum(x, y), np.concatenate([found.angular, found.linear]))
            mass, position, velocity = robot.center_of_mass(x, y)
            pin.centerOfMass(peer.model, peer.data, pq, pv)
            near(position, peer.data.com[0])
            near(velocity, peer.data.vcom[0])
            near(robot.centroidal_matrix(x) @ y, robot.centroidal_momentum(x, y))
            near(mass, sum(inertia.mass for inertia in peer.model.inertias))
            up = pin.computePotentialEnergy(peer.model, peer.data, pq)
            near(robot.potential_energy(x), up)


def test_operational_space_is_j_minv_jt(pair):
    robot, _, (q, v, _, _) = pair
    for x, y in zip(q[:5], v):
        j, m_inv = robot.jacobian(x, robot.nv and robot.bodies[-1]), robot.inverse_mass(x)
        expected = j @ m_inv @ j.T
        near(robot.osim_inverse(x, robot.bodies[-1]), expected, 1e-10)
        found_j, response, mobility, _ = robot.operational_space(x, robot.bodies[-1])
        near(found_j, j)
        near(mobility, expected, 1e-10)
        near(response, j @ m_inv, 1e-10)
        bias = robot.bias_acceleration(x, y, robot.bodies[-1])
        _, accelerations = robot.kinematics(x, y, np.zeros(robot.nv))
        near(bias, accelerations[-1])


def test_regressor_times_parameters_is_torque(pair):
    robot, _, (q, v, a, _) = pair
    y = robot.regressor(q[0], v[0], a[0])
    assert y.shape == (robot.nv, len(robot.bodies), 10)
    near(np.tensordot(y, robot.inertial_parameters(), 2), robot.rnea(q[0], v[0], a[0]), 1e-11)
    assert np.array_equal(robot.regressor_columns(q[0], v[0], a[0], robot.bodies[-1]), y[:, -1])
    near(robot.regressor_row(q[0], v[0], a[0], robot.nv - 1), y[-1], 1e-11)
    friction = rd.Viscous([0.5] * robot.nv) + rd.Coulomb([2.0] * robot.nv, 0.3)
    near(robot.friction_regressor(v[0], 0.3) @ [0.5, 2.0], robot.rnea(q[0], v[0], a[0], friction))
    # A load changes the torque by the mass column of its body only: the regressor's first column.
    load = robot.rnea(q[0], v[0], a[0], rd.RIGID_BODY + rd.Payload(robot.bodies[-1], 1.0))
    near(load - robot.rnea(q[0], v[0], a[0]), y[:, -1, 0], 1e-10)


def test_coriolis_matrix_and_momenta_agree_with_bias(pair):
    robot, _, (q, v, _, _) = pair
    for x, y in zip(q[:5], v):
        c = robot.coriolis_matrix(x, y)
        near(c @ y, robot.bias(x, y, rd.Coriolis()), 1e-11)
        p, ct_qd = robot.momentum_and_coriolis(x, y)
        near(p, robot.crba(x) @ y, 1e-11)
        near(ct_qd, c.T @ y, 1e-11)
        _, beta = robot.momentum_and_drift(x, y)
        near(beta, c.T @ y - robot.gravity(x), 1e-11)


def test_hybrid_dynamics_agrees_with_both(pair):
    robot, _, (q, v, _, tau) = pair
    mask = np.arange(robot.nv) % 2.0
    given = np.where(mask == 0.0, tau[0], 1.0)
    torque, acceleration = robot.hybrid_dynamics(q[0], v[0], given, mask)
    near(robot.rnea(q[0], v[0], acceleration), torque, 1e-9)
    assert np.array_equal(acceleration[mask == 1.0], given[mask == 1.0])
    assert np.array_equal(torque[mask == 0.0], given[mask == 0.0])


def test_rotors_that_spin_are_bodies_of_pinocchio():
    """A rotor is a body of its own on the link before its joint, whose inertia counts it as
    locked."""
    text = urdf(seed=8, joints=6, kinds=("revolute", "prismatic"))
    robot, peer = rd.Robot.from_text(text, exact=False), Peer(text)
    q, v, a, tau = states(robot, 20)
    inertia, ratio = np.linspace(1e-3, 5e-3, 6), np.array([6.0, -4.0, 9.0, 40.0, -12.0, 5.0])
    whole = peer.model.copy()
    pin.computeJointJacobians(peer.model, peer.data, pin.neutral(peer.model))
    for i in range(6):
        at, place = peer.model.getJointId(robot.joints[i]), peer.model.jointPlacements[peer.model.getJointId(robot.joints[i])]
        column = pin.getJointJacobian(peer.model, peer.data, at, pin.LOCAL)[:, peer.model.joints[at].idx_v]
        axis = place.rotation @ (column[:3] + column[3:])
        spin, parent = inertia[i] * np.outer(axis, axis), peer.model.parents[at]
        if parent:
            locked = whole.inertias[parent]
            whole.inertias[parent] = pin.Inertia(locked.mass, locked.lever, locked.inertia - spin)
        joint = whole.addJoint(parent, pin.JointModelRevoluteUnaligned(axis), pin.SE3(np.eye(3), place.translation), f"rotor{i}")
        whole.appendBodyToJoint(joint, pin.Inertia(0.0, np.zeros(3), spin), pin.SE3.Identity())
    data, scene = whole.createData(), rd.RIGID_BODY + rd.GyroscopicRotors(inertia, ratio)

    def full(x):
        """The coordinates of joints, and those of rotors behind them."""
        return np.concatenate([peer.v(robot, x), ratio * x])

    def at_joints(t):
        return peer.back(robot, t[:6]) + ratio * t[6:]

    for x, y, z, t in zip(q, v, a, tau):
        state = np.concatenate([peer.q(robot, x), np.zeros(6)]), full(y)
        near(robot.rnea(x, y, z, scene), at_joints(pin.rnea(whole, data, *state, full(z))))
        bias = pin.rnea(whole, data, *state, full(0.0 * z))
        columns = [at_joints(pin.rnea(whole, data, *state, full(unit)) - bias) for unit in np.eye(6)]
        near(robot.crba(x, scene), np.array(columns).T, 1e-11)
        near(robot.kinetic_energy(x, y, scene), pin.computeKineticEnergy(whole, data, *state))
        expected = np.linalg.solve(np.array(columns).T, t - at_joints(bias))
        for found in (robot.aba(x, y, t, scene), robot.forward_dynamics(x, y, t, scene)):
            near(found, expected, 1e-10)
        assert np.abs(robot.aba(x, y, t) - expected).max() > 1e-3 * np.abs(expected).max()


def test_configurations_integrate_and_differ(pair):
    robot, _, (q, v, _, _) = pair
    there = robot.integrate(q, 0.3 * v)
    near(robot.difference(q, there), 0.3 * v, 1e-11)
    assert np.abs(robot.difference(q, q)).max() < 1e-15
    assert robot.neutral().shape == (robot.nq,)
    per_joint = [7 if kind == "free" else 1 for kind in robot.joint_kinds]
    far = q + 2 * np.pi * np.repeat([kind == "continuous" for kind in robot.joint_kinds], per_joint)
    far[:, : 4 * (robot.joint_kinds[0] == "free")] *= 3.0
    near(robot.normalise(far), q, 1e-14)
