"""Torques by Pinocchio (URDF) or MuJoCo (MJCF) at the motions of a request on stdin, as JSON on stdout.

The request: path, format, joints (name, kind, and for a free base the name "floating_base"), locked (name, position) and
motions (q, v, a in the library's order: quaternion before position, angular before linear velocity).
"""

import json
import sys


def pinocchio(request):
    import numpy
    import pinocchio

    free = any(joint["name"] == "floating_base" for joint in request["joints"])
    root = (pinocchio.JointModelFreeFlyer(),) if free else ()
    model = pinocchio.buildModelFromUrdf(request["path"], *root)
    model.gravity.linear = numpy.array([0.0, 0.0, -9.81])
    data = model.createData()
    names = {"floating_base": "root_joint"}
    rows = []
    for motion in request["motions"]:
        q = pinocchio.neutral(model)
        v, a = numpy.zeros(model.nv), numpy.zeros(model.nv)
        for name, position in request["locked"]:
            if not model.existJointName(name):
                continue
            joint = model.joints[model.getJointId(name)]
            put(q, joint, [position])
        at_q = at_v = 0
        order = []
        for joint in request["joints"]:
            own = model.joints[model.getJointId(names.get(joint["name"], joint["name"]))]
            nq, nv = joint["coordinates"]
            qi = motion["q"][at_q : at_q + nq]
            vi = motion["qd"][at_v : at_v + nv]
            ai = motion["qdd"][at_v : at_v + nv]
            at_q, at_v = at_q + nq, at_v + nv
            if joint["kind"] == "Free":
                qi, vi, ai = qi[4:] + qi[:4], vi[3:] + vi[:3], ai[3:] + ai[:3]
                order += [own.idx_v + k for k in (3, 4, 5, 0, 1, 2)]
            elif joint["kind"] in ("Revolute", "Continuous", "Prismatic", "Spherical"):
                order += [own.idx_v + k for k in range(nv)]
            else:
                raise ValueError("a joint of kind " + joint["kind"] + " is not compared")
            put(q, own, qi)
            v[own.idx_v : own.idx_v + nv] = vi
            a[own.idx_v : own.idx_v + nv] = ai
        tau = pinocchio.rnea(model, data, q, v, a)
        rows.append([float(tau[i]) for i in order])
    return {"name": "Pinocchio " + pinocchio.__version__, "torques": rows}


def put(q, joint, position):
    import math

    if joint.nq == 2 and joint.nv == 1:
        position = [math.cos(position[0]), math.sin(position[0])]
    q[joint.idx_q : joint.idx_q + joint.nq] = position


def mujoco(request):
    import mujoco
    import numpy

    model = mujoco.MjModel.from_xml_path(request["path"])
    model.opt.gravity[:] = [0.0, 0.0, -9.81]
    # Only rigid-body terms: no constraint, no passive force, no armature.
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    model.dof_damping[:] = 0.0
    model.dof_frictionloss[:] = 0.0
    model.dof_armature[:] = 0.0
    model.jnt_stiffness[:] = 0.0
    data = mujoco.MjData(model)
    names = {}
    for j in range(model.njnt):
        names[model.joint(j).name or "joint_%d" % j] = j
    rows = []
    for motion in request["motions"]:
        data.qpos[:] = model.qpos0
        data.qvel[:] = 0.0
        data.qacc[:] = 0.0
        for name, position in request["locked"]:
            if name in names:
                j = names[name]
                data.qpos[model.jnt_qposadr[j]] = position + model.qpos0[model.jnt_qposadr[j]]
        at_q = at_v = 0
        parts = []
        for joint in request["joints"]:
            nq, nv = joint["coordinates"]
            q = numpy.array(motion["q"][at_q : at_q + nq])
            v = numpy.array(motion["qd"][at_v : at_v + nv])
            a = numpy.array(motion["qdd"][at_v : at_v + nv])
            at_q, at_v = at_q + nq, at_v + nv
            j = names[joint["name"]]
            i, k = model.jnt_dofadr[j], model.jnt_qposadr[j]
            turn = None
            if joint["kind"] in ("Revolute", "Continuous", "Prismatic"):
                q = q + model.qpos0[k]
            elif joint["kind"] in ("Spherical", "Free"):
                q[:4] = q[[3, 0, 1, 2]]
                if joint["kind"] == "Free":
                    # There, the linear velocity is in the axes of the world, and before the angular one.
                    turn = numpy.zeros(9)
                    mujoco.mju_quat2Mat(turn, q[:4])
                    turn = turn.reshape(3, 3)
                    a = numpy.concatenate([turn @ (a[3:] + numpy.cross(v[:3], v[3:])), a[:3]])
                    v = numpy.concatenate([turn @ v[3:], v[:3]])
                    q = numpy.concatenate([q[4:], q[:4]])
            else:
                raise ValueError("a joint of kind " + joint["kind"] + " is not compared")
            data.qpos[k : k + nq] = q
            data.qvel[i : i + nv] = v
            data.qacc[i : i + nv] = a
            parts.append((i, nv, turn))
        mujoco.mj_inverse(model, data)
        torques = []
        for i, nv, turn in parts:
            f = data.qfrc_inverse[i : i + nv]
            if turn is not None:
                f = numpy.concatenate([f[3:], turn.T @ f[:3]])
            torques += [float(x) for x in f]
        rows.append(torques)
    return {"name": "MuJoCo " + mujoco.__version__, "torques": rows}


request = json.load(sys.stdin)
compared, package, requirement = {
    "Urdf": (pinocchio, "pinocchio", "pin"),
    "Mjcf": (mujoco, "mujoco", "mujoco"),
}[request["format"]]
try:
    json.dump(compared(request), sys.stdout)
except ImportError:
    sys.exit("it has no package %s: pip install %s, or --python names another Python" % (package, requirement))
