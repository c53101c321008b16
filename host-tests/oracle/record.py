#!/usr/bin/env python3
"""Record what Pinocchio says about our robots: the oracle of the accuracy tests.

    python3 -m venv venv && venv/bin/pip install -r host-tests/oracle/requirements.txt
    cargo run -p host-reports --bin export_robots | venv/bin/python host-tests/oracle/record.py

reads the robots' constants as the Rust code has them, builds Pinocchio's models from those numbers (not
from a URDF with rounded angles), and writes host-tests/recordings/<robot>.json.gz. With --check it writes
nothing and fails if a file would change. The same versions give the same bytes.

A state is q, q̇, q̈ and a torque. All are exactly representable in f32, so that f32 code can be asked
the same question. The torque is the one of another random acceleration (inverse dynamics, rounded to
f32), which keeps forward dynamics at accelerations of the size of q̈ in every joint.

Quaternions alone are not: the only unit quaternions on a binary grid are those of half and third turns. So
theirs are f32's, normalised in f64.

Coordinates are ours throughout, not Pinocchio's (joints.py). Before anything is recorded its model is held
against products of transforms and Jacobians in numpy (by_hand.py); quantities.py has what is recorded of the
first states only.
"""

import json
import random
import sys

import numpy as np
import pinocchio as pin
from by_hand import check, placement, symmetric
from joints import Order, joint_model
from quantities import Plant, armature, inputs, of_state, upper
from recorded import of_robots

SEED = 2024
STATES = 200  # random ones; the state of all zeros comes before them
FIRST_STATES = 20  # of which M and everything else is recorded; half as many of a large robot
LARGE = 12  # more velocity coordinates than that
REGRESSORS = 5  # states of which the largest quantities are recorded; two of a large robot
INPUTS = ("q", "qd", "qdd", "tau", "wrenches", "base_velocity", "base_acceleration", "step")
GRAVITY = [0.0, 0.0, -9.81]
RANGE = {"angle": np.pi, "length": 1.0, "qd": 3.0, "qdd": 10.0}


def moving(robot):
    return [body for body in robot["bodies"] if body["joint"] != "fixed"]


# ── Pinocchio ──────────────────────────────────────────────────────────────────────────────────────────


def pinocchio_model(robot):
    """The model; for every body its joint and its placement on it; the order of coordinates."""
    model = pin.Model()
    model.name = robot["name"]
    model.gravity = pin.Motion(np.array(GRAVITY), np.zeros(3))
    bodies = []
    for body in robot["bodies"]:
        parent, at = bodies[body["parent"]] if body["parent"] >= 0 else (0, pin.SE3.Identity())
        here = at * pin.SE3(*placement(body))
        if body["joint"] == "fixed":
            joint, on_joint = parent, here
        else:
            joint = model.addJoint(parent, joint_model(body), here, body["name"])
            on_joint = pin.SE3.Identity()
        bodies.append((joint, on_joint))
        inertia = pin.Inertia(body["mass"], np.array(body["com"]), symmetric(body["inertia_com"]))
        model.appendBodyToJoint(joint, inertia, on_joint)
    names = [body["name"] for body in moving(robot)]
    assert list(model.names)[1:] == names, "Pinocchio's order of joints is not ours"
    for joint in range(1, model.njoints):  # its CRBA takes a subtree's coordinates for contiguous
        subtree = list(model.subtrees[joint])
        assert subtree == list(range(joint, joint + len(subtree))), "bodies are not listed depth first"
    return model, bodies, Order(robot)


# ── States ─────────────────────────────────────────────────────────────────────────────────────────────


def single(x):
    """The nearest numbers that f32 represents, as f64."""
    return np.asarray(x, dtype=np.float32).astype(np.float64)


def uniform(rng, n, bound):
    return single([(2.0 * rng.random() - 1.0) * bound for _ in range(n)])


def quaternion(rng):
    while True:
        x = single([2.0 * rng.random() - 1.0 for _ in range(4)])
        if 0.1 < x @ x <= 1.0:
            return x / np.linalg.norm(x)


def position(kind, rng):
    angle = lambda: uniform(rng, 1, RANGE["angle"])
    length = lambda n: uniform(rng, n, RANGE["length"])
    draw = {
        "prismatic": lambda: length(1),
        "cylindrical": lambda: np.concatenate([angle(), length(1)]),
        "universal": lambda: np.concatenate([angle(), angle()]),
        "spherical": lambda: quaternion(rng),
        "planar": lambda: np.concatenate([angle(), length(2)]),
        "free": lambda: np.concatenate([quaternion(rng), length(3)]),
    }
    return draw.get(kind, angle)()


def configuration(robot, rng):
    return np.concatenate([position(body["joint"], rng) for body in moving(robot)])


def states(robot, order, rng):
    """q, q̇, q̈ and another q̈ for the torque; the first state is at rest at zero."""
    n = len(order.at)
    for k in range(1 + STATES):
        q, qd, qdd = order.neutral(), np.zeros(n), np.zeros(n)
        if k > 0:
            q, qd, qdd = configuration(robot, rng), uniform(rng, n, RANGE["qd"]), uniform(rng, n, RANGE["qdd"])
        yield q, qd, qdd, uniform(rng, n, RANGE["qdd"])


def record(robot):
    rng = random.Random(f"{SEED} {robot['name']}")  # its own stream: a new robot does not shift the others
    plant = Plant(robot, pinocchio_model)
    model, order = plant.model, plant.order
    configuration(robot, rng)  # what a check once drew: the stream stays
    drawn = list(states(robot, order, rng))
    rng = random.Random(f"{SEED} {robot['name']} more")
    rotors = armature(order, rng)
    plant.with_armature(rotors)
    data, rows, worst, condition = model.createData(), {}, 0.0, 0.0
    first = FIRST_STATES // 2 if model.nv > LARGE else FIRST_STATES
    for k, (q, qd, qdd, other) in enumerate(drawn):
        theirs = order.q(q), order.v(qd), order.v(qdd)
        tau = single(order.v_back(pin.rnea(model, data, *theirs[:2], order.v(other))))
        row = {
            "q": q,
            "qd": qd,
            "qdd": qdd,
            "tau": tau,
            "rnea": order.v_back(pin.rnea(model, data, *theirs)),
            "gravity": order.v_back(pin.computeGeneralizedGravity(model, data, theirs[0])),
            "bias": order.v_back(pin.nonLinearEffects(model, data, *theirs[:2])),
            "aba": order.v_back(pin.aba(model, data, *theirs[:2], order.v(tau))),
        }
        matrix = order.square(pin.crba(model, data, theirs[0]))
        if k < first:
            row["mass_matrix"] = upper(matrix)
            check(robot, model, order, plant.tip, q, qd, qdd)
            row.update(of_state(plant, q, qd, qdd, tau, drawn[k + 1][0], inputs(robot, order, rng)))
            if k >= (2 if model.nv > LARGE else REGRESSORS):
                for large in ("regressor", "rnea_by_q", "rnea_by_qd"):
                    row.pop(large)
        condition = max(condition, np.linalg.cond(matrix))
        for key, values in row.items():
            rows.setdefault(key, []).append([float(x) + 0.0 for x in values])  # + 0.0: no negative zero
        # The oracle against itself: ABA and RNEA are inverse to each other, ABA and CRBA agree.
        again = order.v_back(pin.rnea(model, data, *theirs[:2], order.v(row["aba"])))
        solved = np.linalg.solve(matrix, tau - row["bias"])
        worst = max(worst, np.max(np.abs(again - tau)), np.max(np.abs(solved - row["aba"])))
    full_scale = {
        key: max(abs(x) for values in rows[key] for x in values)
        for key in ("rnea", "gravity", "bias", "aba", "mass_matrix")
    }
    if model.nv > LARGE:
        rows = {key: values if key in INPUTS else shortened(values) for key, values in rows.items()}
    if not worst < 1e-10:
        sys.exit(f"{robot['name']}: RNEA, CRBA and ABA of Pinocchio differ by {worst:.1e}")
    header = {
        "robot": robot["name"],
        "recorded_by": "host-tests/oracle/record.py",
        "pinocchio": pin.__version__,
        "numpy": np.__version__,
        "seed": SEED,
        "free_fall": GRAVITY,
        "joints": [body["name"] for body in moving(robot)],
        "mass_matrix_layout": "upper triangle by rows, first states only",
        "full_scale": full_scale,
        "condition": float(f"{condition:.3g}"),
        "armature": list(rotors),
        "model": robot,
    }
    print(
        f"{robot['name']}: {1 + STATES} states, {model.nv} velocities, RNEA, CRBA and ABA agree within {worst:.1e}; "
        + f"condition of M {condition:.1e}; full scale "
        + ", ".join(f"{key} {value:.4g}" for key, value in full_scale.items()),
        file=sys.stderr,
    )
    return text(header, rows)


def shortened(values):
    """Rounded to decimals, by at most 1e-16 of full scale: large robots' files stay small."""
    scale = max(abs(x) for row in values for x in row)
    decimals = int(np.ceil(np.log10(0.5e16 / scale))) if scale > 0 else 0
    return [[round(x, decimals) + 0.0 for x in row] for row in values]


def text(header, rows):
    """JSON with a line for each header field and each state; numbers as the shortest that read back."""
    dump = lambda x: json.dumps(x, separators=(",", ":"), allow_nan=False)
    fields = [f"{dump(key)}:{dump(value)}" for key, value in header.items()]
    fields += [f"{dump(key)}:[\n" + ",\n".join(map(dump, values)) + "\n]" for key, values in rows.items()]
    return "{\n" + ",\n".join(fields) + "\n}\n"


if __name__ == "__main__":
    of_robots(__doc__, ".", record)
