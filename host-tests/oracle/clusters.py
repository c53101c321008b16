#!/usr/bin/env python3
"""Record what Pinocchio says about robots with kinematic loops: the oracle of the tests of clusters.

    cargo run -p loop-tests --bin export_clusters | venv/bin/python host-tests/oracle/clusters.py

reads the spanning trees as the Rust code has them and writes host-tests/recordings/clusters/<robot>.json.gz. With --check it
writes nothing and fails if a file would change.

The loops are stated here once more, as pairs of points that coincide, and none of the library's closed forms is used:

- q by Newton's iteration on the distances of these points, from y and a guess;
- G and the rest of q̈ from Pinocchio's Jacobians and classical accelerations of the points, by least squares: loops of
  planar linkages in space have redundant rows;
- inverse dynamics is G^T rnea(q, G ẏ, G ÿ + Ġ ẏ);
- forward dynamics is Pinocchio's constraintDynamics, of which the accelerations of the independent coordinates are recorded.

What is recorded is held against lcaba, against G^T M G ÿ = τ - bias, and against inverse dynamics of the result.

Gears, belts and differentials are no pairs of points: of these robots q as a function of y is stated, in terms of what the
machine is, and G and Ġ ẏ are its derivatives by differences in 50 digits. Forward dynamics is G^T M G ÿ = τ - bias by numpy, held
against the equations of the tree with Lagrange multipliers.
"""

import math
import random
import sys

import mpmath
import numpy as np
import pinocchio as pin
from record import pinocchio_model, single, text, uniform
from recorded import of_robots

SEED = 2026
STATES = 200


def turned(radius, degrees):
    """A point of the plane z = 0 at this radius and angle."""
    angle = math.radians(degrees)
    return [radius * math.cos(angle), radius * math.sin(angle), 0.0]


# Loops: a point of one body and a point of another, each in its body's own frame. Independent
# coordinates with the middle and the reach of their range, and the dependent coordinates' guess.
ROBOTS = {
    "four_bar_leg": {
        "loops": [("rod", [0.0, 0.0, -0.3], "shank", [0.05, 0.0, 0.0])],
        "y": [("thigh", 0.0, 2.0), ("crank", 0.0, 0.6), ("foot", 0.0, 2.0)],
        "guess": {},
    },
    "five_bar_leg": {
        "loops": [("rod", [0.22, 0.0, 0.0], "other_rod", [0.2, 0.0, 0.0])],
        "y": [("carriage", 0.0, 1.0), ("crank", 2.2, 0.5), ("other_crank", 0.9, 0.5)],
        "guess": {"rod": -1.5, "other_rod": 1.0},
    },
    "ankle_leg": {
        "loops": [
            ("foot", [-0.045, 0.9 * 0.035, -0.01], "left_rod", [0.0, 0.0, -0.16]),
            ("foot", [-0.045, -0.9 * 0.035, -0.01], "right_rod", [0.0, 0.0, -0.26]),
        ],
        "y": [("shank", 0.0, 2.0), ("cross", 0.0, 0.45), ("foot", 0.0, 0.3)],
        "guess": {},
    },
    "delta_robot": {
        "loops": [
            ("platform", [0.05, 0.0, 0.0], "rods_a", [0.0, 0.0, -0.45]),
            ("platform", [-0.025, 0.025 * math.sqrt(3.0), 0.0], "rods_b", [0.0, 0.0, -0.45]),
            ("platform", [-0.025, -0.025 * math.sqrt(3.0), 0.0], "rods_c", [0.0, 0.0, -0.45]),
        ],
        "y": [("crank_a", 0.3, 0.6), ("crank_b", 0.3, 0.6), ("crank_c", 0.3, 0.6)],
        "guess": {"cross_a": 0.4, "cross_b": 0.4, "cross_c": 0.4, "platform": -0.4},
    },
    "stewart_platform": {
        "loops": [
            ("platform", turned(0.3, angle), f"upper_{leg}", [0.0, 0.0, 0.4])
            for leg, angle in zip("abcdef", (-50.0, 50.0, 70.0, 170.0, 190.0, 290.0))
        ],
        "y": [
            ("along", 0.0, 0.15),
            ("across", 0.0, 0.15),
            ("up", 0.8, 0.1),
            ("yaw", 0.0, 0.4),
            ("pitch", 0.0, 0.3),
            ("platform", 0.0, 0.3),
        ],
        "guess": {},
    },
}

# Coordinates of the tree as functions of the independent ones, and how far the latter go from zero.
EXPLICIT = {
    # Two motors turn the side gears of a bevel differential, of ratios 1 and 2.5: the carrier takes
    # their mean, its gear half of their difference.
    "wrist": {
        "reach": [2.0] * 6,
        "map": lambda y: y[:4] + [(y[4] + y[5]) / 2, (y[4] - y[5]) / 2 / mpmath.mpf("2.5")],
    },
    # The forearm hangs on a spiral pulley: its angle is a cubic polynomial of the pulley's. Both
    # motors together pitch the hand and against each other roll it, by half of their angles from
    # offsets; rotors turn nine times as fast.
    "geared": {
        "reach": [2.0] * 4,
        "map": lambda y: [
            y[0],
            y[1],
            mpmath.mpf("0.1") + mpmath.mpf("0.6") * y[1] + mpmath.mpf("0.05") * y[1] ** 2 - mpmath.mpf("0.01") * y[1] ** 3,
            (y[2] + y[3]) / 2 + mpmath.mpf("0.1"),
            (y[2] - y[3]) / 2,
            9 * y[2],
            mpmath.mpf("0.2") - 9 * y[3],
        ],
    },
}


class Geared:
    """A robot whose q is a function of y."""

    def __init__(self, robot):
        spec = EXPLICIT[robot["name"]]
        self.map, self.range = spec["map"], [(0.0, reach) for reach in spec["reach"]]
        self.model, _, order = pinocchio_model(robot)
        assert list(order.at) == list(range(self.model.nv)), "one degree of freedom each, in order"
        self.free = len(self.range)

    def along(self, y, direction, order):
        """A derivative of q at y along a direction."""
        with mpmath.workdps(50):
            at = lambda k: lambda s: self.map([mpmath.mpf(float(a)) + s * float(d) for a, d in zip(y, direction)])[k]
            return np.array([float(mpmath.diff(at(k), 0, order)) for k in range(self.model.nv)])

    def maps(self, data, y, yd):
        """q, G and Ġ ẏ."""
        g = np.array([self.along(y, unit, 1) for unit in np.eye(self.free)]).T
        return self.along(y, yd, 0), g, self.along(y, yd, 2)

    def forward(self, q, g, yd, bias, tau, solved):
        """As was solved; by M q̈ - Kᵀ λ = τ - C and K q̈ = K Ġ ẏ, where the rows of K span what G leaves out."""
        data, n = self.model.createData(), self.model.nv
        k = np.linalg.svd(g)[0][:, self.free :].T
        m = np.triu(pin.crba(self.model, data, q))
        m = m + np.triu(m, 1).T
        rest = np.linalg.pinv(g.T) @ tau - pin.nonLinearEffects(self.model, data, q, g @ yd)
        system = np.block([[m, k.T], [k, np.zeros((len(k), len(k)))]])
        qdd = np.linalg.solve(system, np.concatenate([rest, k @ bias]))[:n]
        return solved, {"multipliers": np.linalg.lstsq(g, qdd - bias)[0]}


class Machine:
    """A robot whose loops are pairs of points."""

    def __init__(self, robot):
        self.robot, self.spec = robot, ROBOTS[robot["name"]]
        self.model, bodies, order = pinocchio_model(robot)
        assert list(order.at) == list(range(self.model.nv)), "one degree of freedom each, in order"
        names = [body["name"] for body in robot["bodies"]]
        self.independent = [names.index(name) for name, _, _ in self.spec["y"]]
        self.range, self.free = [entry[1:] for entry in self.spec["y"]], len(self.independent)
        self.dependent = [v for v in range(self.model.nv) if v not in self.independent]
        self.ends = []
        for i, (a, at_a, b, at_b) in enumerate(self.spec["loops"]):
            pair = []
            for which, (name, at) in enumerate([(a, at_a), (b, at_b)]):
                joint, on_joint = bodies[names.index(name)]
                place = on_joint * pin.SE3(np.eye(3), np.array(at))
                frame = pin.Frame(f"loop {i} {which}", joint, 0, place, pin.FrameType.OP_FRAME)
                pair.append((self.model.addFrame(frame, False), joint, place))
            self.ends.append(pair)
        self.guess = np.zeros(self.model.nv)
        for name, angle in self.spec["guess"].items():
            self.guess[names.index(name)] = angle
        self.constraints = pin.StdVec_RigidConstraintModel()
        for (_, joint_a, place_a), (_, joint_b, place_b) in self.ends:
            constraint = pin.RigidConstraintModel(
                pin.ContactType.CONTACT_3D, self.model, joint_a, place_a, joint_b, place_b, pin.LOCAL
            )
            constraint.setBaumgarteCorrectorParameters(pin.BaumgarteCorrectorParameters(0.0, 0.0))
            self.constraints.append(constraint)

    def gap(self, data, q):
        """The points' differences and their Jacobian."""
        pin.computeJointJacobians(self.model, data, q)
        pin.updateFramePlacements(self.model, data)
        gaps, rows = [], []
        for (a, _, _), (b, _, _) in self.ends:
            gaps.append(data.oMf[a].translation - data.oMf[b].translation)
            of = lambda f: pin.getFrameJacobian(self.model, data, f, pin.LOCAL_WORLD_ALIGNED)[:3]
            rows.append(of(a) - of(b))
        return np.concatenate(gaps), np.vstack(rows)

    def least(self, matrix, right):
        return np.linalg.lstsq(matrix, right, rcond=1e-9)[0]

    def close(self, data, y):
        q = self.guess.copy()
        q[self.independent] = y
        # By steps from the middle of the range, so that the branch is the guess's.
        middle = np.array([centre for _, centre, _ in self.spec["y"]])
        for part in np.linspace(0.0, 1.0, 21):
            q[self.independent] = middle + part * (y - middle)
            for _ in range(50):
                gap, k = self.gap(data, q)
                step = self.least(k[:, self.dependent], gap)
                q[self.dependent] -= step
                if np.max(np.abs(step)) < 1e-15:
                    break
        q[self.independent] = y
        gap, k = self.gap(data, q)
        assert np.max(np.abs(gap)) < 1e-14, "it does not close"
        return q, k

    def maps(self, data, y, yd):
        """q, G and Ġ ẏ."""
        q, k = self.close(data, y)
        n, free = self.model.nv, self.free
        g = np.zeros((n, free))
        g[self.independent] = np.eye(free)
        g[self.dependent] = -self.least(k[:, self.dependent], k[:, self.independent])
        qd = g @ yd
        pin.forwardKinematics(self.model, data, q, qd, np.zeros(n))
        pin.updateFramePlacements(self.model, data)
        at = lambda f: pin.getFrameClassicalAcceleration(self.model, data, f, pin.LOCAL_WORLD_ALIGNED).linear
        drift = np.concatenate([at(a) - at(b) for (a, _, _), (b, _, _) in self.ends])
        bias = np.zeros(n)
        bias[self.dependent] = -self.least(k[:, self.dependent], drift)
        return q, g, bias

    def forward(self, q, g, yd, bias, tau, solved):
        """By constraintDynamics; by lcaba, and as was solved."""
        on_tree = np.zeros(self.model.nv)
        on_tree[self.independent] = tau
        results = []
        for solver in (pin.constraintDynamics, pin.lcaba):
            fresh = self.model.createData()
            cdata = pin.StdVec_RigidConstraintData()
            for constraint in self.constraints:
                cdata.append(constraint.createData())
            if solver is pin.constraintDynamics:
                pin.initConstraintDynamics(self.model, fresh, self.constraints, cdata)
            else:
                pin.computeJointMinimalOrdering(self.model, fresh, self.constraints)
            # The rounding errors of lcaba grow with 1/mu: the least of its errors, 1e-11, are at
            # 1e-2.
            mu = 1e-10 if solver is pin.constraintDynamics else 1e-2
            settings = pin.ProximalSettings(1e-14, 1e-14, mu, 2000)
            qdd = solver(self.model, fresh, q, g @ yd, on_tree, self.constraints, cdata, settings)
            results.append(np.array(qdd)[self.independent])
        return results[0], {"lcaba": results[1], "matrix": solved}

    def header(self):
        """The loops, as the measurements of speed read them."""
        loops = []
        for a, at_a, b, at_b in self.spec["loops"]:
            names = [body["name"] for body in self.robot["bodies"]]
            loops.append({"bodies": [names.index(a), names.index(b)], "points": [at_a, at_b]})
        return {"loops": loops, "independent": self.independent}


def record(robot):
    rng = random.Random(f"{SEED} {robot['name']}")
    machine = (Geared if robot["name"] in EXPLICIT else Machine)(robot)
    model, free = machine.model, machine.free
    data = model.createData()
    rows, worst = {}, {}
    note = lambda way, error: worst.update({way: max(worst.get(way, 0.0), float(error))})
    for _ in range(STATES):
        y = single([centre + uniform(rng, 1, reach)[0] for centre, reach in machine.range])
        yd, ydd, other = (uniform(rng, free, bound) for bound in (3.0, 10.0, 10.0))
        q, g, bias = machine.maps(data, y, yd)
        inverse = lambda ydd: g.T @ pin.rnea(model, data, q, g @ yd, g @ ydd + bias)
        tau = single(inverse(other))
        m = pin.crba(model, data, q)
        m = np.triu(m) + np.triu(m, 1).T
        solved = np.linalg.solve(g.T @ m @ g, tau - inverse(np.zeros(free)))
        forward, ways = machine.forward(q, g, yd, bias, tau, solved)
        size = max(np.max(np.abs(solved)), 10.0)
        for way, ydd_by_it in ways.items():
            note(way, np.max(np.abs(ydd_by_it - forward)) / size)
        note("inverse", np.max(np.abs(inverse(forward) - tau)) / np.max(np.abs(tau)))
        row = {
            "q": y,
            "qd": yd,
            "qdd": ydd,
            "tau": tau,
            "tree_q": q,
            "tree_qd": g @ yd,
            "tree_qdd": g @ ydd + bias,
            "rnea": inverse(ydd),
            "gravity": g.T @ pin.computeGeneralizedGravity(model, data, q),
            "forward": forward,
            "mass_matrix": (g.T @ m @ g)[np.triu_indices(free)],
        }
        for key, values in row.items():
            rows.setdefault(key, []).append([float(x) + 0.0 for x in values])
    print(f"{robot['name']}: {STATES} states; {worst}", file=sys.stderr)
    if not max(worst.values()) < 1e-9:
        sys.exit(f"{robot['name']}: the ways to forward dynamics differ")
    header = {
        "robot": robot["name"],
        "recorded_by": "host-tests/oracle/clusters.py",
        "pinocchio": pin.__version__,
        "numpy": np.__version__,
        "seed": SEED,
        "agreement": {key: float(f"{value:.1e}") for key, value in worst.items()},
        "model": robot,
        **(machine.header() if isinstance(machine, Machine) else {}),
    }
    return text(header, rows)


if __name__ == "__main__":
    of_robots(__doc__, "clusters", record)
