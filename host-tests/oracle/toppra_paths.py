#!/usr/bin/env python3
"""Records the fastest motions of the UR5e along paths by TOPP-RA (the package toppra), with Pinocchio's dynamics.

    cargo run -p host-reports --bin export_robots | .venv/bin/python host-tests/oracle/toppra_paths.py

Writes host-tests/recordings/toppra_ur5e.json.gz: of each path its way-points, its limits, the duration on a fine grid, and on a
coarse grid, which has all knots, the duration and ṡ² at all points. s is from 0 to 1. The paths are natural cubic splines, parameterised by the length of the polygon through the
way-points (scipy's, through toppra's SplineInterpolator). Rotor inertia is on Pinocchio's diagonal, Coulomb friction is
toppra's dry friction. toppra has no viscous friction. Needs requirements.txt.
"""
import json
import sys
from importlib.metadata import version

import numpy as np
import pinocchio as pin
import toppra
import toppra.algorithm
import toppra.constraint
from record import pinocchio_model
from recorded import RECORDINGS, write

PATHS = 20
FINE = 200  # segments from knot to knot
COARSE = 400  # segments of the whole path
SPACING = 0.1  # rad, between way-points
ARMATURE = [0.9, 0.9, 0.9, 0.25, 0.25, 0.25]
COULOMB = [8.0, 8.0, 6.0, 1.5, 1.5, 1.2]
TORQUE = [150.0, 150.0, 150.0, 28.0, 28.0, 28.0]
VELOCITY = 1.5
START = [0.0, -1.57, 1.57, -1.57, -1.57, 0.0]


def way_points(rng):
    """A walk through the space of joints whose direction changes smoothly."""
    q = np.array(START) + rng.uniform(-0.5, 0.5, 6)
    direction, points = rng.normal(size=6), [q]
    for _ in range(int(rng.integers(8, 24))):
        direction = direction / np.linalg.norm(direction) + rng.normal(size=6) * 0.25
        q = q + SPACING * rng.uniform(1.0, 1.1) * direction / np.linalg.norm(direction)
        points.append(q)
    return np.array(points, dtype=np.float32).astype(float)


def limits(kind):
    """Torque alone, torque with Coulomb friction, and all limits."""
    return {
        "torque": TORQUE,
        "velocity": [VELOCITY] * 6 if kind == 2 else None,
        "acceleration": [20.0] * 6 if kind == 2 else None,
        "coulomb": COULOMB if kind > 0 else [0.0] * 6,
    }


def lengths(points):
    knots = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    return knots / knots[-1]


def grid_of(knots, segments):
    """All knots, and between them the same number of segments or, in the first spans, one more."""
    spans = len(knots) - 1
    counts = [segments // spans + (k < segments % spans) for k in range(spans)]
    parts = [np.linspace(knots[k], knots[k + 1], n, endpoint=False) for k, n in enumerate(counts)]
    return np.concatenate([*parts, [1.0]])


def fastest(inverse_dynamics, points, limit, segments):
    """ṡ² on a grid, and the time."""
    knots = lengths(points)
    grid = grid_of(knots, segments)
    path = toppra.SplineInterpolator(knots, points, bc_type="natural")
    scheme = toppra.constraint.DiscretizationType.Interpolation
    torque = np.array(limit["torque"])
    constraints = [
        toppra.constraint.JointTorqueConstraint(
            inverse_dynamics, np.stack([-torque, torque], 1), limit["coulomb"], discretization_scheme=scheme
        )
    ]
    if limit["velocity"]:
        bound = np.array(limit["velocity"])
        constraints.append(toppra.constraint.JointVelocityConstraint(np.stack([-bound, bound], 1)))
        bound = np.array(limit["acceleration"])
        constraints.append(
            toppra.constraint.JointAccelerationConstraint(np.stack([-bound, bound], 1), discretization_scheme=scheme)
        )
    instance = toppra.algorithm.TOPPRA(constraints, path, gridpoints=grid, solver_wrapper="seidel")
    _, rates, _ = instance.compute_parameterization(0.0, 0.0)
    assert rates is not None and np.isfinite(rates).all()
    return rates**2, float(np.sum(2.0 * np.diff(grid) / (rates[1:] + rates[:-1])))


def main():
    robot = next(r for r in json.load(sys.stdin) if r["name"] == "ur5e")
    model, _, _ = pinocchio_model(robot)
    model.armature = np.array(ARMATURE)
    data, rng = model.createData(), np.random.default_rng(18)
    inverse_dynamics = lambda q, qd, qdd: pin.rnea(model, data, q, qd, qdd).copy()
    paths = []
    for k in range(PATHS):
        points, limit = way_points(rng), limits(k % 3)
        _, seconds = fastest(inverse_dynamics, points, limit, FINE * (len(points) - 1))
        squares, coarse = fastest(inverse_dynamics, points, limit, COARSE)
        print(f"path {k}: {len(points)} way-points, {seconds:.4f} s, coarse {coarse:.4f} s", file=sys.stderr)
        paths.append(
            {"points": points.tolist(), **limit, "seconds": seconds, "coarse": coarse, "squares": squares.tolist()}
        )
    recording = {
        "robot": "ur5e", "toppra": version("toppra"), "pinocchio": pin.__version__, "fine": FINE, "segments": COARSE,
        "armature": ARMATURE, "paths": paths,
    }
    write(RECORDINGS / "toppra_ur5e.json.gz", json.dumps(recording) + "\n")


if __name__ == "__main__":
    main()
