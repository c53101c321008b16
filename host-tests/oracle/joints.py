"""Our joints and Pinocchio's: kinds, coordinates and their order.

Ours (dynamics_core::model::JointKind), with velocities of the body in its own frame, angular first:

    revolute, continuous, prismatic   q, v one number
    helical       q an angle; the body slides by pitch·q along the axis
    cylindrical   q = (θ, d), about and along one axis
    universal     q = (q1, q2): R = R(axis, q1) R(axis2, q2)
    spherical     q = quaternion (x, y, z, w), v = ω
    planar        q = (θ, x, y), v = (ω, vx, vy)
    free          q = (quaternion, x, y, z), v = (ω, v)

Pinocchio turns a continuous joint by (cos q, sin q), a planar one by (x, y, cos θ, sin θ) with v =
(vx, vy, ω), and puts position before attitude in a free one, q and v alike. Its Python lets nobody
set the axis of a continuous joint, so that those about other axes than x, y, z are revolute there.
"""

import numpy as np
import pinocchio as pin

SIZES = {  # kind: coordinates of q, of v
    "revolute": (1, 1),
    "continuous": (1, 1),
    "prismatic": (1, 1),
    "helical": (1, 1),
    "cylindrical": (2, 2),
    "universal": (2, 2),
    "spherical": (4, 3),
    "planar": (3, 3),
    "free": (7, 6),
    "fixed": (0, 0),
}
SWAP = [3, 4, 5, 0, 1, 2]  # angular before linear, or back
VELOCITY_ORDER = {"free": SWAP, "planar": [2, 0, 1]}  # where Pinocchio has each of our components


def unit(axis):
    return np.array(axis) / np.linalg.norm(axis)


def kind_there(body):
    along = any(np.array_equal(body["axis"], e) for e in np.eye(3))
    return "revolute" if body["joint"] == "continuous" and not along else body["joint"]


def joint_model(body):
    kind, axis = kind_there(body), body["axis"]
    simple = {"spherical": pin.JointModelSpherical, "planar": pin.JointModelPlanar, "free": pin.JointModelFreeFlyer}
    if kind in simple:
        return simple[kind]()
    if kind == "helical":
        return pin.JointModelHelicalUnaligned(unit(axis), body["pitch"])
    if kind == "universal":
        return pin.JointModelUniversal(unit(axis), unit(body["axis2"]))
    if kind == "cylindrical":
        both = pin.JointModelComposite()
        both.addJoint(pin.JointModelRevoluteUnaligned(unit(axis)))
        both.addJoint(pin.JointModelPrismaticUnaligned(unit(axis)))
        return both
    for letter, along in zip("XYZ", np.eye(3)):
        if np.array_equal(axis, along):
            short = {"revolute": "JointModelR", "prismatic": "JointModelP", "continuous": "JointModelRUB"}
            return getattr(pin, short[kind] + letter)()
    general = {"revolute": pin.JointModelRevoluteUnaligned, "prismatic": pin.JointModelPrismaticUnaligned}
    return general[kind](unit(axis))


class Order:
    """Between our coordinates of a robot and Pinocchio's."""

    def __init__(self, robot):
        moving = [body for body in robot["bodies"] if body["joint"] != "fixed"]
        self.kinds = [body["joint"] for body in moving]
        self.nq = 0
        self.at, self.blocks = [], []  # Pinocchio's place of each of our velocities; our blocks of q
        for body in moving:
            kind = kind_there(body)
            nq, nv = SIZES[kind]
            first = len(self.at)
            self.at += [first + k for k in VELOCITY_ORDER.get(kind, range(nv))]
            self.blocks.append((kind, slice(self.nq, self.nq + nq)))
            self.nq += nq
        self.at = np.array(self.at, dtype=int)

    def places(self):
        """Every joint's kind, and where its coordinates begin in our q and v."""
        q_at, v_at = 0, 0
        for kind in self.kinds:
            yield kind, q_at, v_at
            q_at, v_at = q_at + SIZES[kind][0], v_at + SIZES[kind][1]

    def neutral(self):
        q = np.zeros(self.nq)
        for kind, block in self.blocks:
            if kind in ("spherical", "free"):
                q[block.start + 3] = 1.0
        return q

    def q(self, ours):
        """Pinocchio's q."""
        return np.concatenate([self._q(kind, ours[block]) for kind, block in self.blocks])

    @staticmethod
    def _q(kind, q):
        if kind == "continuous":
            return np.array([np.cos(q[0]), np.sin(q[0])])
        if kind == "planar":
            return np.array([q[1], q[2], np.cos(q[0]), np.sin(q[0])])
        if kind == "free":
            return np.concatenate([q[4:], q[:4]])
        return q

    def q_back(self, theirs):
        """Our q of Pinocchio's; angles of continuous and planar joints within ±π."""
        q, at = [], 0
        for kind, block in self.blocks:
            n = {"continuous": 2, "planar": 4}.get(kind, block.stop - block.start)
            x, at = theirs[at : at + n], at + n
            if kind == "continuous":
                q.append([np.arctan2(x[1], x[0])])
            elif kind == "planar":
                q.append([np.arctan2(x[3], x[2]), x[0], x[1]])
            elif kind == "free":
                q.append(np.concatenate([x[3:], x[:3]]))
            else:
                q.append(x)
        return np.concatenate(q)

    def v(self, ours):
        """Pinocchio's v, or any column over velocity coordinates."""
        theirs = np.empty_like(ours)
        theirs[self.at] = ours
        return theirs

    def v_back(self, theirs):
        """Our v of Pinocchio's, or torque; of a matrix, its last axis."""
        return np.array(theirs)[..., self.at]

    def square(self, theirs):
        """A symmetric matrix over velocity coordinates, of which Pinocchio wrote the upper triangle."""
        upper = np.triu(theirs)
        return (upper + np.triu(upper, 1).T)[np.ix_(self.at, self.at)]


def six(motion):
    """A spatial vector, angular first."""
    return np.concatenate([motion.angular, motion.linear])


def rows(jacobian):
    """A matrix of six rows, angular first."""
    return np.array(jacobian)[SWAP]
