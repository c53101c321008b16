"""The suite's robots in other libraries: each class gives tau, M and qdd of a state, or None where it refuses.

A robot's links are in depth-first order here, as both libraries number joints.
"""

import importlib.metadata
import math
import tempfile

import numpy as np


class NotAsked(Exception):
    """The library has no way to state the case."""


class Pinocchio:
    """Featherstone's algorithms in link coordinates: rnea, crba and aba."""

    def __init__(self, links, gravity):
        import pinocchio as pin

        self.pin, self.model = pin, pin.Model()
        self.model.gravity.linear = np.array(gravity)
        ids = {-1: 0}
        for i, link in enumerate(links):
            place = pin.SE3(np.array(link["rotation"]), np.array(link["translation"]))
            ids[i] = self.model.addJoint(ids[link["parent"]], self.joint(link), place, f"joint{i}")
            xx, xy, xz, yy, yz, zz = link["inertia"]
            about = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
            load = pin.Inertia(link["mass"], np.array(link["com"]), about)
            self.model.appendBodyToJoint(ids[i], load, pin.SE3.Identity())
        self.model.armature = np.array([link["armature"] for link in links])
        self.data = self.model.createData()

    def joint(self, link):
        slides = link["joint"] == "prismatic"
        for letter, along in zip("XYZ", np.eye(3)):
            if np.array_equal(link["axis"], along):
                return getattr(self.pin, f"JointModel{'P' if slides else 'R'}{letter}")()
        name = "JointModelPrismaticUnaligned" if slides else "JointModelRevoluteUnaligned"
        return getattr(self.pin, name)(np.array(link["axis"]))

    def tau(self, q, qd, qdd):
        return self.pin.rnea(self.model, self.data, q, qd, qdd).copy()

    def matrix(self, q):
        upper = np.triu(self.pin.crba(self.model, self.data, q))
        return upper + np.triu(upper, 1).T

    def qdd(self, q, qd, tau):
        return self.pin.aba(self.model, self.data, q, qd, tau).copy()

    @staticmethod
    def version():
        import pinocchio

        return f"Pinocchio {pinocchio.__version__}"


class MuJoCo:
    """Composite bodies in world-aligned axes about the centre of mass of each tree, and LᵀDL: mj_inverse and mj_forward."""

    def __init__(self, links, gravity):
        import mujoco

        self.mujoco = mujoco
        children = {i: [] for i in range(-1, len(links))}
        for i, link in enumerate(links):
            children[link["parent"]].append(i)
        body = lambda i: self.body(links[i], "".join(body(k) for k in children[i]))
        text = f"""<mujoco><option gravity="{numbers(gravity)}"><flag contact="disable" constraint="disable"/></option>
            <worldbody>{"".join(body(k) for k in children[-1])}</worldbody></mujoco>"""
        self.model = mujoco.MjModel.from_xml_string(text)
        self.data = mujoco.MjData(self.model)

    def body(self, link, inside):
        quaternion = np.zeros(4)
        self.mujoco.mju_mat2Quat(quaternion, np.array(link["rotation"]).flatten())
        kind = "slide" if link["joint"] == "prismatic" else "hinge"
        return f"""<body pos="{numbers(link["translation"])}" quat="{numbers(quaternion)}">
            <joint type="{kind}" axis="{numbers(link["axis"])}" armature="{link["armature"]!r}"/>
            {self.inertial(link)}{inside}</body>"""

    def inertial(self, link):
        """By the moments alone where there are no products: MuJoCo then has no axes to find."""
        xx, xy, xz, yy, yz, zz = link["inertia"]
        moments, products = [xx, yy, zz], [xy, xz, yz]
        name, inertia = ("fullinertia", moments + products) if any(products) else ("diaginertia", moments)
        if link["mass"] == 0 and not any(inertia):
            return ""
        return f'<inertial pos="{numbers(link["com"])}" mass="{link["mass"]!r}" {name}="{numbers(inertia)}"/>'

    def set(self, q, qd):
        self.data.qpos[:], self.data.qvel[:], self.data.qfrc_applied[:] = q, qd, 0

    def tau(self, q, qd, qdd):
        self.set(q, qd)
        self.data.qacc[:] = qdd
        self.mujoco.mj_inverse(self.model, self.data)
        return self.data.qfrc_inverse.copy()

    def matrix(self, q):
        self.set(q, 0)
        self.mujoco.mj_forward(self.model, self.data)
        m = np.zeros((len(q), len(q)))
        self.mujoco.mj_fullM(self.model, self.data, m)
        return m

    def qdd(self, q, qd, tau):
        self.set(q, qd)
        self.data.qfrc_applied[:] = tau
        self.mujoco.mj_forward(self.model, self.data)
        return self.data.qacc.copy()

    @staticmethod
    def version():
        import mujoco

        return f"MuJoCo {mujoco.__version__}"


class Dynibo:
    """A robot read from a URDF; its gravity is fixed, and the difference to that of the suite is added to the torques."""

    GRAVITY = 9.80665

    def __init__(self, links, gravity):
        import dynibo

        if any(link["armature"] for link in links):
            raise NotAsked("a URDF has no rotors")
        if gravity[2] == 0:
            raise NotAsked("its gravity is fixed")
        self.more = -gravity[2] / self.GRAVITY - 1
        depth = []
        for link in links:
            depth.append(depth[link["parent"]] + 1 if link["parent"] >= 0 else 0)
        self.order = np.argsort(depth, kind="stable")  # It numbers joints breadth-first.
        self.back = np.argsort(self.order)
        with tempfile.NamedTemporaryFile("w", suffix=".urdf") as file:
            file.write(urdf(links))
            file.flush()
            try:
                self.robot = dynibo.Robot.from_urdf(file.name)
            except dynibo.DyniboError as error:
                raise ValueError(str(error)) from error

    def gravity(self, q):
        return self.more * np.array(self.robot.gravity(q[self.order]))[self.back]

    def tau(self, q, qd, qdd):
        found = self.robot.inverse_dynamics(*[x[self.order] for x in (q, qd, qdd)])
        return np.array(found)[self.back] + self.gravity(q)

    def matrix(self, q):
        found = np.array(self.robot.mass_matrix(q[self.order])).reshape(len(q), len(q))
        return found[np.ix_(self.back, self.back)]

    def qdd(self, q, qd, tau):
        import dynibo

        tau = tau - self.gravity(q)
        try:
            found = self.robot.forward_dynamics(*[x[self.order] for x in (q, qd, tau)])
        except dynibo.DyniboError:
            return np.full(len(q), np.nan)
        return np.array(found)[self.back]

    @staticmethod
    def version():
        return f"dynibo {importlib.metadata.version('dynibo')}"


def urdf(links):
    parts = ['<robot name="suite"><link name="base"/>']
    for i, link in enumerate(links):
        m = link["rotation"]
        across = math.hypot(m[2][1], m[2][2])
        pitch = math.atan2(-m[2][0], across)
        regular = across > 1e-6
        roll = math.atan2(m[2][1], m[2][2]) if regular else 0.0
        yaw = math.atan2(m[1][0], m[0][0]) if regular else math.atan2(-m[0][1], m[1][1])
        parent = f"link{link['parent']}" if link["parent"] >= 0 else "base"
        kind = "prismatic" if link["joint"] == "prismatic" else "revolute"
        moments = zip(("ixx", "ixy", "ixz", "iyy", "iyz", "izz"), link["inertia"])
        inertia = " ".join(f'{name}="{x!r}"' for name, x in moments)
        parts.append(f"""<link name="link{i}"><inertial><origin xyz="{numbers(link["com"])}" rpy="0 0 0"/>
            <mass value="{link["mass"]!r}"/><inertia {inertia}/></inertial></link>
            <joint name="joint{i:02}" type="{kind}"><parent link="{parent}"/><child link="link{i}"/>
            <origin xyz="{numbers(link["translation"])}" rpy="{numbers([roll, pitch, yaw])}"/>
            <axis xyz="{numbers(link["axis"])}"/><limit lower="-1e9" upper="1e9" effort="1e9" velocity="1e9"/></joint>""")
    return "".join(parts) + "</robot>"


def numbers(row):
    return " ".join(repr(float(x)) for x in row)


LIBRARIES = {"pinocchio": Pinocchio, "mujoco": MuJoCo, "dynibo": Dynibo}
