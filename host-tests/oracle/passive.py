#!/usr/bin/env python3
"""Records joint damping, springs, dry friction and rotor inertia of the UR5e in MuJoCo.

    cargo run -p host-reports --bin export_robots | .venv/bin/python host-tests/oracle/passive.py

Writes host-tests/recordings/passive_ur5e.json.gz: `mj_inverse` of 50 states, which is the motors' torque with its
`qfrc_passive` and its friction constraints in it. MuJoCo's dry friction is a constraint that slips at `frictionloss` and
creeps below it; every joint slips fast here. Needs requirements.txt.
"""
import json
import sys

import mujoco
import numpy as np
from recorded import RECORDINGS, write

STATES = 50
DAMPING = [12.0, 12.0, 8.0, 2.0, 2.0, 1.5]
FRICTION = [8.0, 8.0, 6.0, 1.5, 1.5, 1.2]
STIFFNESS = [60.0, 40.0, 30.0, 10.0, 8.0, 5.0]
REST = [0.3, -1.2, 1.1, -0.4, 0.2, 0.7]
ARMATURE = [0.9, 0.9, 0.9, 0.25, 0.25, 0.25]
LEAST_SLIP = 0.5


def numbers(values):
    return " ".join(repr(float(v)) for v in values)


def quaternion(rotation):
    q = np.zeros(4)
    mujoco.mju_mat2Quat(q, np.array(rotation, dtype=float))
    return q


def mjcf(robot):
    """Nested bodies of a chain, each on a hinge about its own axis."""
    text, close = "", ""
    for i, body in enumerate(robot["bodies"]):
        assert body["joint"] == "revolute" and body["parent"] == i - 1
        place = body["placement"]
        xx, xy, xz, yy, yz, zz = body["inertia_com"]
        text += f'<body pos="{numbers(place["position"])}" quat="{numbers(quaternion(place["rotation"]))}">'
        text += f'<inertial pos="{numbers(body["com"])}" mass="{body["mass"]!r}" '
        text += f'fullinertia="{numbers([xx, yy, zz, xy, xz, yz])}"/>'
        text += f'<joint type="hinge" axis="{numbers(body["axis"])}" damping="{DAMPING[i]}" '
        text += f'frictionloss="{FRICTION[i]}" stiffness="{STIFFNESS[i]}" springref="{REST[i]}" '
        text += f'armature="{ARMATURE[i]}"/>'
        close += "</body>"
    option = '<option gravity="0 0 -9.81"/><compiler angle="radian" balanceinertia="false"/>'
    return f"<mujoco>{option}<worldbody>{text}{close}</worldbody></mujoco>"


def main():
    robot = next(r for r in json.load(sys.stdin) if r["name"] == "ur5e")
    model = mujoco.MjModel.from_xml_string(mjcf(robot))
    data, rng = mujoco.MjData(model), np.random.default_rng(5)
    rows = {name: [] for name in ["q", "qd", "qdd", "tau"]}
    for _ in range(STATES):
        # Exactly representable in f32, like every recorded input.
        q = rng.uniform(-3, 3, 6).astype(np.float32).astype(float)
        slip = rng.uniform(LEAST_SLIP, 3, 6) * rng.choice([-1, 1], 6)
        qd = slip.astype(np.float32).astype(float)
        qdd = rng.uniform(-5, 5, 6).astype(np.float32).astype(float)
        data.qpos[:], data.qvel[:], data.qacc[:] = q, qd, qdd
        mujoco.mj_inverse(model, data)
        assert np.allclose(np.abs(data.qfrc_constraint), FRICTION, rtol=0, atol=0), data.qfrc_constraint
        for name, values in zip(rows, [q, qd, qdd, data.qfrc_inverse]):
            rows[name].append([float(v) for v in values])
    recording = {
        "robot": "ur5e", "mujoco": mujoco.__version__, "damping": DAMPING, "friction": FRICTION,
        "stiffness": STIFFNESS, "rest": REST, "armature": ARMATURE, **rows,
    }
    write(RECORDINGS / "passive_ur5e.json.gz", json.dumps(recording) + "\n")
    print(f"passive_ur5e: MuJoCo {mujoco.__version__}, {STATES} states", file=sys.stderr)


main()
