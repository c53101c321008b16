"""The quantities that are recorded of the first states beyond ID, FD and M. "Tip" is the last body listed; every body counts
in masses and momenta, also one that is welded to the base. Layouts: recordings.rs."""

import numpy as np
import pinocchio as pin
from by_hand import close, symmetric, totals
from joints import SIZES, SWAP, rows, six

ONE_DOF = ("revolute", "continuous", "prismatic", "helical")


def upper(matrix):
    return matrix[np.triu_indices(len(matrix))]


def coarse(rng, n, bound):
    """Random multiples of bound/128: short to write, exact in f32 if bound is a power of two."""
    return np.array([rng.randrange(-128, 129) / 128 * bound for _ in range(n)])


def power_of_two(x):
    return 2.0 ** round(np.log2(x)) if x > 0 else 0.0


def armature(order, rng):
    """Rotor inertias behind the gear of joints of one degree of freedom, kg m²; else 0."""
    values = []
    for kind in order.kinds:
        one = kind in ONE_DOF
        values += [rng.randrange(1, 65) / 1024] if one else [0.0] * SIZES[kind][1]
    return np.array(values)


def wrenches(robot, rng):
    """On every body about ten times its weight in N, a quarter of that in N m."""
    found = []
    for body in robot["bodies"]:
        bound = power_of_two(100 * body["mass"])
        found.append(np.concatenate([coarse(rng, 3, bound / 4), coarse(rng, 3, bound)]))
    return np.array(found)


def inputs(robot, order, rng):
    n = len(order.at)
    return {
        "wrenches": wrenches(robot, rng),
        "base_velocity": coarse(rng, 6, 2.0),
        "base_acceleration": coarse(rng, 6, 8.0),
        "step": coarse(rng, n, 1.0),
    }


def in_series(bodies):
    """The bodies with every universal joint as two revolute ones, which have the same coordinates."""
    found, place = [], {-1: -1}
    for i, body in enumerate(bodies):
        body = {**body, "parent": place[body["parent"]]}
        if body["joint"] == "universal":
            body["joint"], massless = "revolute", {"mass": 0.0, "com": [0.0] * 3, "inertia_com": [0.0] * 6}
            found.append({**body, "name": f"cross of {body['name']}", **massless})
            still = {"rotation": np.eye(3).ravel(), "position": [0.0] * 3}
            body.update({"axis": body["axis2"], "parent": len(found) - 1, "placement": still})
        place[i] = len(found)
        found.append(body)
    return found


class Plant:
    """A robot as Pinocchio has it, and variants of it."""

    def __init__(self, robot, build):
        self.robot = robot
        self.model, self.bodies, self.order = build(robot)
        joint, on_joint = self.bodies[-1]
        frame = pin.Frame("last body", joint, 0, on_joint, pin.FrameType.OP_FRAME)
        self.tip = self.model.addFrame(frame, False)  # its inertia, zero, would move a last bit if added
        # A massless body on a free joint in front of all: the moving base.
        below = [{**body, "parent": body["parent"] + 1} for body in robot["bodies"]]
        base = {
            **{"name": "base", "parent": -1, "joint": "free", "axis": [0.0] * 3},
            **{"placement": {"rotation": np.eye(3).ravel(), "position": [0.0] * 3}},
            **{"mass": 0.0, "com": [0.0] * 3, "inertia_com": [0.0] * 6},
        }
        self.carried, _, self.carried_order = build({**robot, "bodies": [base] + below})
        self.geared = self.model.copy()
        # Pinocchio 4.1 leaves out of C that the first axis of a universal joint moves in the body.
        self.in_series, _, self.in_series_order = build({**robot, "bodies": in_series(robot["bodies"])})

    def with_armature(self, values):
        self.geared.armature = self.order.v(values)


def parameters(robot):
    """m, m c, and the inertia about the origin (xx, xy, yy, xz, yz, zz) of every body, in its own frame."""
    of = lambda body: pin.Inertia(body["mass"], np.array(body["com"]), symmetric(body["inertia_com"]))
    return np.concatenate([of(body).toDynamicParameters() for body in robot["bodies"]])


def regressor(plant, Q, V, A):
    """Y with ID = Y φ: our coordinates by bodies, ten columns each. Pinocchio's has only the bodies on joints that move."""
    robot, model, order = plant.robot, plant.model, plant.order
    data = model.createData()
    joints = np.array(pin.computeJointTorqueRegressor(model, data, Q, V, A)).reshape(model.nv, -1, 10)
    pin.computeJointJacobians(model, data, Q)
    found = np.zeros((model.nv, len(robot["bodies"]), 10))
    for i, (body, (joint, on_joint)) in enumerate(zip(robot["bodies"], plant.bodies)):
        if body["joint"] != "fixed":
            found[:, i] = joints[:, joint - 1]
        elif joint > 0:  # the wrench of the welded body, brought to the joint that carries it
            wrench = pin.bodyRegressor(on_joint.actInv(data.v[joint]), on_joint.actInv(data.a_gf[joint]))
            at_joint = pin.getJointJacobian(model, data, joint, pin.LOCAL)
            found[:, i] = at_joint.T @ on_joint.toDualActionMatrix() @ wrench
    return found[order.at]


def of_state(plant, q, qd, qdd, tau, next_q, more):
    """Every quantity of one state, as flat rows. `more` has the other inputs."""
    robot, model, order, tip = plant.robot, plant.model, plant.order, plant.tip
    data, n = model.createData(), model.nv
    Q, V, A, T = order.q(q), order.v(qd), order.v(qdd), order.v(tau)
    row = {key: np.ravel(values) for key, values in more.items()}
    frames = {"local": pin.LOCAL, "world": pin.WORLD, "mixed": pin.LOCAL_WORLD_ALIGNED}

    # Kinematics of the tip.
    pin.forwardKinematics(model, data, Q, V, A)
    pin.updateFramePlacements(model, data)
    pose = data.oMf[tip]
    row["tip_pose"] = np.concatenate([pose.rotation.ravel(), pose.translation])
    row["tip_velocity"] = six(pin.getFrameVelocity(model, data, tip, pin.LOCAL))
    row["tip_acceleration"] = six(pin.getFrameAcceleration(model, data, tip, pin.LOCAL))
    jacobians = {}
    for name, frame in frames.items():
        jacobians[name] = order.v_back(rows(pin.computeFrameJacobian(model, data, Q, tip, frame)))
        row[f"jacobian_{name}"] = jacobians[name].T.ravel()
    pin.forwardKinematics(model, data, Q, V, np.zeros(n))
    for name, frame in frames.items():
        row[f"drift_{name}"] = six(pin.getFrameAcceleration(model, data, tip, frame))
    row["drift_mixed"] = six(pin.getFrameClassicalAcceleration(model, data, tip, frames["mixed"]))
    close(robot, "tip velocity", row["tip_velocity"], jacobians["local"] @ qd)
    close(robot, "tip acceleration", row["tip_acceleration"], jacobians["local"] @ qdd + row["drift_local"])

    # Energy and momentum; Pinocchio leaves out what is welded to the base.
    welded, free_fall = model.inertias[0], model.gravity.linear
    pin.centerOfMass(model, data, Q)
    pin.ccrba(model, data, Q, V)
    moving, mass = data.mass[0], data.mass[0] + welded.mass
    com = (moving * data.com[0] + welded.mass * welded.lever) / mass
    row["kinetic_energy"] = [pin.computeKineticEnergy(model, data, Q, V)]
    row["potential_energy"] = [pin.computePotentialEnergy(model, data, Q) - welded.mass * free_fall @ welded.lever]
    row["centre_of_mass"] = com
    about_moving = rows(data.Ag)
    shift = lambda matrix, arm: np.vstack([matrix[:3] + np.cross(arm, matrix[3:].T).T, matrix[3:]])
    centroidal = order.v_back(shift(about_moving, data.com[0] - com))
    row["momentum"] = shift(six(data.hg).reshape(6, 1), data.com[0]).ravel()
    row["centroidal_momentum"] = shift(six(data.hg).reshape(6, 1), data.com[0] - com).ravel()
    row["centroidal_matrix"] = centroidal.T.ravel()
    matrix = order.square(pin.crba(model, data, Q))
    by_hand = totals(robot, q, free_fall, more["wrenches"])
    close(robot, "kinetic energy", row["kinetic_energy"], [qd @ matrix @ qd / 2])
    close(robot, "potential energy", row["potential_energy"], [-by_hand[0] * free_fall @ by_hand[1]])
    close(robot, "centre of mass", com, by_hand[1])
    close(robot, "centroidal momentum", row["centroidal_momentum"], centroidal @ qd)

    # Generalised momentum M q̇ and Cᵀ q̇. C is one whose C q̇ is that of ID and whose C + Cᵀ is Ṁ.
    series, along = plant.in_series, plant.in_series_order
    forked, there = series.createData(), (along.q(q), along.v(qd))
    coriolis = np.array(pin.computeCoriolisMatrix(series, forked, *there))[np.ix_(along.at, along.at)]
    products = order.v_back(pin.rnea(model, data, Q, V, np.zeros(n)) - pin.rnea(model, data, Q, 0 * V, np.zeros(n)))
    later = lambda t: order.square(pin.crba(model, data, pin.integrate(model, Q, t * V)))
    h = 1e-3
    rate = (8 * (later(h) - later(-h)) - (later(2 * h) - later(-2 * h))) / (12 * h)
    close(robot, "C q̇", coriolis @ qd, products)
    close(robot, "C + Cᵀ", coriolis + coriolis.T, rate, 1e-8)
    row["generalised_momentum"], row["coriolis_transposed"] = matrix @ qd, coriolis.T @ qd

    # ∂ID/∂q along the right increments of q, and ∂ID/∂q̇.
    both = pin.computeRNEADerivatives(series, forked, *there, along.v(qdd))[:2]
    row["rnea_by_q"], row["rnea_by_qd"] = (np.array(by)[np.ix_(along.at, along.at)].ravel() for by in both)
    torque = lambda q_then, v_then: order.v_back(pin.rnea(model, data, q_then, v_then, A))
    at = lambda t: torque(pin.integrate(model, Q, t * V), (1 + t) * V)
    slope = (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h)
    along_v = (row["rnea_by_q"] + row["rnea_by_qd"]).reshape(n, n) @ qd
    close(robot, "derivatives of ID", along_v, slope, 1e-8)

    row["regressor"] = regressor(plant, Q, V, A).ravel()
    close(robot, "regressor", row["regressor"].reshape(n, -1) @ parameters(robot), order.v_back(pin.rnea(model, data, Q, V, A)))

    # M⁻¹ and the inertia that the tip feels.
    inverse = order.square(pin.computeMinverse(model, data, Q))
    condition = np.linalg.cond(matrix)
    close(robot, "inverse of M", inverse @ matrix, np.eye(n), condition * 1e-14)
    row["inverse_mass_matrix"] = upper(inverse)
    row["operational_inverse"] = upper(jacobians["local"] @ inverse @ jacobians["local"].T)

    # Forces on the bodies.
    forces = [pin.Force.Zero() for _ in range(model.njoints)]
    for (joint, on_joint), wrench in zip(plant.bodies, more["wrenches"]):
        forces[joint] += on_joint.act(pin.Force(wrench[SWAP]))
    forces = pin.StdVec_Force(forces)
    row["rnea_wrenches"] = order.v_back(pin.rnea(model, data, Q, V, A, forces))
    row["reactions"] = np.concatenate([six(f) for f in list(data.f)[1:]])
    row["aba_wrenches"] = order.v_back(pin.aba(model, data, Q, V, T, forces))
    plain = order.v_back(pin.rnea(model, data, Q, V, A))
    close(robot, "torque of wrenches", row["rnea_wrenches"], plain - by_hand[4])

    # A base that moves, as seen in its own frame, which is the world's at this moment.
    carried, ahead = plant.carried, plant.carried_order
    base = carried.createData()
    place = ahead.q(np.concatenate([[0, 0, 0, 1, 0, 0, 0], q]))
    moving = lambda v0, a0, qd, qdd: ahead.v_back(
        pin.rnea(carried, base, place, ahead.v(np.concatenate([v0, qd])), ahead.v(np.concatenate([a0, qdd])))
    )
    both = moving(more["base_velocity"], more["base_acceleration"], qd, qdd)
    row["base_wrench"], row["rnea_moving_base"] = both[:6], both[6:]
    still = np.zeros(n)
    lifted = moving(np.zeros(6), np.concatenate([np.zeros(3), -free_fall]), still, still)[6:]
    close(robot, "torque as the base is lifted by g", lifted, 2 * by_hand[3])

    # Rotors.
    geared = plant.geared.createData()
    row["rnea_armature"] = order.v_back(pin.rnea(plant.geared, geared, Q, V, A))
    row["aba_armature"] = order.v_back(pin.aba(plant.geared, geared, Q, V, T))
    rotors = order.v_back(plant.geared.armature)
    solved = np.linalg.solve(matrix + np.diag(rotors), tau - plain + matrix @ qdd)
    close(robot, "torque of rotors", row["rnea_armature"], plain + rotors * qdd)
    close(robot, "acceleration with rotors", row["aba_armature"], solved, condition * 1e-14)

    # The manifold of configurations. Turns are counted, as Pinocchio's (cos, sin) cannot; but not
    # in a difference, which goes the shorter way round.
    moved = order.q_back(pin.integrate(model, Q, order.v(more["step"])))
    difference = order.v_back(pin.difference(model, Q, order.q(next_q)))
    for kind, q_at, v_at in order.places():
        if kind in ("continuous", "planar"):
            moved[q_at] = q[q_at] + more["step"][v_at]
        if kind == "continuous":
            apart = next_q[q_at] - q[q_at]
            difference[v_at] = apart - 2 * np.pi * np.round(apart / (2 * np.pi))
    row["integrated"], row["difference"] = moved, difference
    return row
