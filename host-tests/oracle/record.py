#!/usr/bin/env python3
"""Record what Pinocchio says about our robots: the oracle of the accuracy tests.

    python3 -m venv venv && venv/bin/pip install -r host-tests/oracle/requirements.txt
    cargo run -p host-tests --bin export_robots | venv/bin/python host-tests/oracle/record.py

reads the robots' constants as the Rust code has them, builds Pinocchio's models from those numbers (not
from a URDF with rounded angles), and writes host-tests/recordings/<robot>.json. With --check it writes
nothing and fails if a file would change. The same versions give the same bytes.

A state is q, q̇, q̈ and a torque. All are exactly representable in f32, so that f32 code can be asked
the same question. The torque is the one of another random acceleration (inverse dynamics, rounded to
f32), which keeps forward dynamics at accelerations of the size of q̈ in every joint.

Before anything is recorded, Pinocchio's model is compared with products of transforms and Jacobians
written out below in numpy: total mass, centre of mass and pose of the last body, at q = 0 and at a random
q, mass matrix and gravity torque. An error in building the model shows there.
"""

import argparse
import json
import pathlib
import random
import sys

import numpy as np
import pinocchio as pin

SEED = 2024
STATES = 200  # random ones; the state of all zeros comes before them
MASS_MATRICES = 20  # for the first so many states
GRAVITY = [0.0, 0.0, -9.81]
RANGE = {"q": {"revolute": np.pi, "prismatic": 1.0}, "qd": 3.0, "qdd": 10.0}
RECORDINGS = pathlib.Path(__file__).resolve().parent.parent / "recordings"


def symmetric(six):
    xx, xy, xz, yy, yz, zz = six
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def placement(body):
    p = body["placement"]
    return np.array(p["rotation"]).reshape(3, 3), np.array(p["position"])


def moving(robot):
    return [body for body in robot["bodies"] if body["joint"] != "fixed"]


# ── Pinocchio ──────────────────────────────────────────────────────────────────────────────────────────


def joint_model(kind, axis):
    for letter, unit in zip("XYZ", np.eye(3)):
        if np.array_equal(axis, unit):
            return getattr(pin, {"revolute": "JointModelR", "prismatic": "JointModelP"}[kind] + letter)()
    general = {"revolute": pin.JointModelRevoluteUnaligned, "prismatic": pin.JointModelPrismaticUnaligned}
    return general[kind](np.array(axis) / np.linalg.norm(axis))


def pinocchio_model(robot):
    """The model, and for every body its joint and its placement on it."""
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
            joint = model.addJoint(parent, joint_model(body["joint"], body["axis"]), here, body["name"])
            on_joint = pin.SE3.Identity()
        bodies.append((joint, on_joint))
        inertia = pin.Inertia(body["mass"], np.array(body["com"]), symmetric(body["inertia_com"]))
        model.appendBodyToJoint(joint, inertia, on_joint)
    names = [body["name"] for body in moving(robot)]
    assert list(model.names)[1:] == names, "Pinocchio's order of joints is not ours"
    for joint in range(1, model.njoints):  # its CRBA takes a subtree's coordinates for contiguous
        subtree = list(model.subtrees[joint])
        assert subtree == list(range(joint, joint + len(subtree))), "bodies are not listed depth first"
    return model, bodies


# ── The same by hand ───────────────────────────────────────────────────────────────────────────────────


def joint_transform(body, q):
    if body["joint"] == "fixed":
        return np.eye(3), np.zeros(3)
    u = np.array(body["axis"]) / np.linalg.norm(body["axis"])
    if body["joint"] == "prismatic":
        return np.eye(3), u * q
    ux = np.cross(u, np.eye(3)).T  # [u]×
    return np.eye(3) + np.sin(q) * ux + (1 - np.cos(q)) * ux @ ux, np.zeros(3)


def by_hand(robot, q):
    """Poses of the bodies in the base frame; mass and centre of mass of what moves; M(q); g(q).

    M = Σ m Jvᵀ Jv + Jωᵀ I Jω and g = −Σ m Jvᵀ g₀, with the Jacobians of the centres of mass.
    """
    order = [i for i, body in enumerate(robot["bodies"]) if body["joint"] != "fixed"]
    poses, lines, moves = [], [], []  # lines: the coordinates that move body i, from base to tip
    n = len(order)
    mass, moment, matrix, gravity = 0.0, np.zeros(3), np.zeros((n, n)), np.zeros(n)
    for i, body in enumerate(robot["bodies"]):
        parent = body["parent"]
        r, p = poses[parent] if parent >= 0 else (np.eye(3), np.zeros(3))
        for r1, p1 in (placement(body), joint_transform(body, q[order.index(i)] if i in order else 0.0)):
            r, p = r @ r1, p + r @ p1
        poses.append((r, p))
        lines.append((lines[parent] if parent >= 0 else []) + ([i] if i in order else []))
        if not lines[i]:
            continue  # welded to the base
        com = p + r @ np.array(body["com"])
        jv, jw = np.zeros((3, n)), np.zeros((3, n))
        for k in lines[i]:
            rk, pk = poses[k]
            u = rk @ (np.array(robot["bodies"][k]["axis"]) / np.linalg.norm(robot["bodies"][k]["axis"]))
            if robot["bodies"][k]["joint"] == "revolute":
                jv[:, order.index(k)], jw[:, order.index(k)] = np.cross(u, com - pk), u
            else:
                jv[:, order.index(k)] = u
        mass, moment = mass + body["mass"], moment + body["mass"] * com
        inertia = r @ symmetric(body["inertia_com"]) @ r.T
        matrix += body["mass"] * jv.T @ jv + jw.T @ inertia @ jw
        gravity -= body["mass"] * jv.T @ np.array(GRAVITY)
    return poses, mass, moment / mass, matrix, gravity


def cross_check(robot, model, bodies, rng):
    data = model.createData()
    for q in (np.zeros(model.nq), configuration(robot, rng)):
        poses, mass, com, matrix, gravity = by_hand(robot, q)
        found = pin.centerOfMass(model, data, q).copy()
        close(robot, "total mass", data.mass[0], mass)
        close(robot, "centre of mass", found, com)
        joint, on_joint = bodies[-1]
        tip = data.oMi[joint] * on_joint
        close(robot, "attitude of the last body", tip.rotation, poses[-1][0])
        close(robot, "position of the last body", tip.translation, poses[-1][1])
        close(robot, "mass matrix", mass_matrix(model, data, q), matrix)
        close(robot, "gravity", pin.computeGeneralizedGravity(model, data, q), gravity)


def close(robot, what, found, expected, tolerance=1e-13):
    scale = max(1.0, np.max(np.abs(expected)))
    error = np.max(np.abs(np.asarray(found) - expected)) / scale
    if not error <= tolerance:
        sys.exit(f"{robot['name']}: {what} is off by {error:.1e} of {scale:.3g}:\n{found}\nnot\n{expected}")


# ── States ─────────────────────────────────────────────────────────────────────────────────────────────


def single(x):
    """The nearest numbers that f32 represents, as f64."""
    return np.asarray(x, dtype=np.float32).astype(np.float64)


def uniform(rng, n, bound):
    return single([(2.0 * rng.random() - 1.0) * bound for _ in range(n)])


def configuration(robot, rng):
    return np.array([uniform(rng, 1, RANGE["q"][body["joint"]])[0] for body in moving(robot)])


def mass_matrix(model, data, q):
    upper = np.triu(pin.crba(model, data, q))
    return upper + np.triu(upper, 1).T


def record(robot):
    rng = random.Random(f"{SEED} {robot['name']}")  # its own stream: a new robot does not shift the others
    model, bodies = pinocchio_model(robot)
    cross_check(robot, model, bodies, rng)
    data, n = model.createData(), model.nv
    rows = {key: [] for key in ("q", "qd", "qdd", "tau", "rnea", "gravity", "bias", "aba", "mass_matrix")}
    worst = 0.0
    for k in range(1 + STATES):
        q, qd, qdd = np.zeros((3, n))
        if k > 0:
            q, qd, qdd = configuration(robot, rng), uniform(rng, n, RANGE["qd"]), uniform(rng, n, RANGE["qdd"])
        tau = single(pin.rnea(model, data, q, qd, uniform(rng, n, RANGE["qdd"])))
        row = {
            "q": q,
            "qd": qd,
            "qdd": qdd,
            "tau": tau,
            "rnea": pin.rnea(model, data, q, qd, qdd).copy(),
            "gravity": pin.computeGeneralizedGravity(model, data, q).copy(),
            "bias": pin.nonLinearEffects(model, data, q, qd).copy(),
            "aba": pin.aba(model, data, q, qd, tau).copy(),
        }
        matrix = mass_matrix(model, data, q)
        if k < MASS_MATRICES:
            row["mass_matrix"] = matrix[np.triu_indices(n)]
        for key, values in row.items():
            rows[key].append([float(x) + 0.0 for x in values])  # + 0.0: no negative zero
        # The oracle against itself: ABA and RNEA are inverse to each other, ABA and CRBA agree.
        again = pin.rnea(model, data, q, qd, row["aba"])
        solved = np.linalg.solve(matrix, tau - row["bias"])
        worst = max(worst, np.max(np.abs(again - tau)), np.max(np.abs(solved - row["aba"])))
    full_scale = {
        key: max(abs(x) for values in rows[key] for x in values)
        for key in ("rnea", "gravity", "bias", "aba", "mass_matrix")
    }
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
        "model": robot,
    }
    print(
        f"{robot['name']}: {1 + STATES} states, {n} joints, RNEA, CRBA and ABA agree within {worst:.1e}; full scale "
        + ", ".join(f"{key} {value:.4g}" for key, value in full_scale.items()),
        file=sys.stderr,
    )
    return text(header, rows)


def text(header, rows):
    """JSON with a line for each header field and each state; numbers as the shortest that read back."""
    dump = lambda x: json.dumps(x, separators=(",", ":"), allow_nan=False)
    fields = [f"{dump(key)}:{dump(value)}" for key, value in header.items()]
    fields += [f"{dump(key)}:[\n" + ",\n".join(map(dump, values)) + "\n]" for key, values in rows.items()]
    return "{\n" + ",\n".join(fields) + "\n}\n"


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    arguments.add_argument("robots", nargs="?", default="-", help="JSON of export_robots; - or nothing: stdin")
    arguments.add_argument("--out", type=pathlib.Path, default=RECORDINGS, help="folder of the recordings")
    arguments.add_argument("--check", action="store_true", help="write nothing, fail if a file would change")
    options = arguments.parse_args()
    source = sys.stdin if options.robots == "-" else open(options.robots, encoding="utf-8")
    stale = []
    for robot in json.load(source):
        path, new = options.out / f"{robot['name']}.json", record(robot)
        if not options.check:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(new, encoding="utf-8")
        elif not path.exists() or path.read_text(encoding="utf-8") != new:
            stale.append(str(path))
    if stale:
        sys.exit("would change: " + ", ".join(stale))


if __name__ == "__main__":
    main()
