#!/usr/bin/env python3
"""Records what Pinocchio says of machines with kinematic loops.

    cargo run -p loop-tests --bin export_machines | .venv/bin/python host-tests/oracle/loops.py

builds the trees as record.py does, closes them by constraints of three coordinates at a point (all that a planar linkage
needs of a pin, and all of a ball joint), and writes host-tests/recordings/loop_<machine>.json.gz: states with closed loops,
found by Newton's method here, torques of inverse dynamics by least squares with the constraints' Jacobian, and
accelerations by `constraintDynamics`. Before anything is recorded they are held against `lcaba` and against the
equations of motion with Lagrange multipliers, solved by numpy. Coordinates are ours, not Pinocchio's (joints.py).
"""

import json
import random
import sys

import numpy as np
import pinocchio as pin
from by_hand import placement
from record import pinocchio_model, text
from recorded import RECORDINGS, write

SEED = 2024
STATES = 200
LARGEST_DIFFERENCE = 1e-10  # of accelerations, relative
CLOSED = 1e-14  # m
PROXIMAL = 1e-2  # the smaller, the fewer iterations, and the fewer digits of lcaba


class Machine:
    def __init__(self, machine):
        self.robot, self.loops = machine["robot"], machine["loops"]
        self.model, self.bodies, self.order = pinocchio_model(self.robot)
        self.data = self.model.createData()
        self.home, self.range = np.array(machine["home"]), machine["range"]
        self.actuated = [v for v, _ in machine["actuated"]]
        self.actuated_q = [q for _, q in machine["actuated"]]
        self.passive = [v for v in range(self.model.nv) if v not in self.actuated]
        self.ends = [[self.end(loop, k) for k in range(2)] for loop in self.loops]
        point = pin.ContactType.CONTACT_3D
        self.constraints = pin.StdVec_RigidConstraintModel()
        for (p, at_p), (s, at_s) in self.ends:
            self.constraints.append(pin.RigidConstraintModel(point, self.model, p, at_p, s, at_s, pin.LOCAL))

    def end(self, loop, k):
        """The joint and the place on it of an end of a loop."""
        body, here = loop["bodies"][k], pin.SE3(*placement({"placement": loop["placements"][k]}))
        joint, at = self.bodies[body] if body >= 0 else (0, pin.SE3.Identity())
        return joint, at * here

    def gap(self, q):
        """The distance of the ends, in the base's axes; its Jacobian over our velocities."""
        theirs = self.order.q(q)
        pin.computeJointJacobians(self.model, self.data, theirs)
        gaps, rows = [], []
        for ends in self.ends:
            places = [self.data.oMi[joint] * at for joint, at in ends]
            gaps.append(places[1].translation - places[0].translation)
            columns = [self.point_jacobian(joint, place) for (joint, _), place in zip(ends, places)]
            rows.append(columns[1] - columns[0])
        return np.concatenate(gaps), self.order.v_back(np.vstack(rows))

    def point_jacobian(self, joint, place):
        if joint == 0:
            return np.zeros((3, self.model.nv))
        j = pin.getJointJacobian(self.model, self.data, joint, pin.LOCAL_WORLD_ALIGNED)
        arm = place.translation - self.data.oMi[joint].translation
        return j[:3] - pin.skew(arm) @ j[3:]

    def drift(self, q, qd):
        """The relative acceleration of the ends at q̈ = 0, in the base's axes."""
        v = self.order.v(qd)
        pin.forwardKinematics(self.model, self.data, self.order.q(q), v, np.zeros_like(v))
        rows = []
        for ends in self.ends:
            accelerations = []
            for joint, at in ends:
                if joint == 0:
                    accelerations.append(np.zeros(3))
                    continue
                v, a = at.actInv(self.data.v[joint]), at.actInv(self.data.a[joint])
                point = a.linear + np.cross(v.angular, v.linear)
                accelerations.append((self.data.oMi[joint] * at).rotation @ point)
            rows.append(accelerations[1] - accelerations[0])
        return np.concatenate(rows)

    def close(self, q):
        """Newton's method in the passive coordinates."""
        for _ in range(60):
            gap, rows = self.gap(q)
            if np.max(np.abs(gap)) < CLOSED:
                return q
            step = np.zeros(self.model.nv)
            step[self.passive] = -np.linalg.lstsq(rows[:, self.passive], gap, rcond=1e-10)[0]
            step *= min(1.0, 0.3 / np.max(np.abs(step)))
            q = self.order.q_back(pin.integrate(self.model, self.order.q(q), self.order.v(step)))
        gap, _ = self.gap(q)
        if np.max(np.abs(gap)) < 10.0 * CLOSED:
            return q
        sys.exit(f"{self.robot['name']} does not close: {np.max(np.abs(gap)):.1e} m")

    def complete(self, rows, values, right):
        """All velocities or accelerations from those of the actuated coordinates."""
        x = np.zeros(self.model.nv)
        x[self.actuated] = values
        known = right - rows[:, self.actuated] @ values
        x[self.passive] = np.linalg.lstsq(rows[:, self.passive], known, rcond=1e-10)[0]
        return x

    def torque(self, rows, q, qd, qdd):
        """Inverse dynamics: motors and constraints together supply the torques of the tree."""
        v, a = self.order.v(qd), self.order.v(qdd)
        tree = self.order.v_back(pin.rnea(self.model, self.data, self.order.q(q), v, a))
        motors = np.eye(self.model.nv)[:, self.actuated]
        x, *_ = np.linalg.lstsq(np.hstack([motors, rows.T]), tree, rcond=1e-10)
        return x[: len(self.actuated)]

    def accelerations(self, q, qd, tau):
        """By constraintDynamics and lcaba."""
        torque = np.zeros(self.model.nv)
        torque[self.actuated] = tau
        given = self.order.q(q), self.order.v(qd), self.order.v(torque)
        fresh = lambda: [constraint.createData() for constraint in self.constraints]
        results = []
        for function, prepare in ((pin.constraintDynamics, pin.initConstraintDynamics), (pin.lcaba, order_joints)):
            data, constraints = self.model.createData(), pin.StdVec_RigidConstraintData()
            for constraint in fresh():
                constraints.append(constraint)
            prepare(self.model, data, self.constraints, constraints)
            settings = pin.ProximalSettings(1e-14, 1e-14, PROXIMAL, 500)
            qdd = function(self.model, data, *given, self.constraints, constraints, settings)
            results.append(self.order.v_back(qdd))
        return results

    def by_multipliers(self, rows, right, q, qd, tau):
        """M q̈ − Kᵀ λ = τ − C and K q̈ = k."""
        theirs, n = (self.order.q(q), self.order.v(qd)), self.model.nv
        mass = self.order.square(pin.crba(self.model, self.data, theirs[0]))
        rest = -self.order.v_back(pin.nonLinearEffects(self.model, self.data, *theirs))
        rest[self.actuated] += tau
        zero = np.zeros((len(rows), len(rows)))
        system = np.block([[mass, rows.T], [rows, zero]])
        return np.linalg.lstsq(system, np.concatenate([rest, right]), rcond=1e-13)[0][:n]


def order_joints(model, data, constraints, _):
    pin.computeJointMinimalOrdering(model, data, constraints)


def record(exported):
    machine = Machine(exported)
    name = machine.robot["name"]
    rng = random.Random(f"{SEED} {name}")
    draw = lambda bound: np.array([(2.0 * rng.random() - 1.0) * bound for _ in machine.actuated])
    rows, worst = {}, np.zeros(2)
    for _ in range(STATES):
        q = machine.home.copy()
        q[machine.actuated_q] += draw(machine.range)
        q = machine.close(q)
        _, jacobian = machine.gap(q)
        qd = machine.complete(jacobian, draw(2.0), np.zeros(len(jacobian)))
        right = -machine.drift(q, qd)
        qdd, other = (machine.complete(jacobian, draw(10.0), right) for _ in range(2))
        torques = [machine.torque(jacobian, q, qd, accelerations) for accelerations in (qdd, other)]
        by_contact, by_lcaba = machine.accelerations(q, qd, torques[1])
        exact = machine.by_multipliers(jacobian, right, q, qd, torques[1])
        scale = np.max(np.abs(exact))
        differences = [np.max(np.abs(x - exact)) / scale for x in (by_contact, by_lcaba)]
        worst = np.maximum(worst, differences)
        row = {"q": q, "qd": qd, "qdd": qdd, "tau": torques[0], "given_tau": torques[1], "forward": by_contact}
        for key, values in row.items():
            rows.setdefault(key, []).append([float(x) + 0.0 for x in values])
    if not np.max(worst) < LARGEST_DIFFERENCE:
        sys.exit(f"{name}: accelerations differ by {worst}")
    header = {
        "robot": name,
        "recorded_by": "host-tests/oracle/loops.py",
        "pinocchio": pin.__version__,
        "numpy": np.__version__,
        "seed": SEED,
        "machine": exported,
    }
    print(f"{name}: {STATES} states; constraintDynamics and lcaba within {worst[0]:.1e}, {worst[1]:.1e}", file=sys.stderr)
    write(RECORDINGS / f"loop_{name}.json.gz", text(header, rows))


def main():
    for machine in json.load(sys.stdin):
        record(machine)


if __name__ == "__main__":
    main()
