"""Torques by Pinocchio (URDF) or MuJoCo (MJCF) at the motions of a request on stdin, as JSON on stdout.

The request: text of the description, format, joints (name, index, kind, and for a free base the
name "floating_base"), locked (name, index, position) and motions (q, v, a in the library's order:
quaternion before position, angular before linear velocity). The text is data: nothing of it is run,
and no file that it names is opened.
"""

import sys

# The folder that `python -c` looks for modules in first; nothing has been imported from it yet.
sys.path[:] = [folder for folder in sys.path if folder not in ("", ".")]

import json
import os

# The output of the peers and their libraries is no answer.
answer = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)

NO_PEER = 3


def no_peer(reason):
    sys.stderr.write(reason + "\n")
    sys.exit(NO_PEER)


def pinocchio(request):
    import numpy
    import pinocchio

    free = any(joint["name"] == "floating_base" for joint in request["joints"])
    root = (pinocchio.JointModelFreeFlyer(),) if free else ()
    model = pinocchio.buildModelFromXML(request["text"], *root)
    model.gravity.linear = numpy.array([0.0, 0.0, -9.81])
    # Inertias of rotors are arguments of the library.
    model.armature[:] = 0.0
    data = model.createData()
    names = {"floating_base": "root_joint"}
    rows = []
    for motion in request["motions"]:
        q = pinocchio.neutral(model)
        v, a = numpy.zeros(model.nv), numpy.zeros(model.nv)
        for joint in request["locked"]:
            if len(joint["position"]) == 1 and model.existJointName(joint["name"]):
                put(q, model.joints[model.getJointId(joint["name"])], joint["position"])
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
                no_peer("a joint of kind " + joint["kind"] + " is not compared")
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

    model = mujoco.MjModel.from_xml_string(request["text"])
    # Gravity is an argument of the library: the file's direction, and its flag, are not compared.
    model.opt.gravity[:] = [0.0, 0.0, -9.81]
    model.opt.disableflags &= ~int(mujoco.mjtDisableBit.mjDSBL_GRAVITY)
    model.opt.enableflags = 0
    data = mujoco.MjData(model)
    names = {}
    for j in range(model.njnt):
        names[model.joint(j).name] = j
    rows = []
    for motion in request["motions"]:
        data.qpos[:] = model.qpos0
        data.qvel[:] = 0.0
        data.qacc[:] = 0.0
        # A position is that of the file, with its `ref` in it.
        for joint in request["locked"]:
            j = names.get(joint["name"], joint["index"])
            k, q = model.jnt_qposadr[j], joint["position"]
            data.qpos[k : k + len(q)] = in_mujoco(q)
        at_q = at_v = 0
        parts = []
        for joint in request["joints"]:
            nq, nv = joint["coordinates"]
            q = numpy.array(motion["q"][at_q : at_q + nq])
            v = numpy.array(motion["qd"][at_v : at_v + nv])
            a = numpy.array(motion["qdd"][at_v : at_v + nv])
            at_q, at_v = at_q + nq, at_v + nv
            if joint["name"] == "floating_base" or joint["kind"] == "Planar":
                no_peer("a joint of kind " + joint["kind"] + " is not compared")
            j = names.get(joint["name"], joint["index"])
            i, k = model.jnt_dofadr[j], model.jnt_qposadr[j]
            turn = None
            if joint["kind"] == "Free":
                # There, the linear velocity is in the axes of the world, and before the angular
                # one.
                turn = numpy.zeros(9)
                mujoco.mju_quat2Mat(turn, numpy.roll(q[:4], 1))
                turn = turn.reshape(3, 3)
                a = numpy.concatenate([turn @ (a[3:] + numpy.cross(v[:3], v[3:])), a[:3]])
                v = numpy.concatenate([turn @ v[3:], v[:3]])
            data.qpos[k : k + nq] = in_mujoco(q)
            data.qvel[i : i + nv] = v
            data.qacc[i : i + nv] = a
            parts.append((i, nv, turn))
        # The recursion over rigid bodies alone: it has no spring, damper, tendon, actuator, fluid,
        # compensated weight, rotor or constraint, whatever the file states.
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_comVel(model, data)
        force = numpy.zeros(model.nv)
        mujoco.mj_rne(model, data, 1, force)
        torques = []
        for i, nv, turn in parts:
            f = force[i : i + nv]
            if turn is not None:
                f = numpy.concatenate([f[3:], turn.T @ f[:3]])
            torques += [float(x) for x in f]
        rows.append(torques)
    return {"name": "MuJoCo " + mujoco.__version__, "torques": rows}


def in_mujoco(q):
    """A position in MuJoCo's order: (x, y, z) before (w, x, y, z)."""
    q = list(q)
    return q if len(q) < 4 else q[4:] + q[3:4] + q[:3]


request = json.load(sys.stdin)
compared, package, requirement = {
    "Urdf": (pinocchio, "pinocchio", "pin"),
    "Mjcf": (mujoco, "mujoco", "mujoco"),
}[request["format"]]
try:
    json.dump(compared(request), answer)
except ImportError:
    no_peer("it has no package %s: pip install %s, or --python names another Python" % (package, requirement))
