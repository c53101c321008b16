#!/usr/bin/env python3
"""Inverse dynamics in 50 digits: the oracle of the f64 that the accuracy report holds everything against.

    venv/bin/pip install -r host-tests/oracle/requirements.txt
    venv/bin/python host-tests/oracle/precise.py

reads robots and states from host-tests/recordings/<robot>.json.gz, and writes host-tests/recordings/precise.json.gz: the
torques of some of those states, rounded from 50 digits to f64. With --check it writes nothing and fails if the file
would change.

The equations are Newton's and Euler's of every body, in base coordinates about the base's origin: neither our
recursion nor Pinocchio's. Motion of a body by products of rotations, as a sum over the joints below it; torque of a
joint as its axis times the moments of all forces on the bodies above.
"""

import json
import sys

from mpmath import cos, matrix, mp, mpf, sin
from recorded import RECORDINGS, load, of_one

mp.dps = 50
ROBOTS = ("ur5e", "panda", "a1")
STATES = range(0, 100, 10)
GRAVITY = (0, 0, mpf("-9.81"))


def vector(numbers):
    return matrix([mpf(x) for x in numbers])


def cross(a, b):
    return matrix([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def square(numbers):
    return matrix([[mpf(x) for x in numbers[3 * i : 3 * i + 3]] for i in range(3)])


def symmetric(six):
    xx, xy, xz, yy, yz, zz = (mpf(x) for x in six)
    return matrix([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def about(axis, angle):
    """Rodrigues' rotation."""
    x, y, z = axis / mp.norm(axis)
    k = matrix([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return mp.eye(3) + sin(angle) * k + (1 - cos(angle)) * (k * k)


def torques(robot, q, qd, qdd):
    """τ of the joints that move, N·m."""
    poses, joints, motions, wrenches, moving = [], [], [], [], 0
    for body in robot["bodies"]:
        base = (mp.eye(3), matrix(3, 1))
        attitude, origin = poses[body["parent"]] if body["parent"] >= 0 else base
        at_rest = (matrix(3, 1),) * 4  # ω, α, v and a of the parent's origin
        w, dw, v, a = motions[body["parent"]] if body["parent"] >= 0 else at_rest
        here = origin + attitude * vector(body["placement"]["position"])
        arm = here - origin
        v, a = v + cross(w, arm), a + cross(dw, arm) + cross(w, cross(w, arm))
        attitude = attitude * square(body["placement"]["rotation"])
        if body["joint"] == "fixed":
            joints.append(None)
        else:
            axis = vector(body["axis"])
            axis = axis / mp.norm(axis)
            attitude = attitude * about(axis, mpf(q[moving]))
            axis = attitude * axis
            dw = dw + axis * mpf(qdd[moving]) + cross(w, axis) * mpf(qd[moving])
            w = w + axis * mpf(qd[moving])
            joints.append((axis, here))
            moving += 1
        poses.append((attitude, here))
        motions.append((w, dw, v, a))
        com = attitude * vector(body["com"])
        inertia = attitude * symmetric(body["inertia_com"]) * attitude.T
        accel = a + cross(dw, com) + cross(w, cross(w, com))
        force = mpf(body["mass"]) * (accel - vector(GRAVITY))
        moment = inertia * dw + cross(w, inertia * w)
        wrenches.append((here + com, force, moment))
    answer = []
    for i, joint in enumerate(joints):
        if joint is None:
            continue
        axis, here = joint
        total = matrix(3, 1)
        for j, (place, force, moment) in enumerate(wrenches):
            if carries(robot, i, j):
                total += moment + cross(place - here, force)
        answer.append((axis.T * total)[0])
    return answer


def carries(robot, i, j):
    while j > i:
        j = robot["bodies"][j]["parent"]
    return i == j


def text():
    lines = []
    for name in ROBOTS:
        recording = load(name)
        assert all(body["joint"] in ("revolute", "continuous", "fixed") for body in recording["model"]["bodies"])
        rows, worst = [], mpf(0)
        for k in STATES:
            tau = torques(recording["model"], *(recording[key][k] for key in ("q", "qd", "qdd")))
            worst = max(worst, max(abs(x - mpf(y)) for x, y in zip(tau, recording["rnea"][k])))
            rows.append([float(x) + 0.0 for x in tau])
        relative = worst / mpf(recording["full_scale"]["rnea"])
        print(f"{name}: Pinocchio is off by {float(worst):.1e} N·m, {float(relative):.1e} of full scale", file=sys.stderr)
        lines.append(f'"{name}":[\n' + ",\n".join(json.dumps(row, separators=(",", ":")) for row in rows) + "\n]")
    head = f'"recorded_by":"host-tests/oracle/precise.py",\n"states":{json.dumps(list(STATES), separators=(",", ":"))},\n'
    return "{\n" + head + ",\n".join(lines) + "\n}\n"


if __name__ == "__main__":
    of_one(__doc__, RECORDINGS / "precise.json.gz", text)
