"""MuJoCo's reading of the fixtures: the recording that the test of the reader of MJCF compares with.

    python tools/robot-import/tests/mjcf_oracle.py                      writes tools/robot-import/tests/mjcf/recorded.json
    python tools/robot-import/tests/mjcf_oracle.py OUT.json FILE...     other models

At q = 0 and at a second configuration: mass, centre of mass and inertia of each body, anchor and
axis of each joint, the residual of each constraint, all in the world's frame. Damping, armature and
effort are measured, not read from the model: as a force at unit speed, as the difference of the
mass matrix, and as the force under a very large control.
"""

import json
import math
import pathlib
import platform
import random
import sys

import mujoco
import numpy as np

HUGE = 1e9


def name(model, kind, index, word):
    return mujoco.mj_id2name(model, kind, index) or f"{word}_{index}"


def configuration(model, rng):
    """Coordinates of each joint, as MuJoCo has them; all neutral without a generator."""
    all_of = []
    for joint in range(model.njnt):
        kind = model.jnt_type[joint]
        quaternion = [1.0, 0.0, 0.0, 0.0]
        if rng and kind in (mujoco.mjtJoint.mjJNT_FREE, mujoco.mjtJoint.mjJNT_BALL):
            quaternion = [rng.gauss(0, 1) for _ in range(4)]
            length = math.sqrt(sum(x * x for x in quaternion))
            quaternion = [x / length for x in quaternion]
        draw = lambda: rng.uniform(-1, 1) if rng else 0.0
        if kind == mujoco.mjtJoint.mjJNT_FREE:
            all_of.append([draw() for _ in range(3)] + quaternion)
        elif kind == mujoco.mjtJoint.mjJNT_BALL:
            all_of.append(quaternion)
        else:
            all_of.append([draw()])
    return all_of


def state(model, data, q):
    data.qpos[:] = [x for joint in q for x in joint]
    data.qvel[:] = 0
    mujoco.mj_forward(model, data)
    bodies = {}
    for i in range(1, model.nbody):
        axes = data.ximat[i].reshape(3, 3)
        tensor = axes @ np.diag(model.body_inertia[i]) @ axes.T
        bodies[name(model, mujoco.mjtObj.mjOBJ_BODY, i, "body")] = {
            "mass": model.body_mass[i],
            "com": list(data.xipos[i]),
            "inertia": [tensor[a][b] for a, b in ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))],
        }
    joints = {}
    for i in range(model.njnt):
        joints[name(model, mujoco.mjtObj.mjOBJ_JOINT, i, "joint")] = {
            "q": q[i],
            "anchor": list(data.xanchor[i]),
            "axis": list(data.xaxis[i]),
        }
    residuals = {}
    for row in range(data.nefc):
        if data.efc_type[row] == mujoco.mjtConstraint.mjCNSTR_EQUALITY:
            which = name(model, mujoco.mjtObj.mjOBJ_EQUALITY, int(data.efc_id[row]), "equality")
            residuals.setdefault(which, []).append(data.efc_pos[row])
    return {"bodies": bodies, "joints": joints, "residuals": residuals}


def mass_matrix(model, data):
    out = np.zeros((model.nv, model.nv))
    try:
        mujoco.mj_fullM(model, data, out)
    except TypeError:
        mujoco.mj_fullM(model, out, data.qM)
    return out


def efforts(model, data):
    """The greatest generalised force under very large controls of either sign."""
    most = np.zeros(model.nv)
    for sign in (-1, 1):
        data.ctrl[:] = sign * HUGE * np.where(model.actuator_gear[:, 0] < 0, -1, 1)
        mujoco.mj_forward(model, data)
        most = np.maximum(most, np.abs(data.qfrc_actuator))
    data.ctrl[:] = 0
    return most


def joints(path):
    """Limits, damping, friction, armature and effort of each joint."""
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    mujoco.mj_forward(model, data)
    at_rest = data.qfrc_passive.copy()
    mass = mass_matrix(model, data)
    damping = np.zeros(model.nv)
    for dof in range(model.nv):
        data.qvel[:] = 0
        data.qvel[dof] = 1
        mujoco.mj_forward(model, data)
        damping[dof] = at_rest[dof] - data.qfrc_passive[dof]
    data.qvel[:] = 0
    most = efforts(model, data)
    model.dof_armature[:] = 0
    model.actuator_armature[:] = 0
    mujoco.mj_forward(model, data)
    armature = np.diag(mass - mass_matrix(model, data))
    out = {}
    for i in range(model.njnt):
        dof = model.jnt_dofadr[i]
        kind = mujoco.mjtJoint(model.jnt_type[i]).name.removeprefix("mjJNT_").lower()
        effort = most[dof]
        driven = any(model.actuator_trnid[k][0] == i for k in range(model.nu))
        if not driven:
            effort = max(abs(model.jnt_actfrcrange[i])) if model.jnt_actfrclimited[i] else HUGE
        out[name(model, mujoco.mjtObj.mjOBJ_JOINT, i, "joint")] = {
            "kind": kind,
            "range": list(model.jnt_range[i]) if model.jnt_limited[i] else None,
            "damping": damping[dof],
            "friction": model.dof_frictionloss[dof],
            "armature": armature[dof],
            "effort": effort if effort < 1e-3 * HUGE and kind in ("hinge", "slide") else None,
        }
    return out


def record(path):
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    rng = random.Random(1)
    states = [state(model, data, configuration(model, which)) for which in (None, rng)]
    return {"joints": joints(path), "states": states}


def plain(value):
    if isinstance(value, dict):
        return {key: plain(inner) for key, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(inner) for inner in value]
    return value if value is None or isinstance(value, str) else float(value)


def main():
    folder = pathlib.Path(__file__).parent / "mjcf"
    if len(sys.argv) > 1:
        out, files = pathlib.Path(sys.argv[1]), {str(pathlib.Path(f).resolve()): f for f in sys.argv[2:]}
    else:
        out = folder / "recorded.json"
        files = {path.name: path for path in sorted(folder.glob("*.xml"))}
    recorded = {
        "written_by": f"mujoco {mujoco.__version__}, numpy {np.__version__}, Python {platform.python_version()}",
        "models": {key: plain(record(path)) for key, path in files.items()},
    }
    out.write_text(json.dumps(recorded, indent=1) + "\n")


if __name__ == "__main__":
    main()
