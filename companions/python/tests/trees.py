"""Robots of random shape as URDF, and the same state in the order of this package and of
Pinocchio."""

from __future__ import annotations

import numpy as np


def urdf(seed: int, joints: int, chain: bool = False, kinds: tuple[str, ...] = ("revolute", "continuous", "prismatic")) -> str:
    """A robot of so many joints."""
    random = np.random.default_rng(seed)

    def numbers(values: np.ndarray) -> str:
        return " ".join(f"{value:.12g}" for value in values)

    def link(name: str) -> str:
        mass = random.uniform(0.5, 5.0)
        moments = mass * random.uniform(0.01, 0.05, 3)
        moments[2] = min(moments[2], 0.9 * (moments[0] + moments[1]))
        rpy, com = random.uniform(-1.0, 1.0, 3), random.uniform(-0.2, 0.2, 3)
        xx, yy, zz = np.sort(moments)[[1, 2, 0]] + moments.min()
        return (
            f'<link name="{name}"><inertial><mass value="{mass:.12g}"/>'
            f'<origin xyz="{numbers(com)}" rpy="{numbers(rpy)}"/>'
            f'<inertia ixx="{xx:.12g}" iyy="{yy:.12g}" izz="{zz:.12g}" ixy="0" ixz="0" iyz="0"/></inertial></link>'
        )

    parts = ['<robot name="tree">', link("base")]
    for i in range(joints):
        parent = i if chain else random.integers(max(0, i - 2), i + 1)
        parent_name = "base" if parent == 0 else f"link{parent - 1}"
        kind = kinds[random.integers(len(kinds))]
        axis = random.normal(size=3)
        axis /= np.linalg.norm(axis)
        xyz, rpy = random.uniform(-0.4, 0.4, 3), random.uniform(-1.5, 1.5, 3)
        limit = "" if kind == "continuous" else '<limit lower="-3" upper="3" effort="100" velocity="5"/>'
        parts.append(link(f"link{i}"))
        parts.append(
            f'<joint name="joint{i}" type="{kind}"><parent link="{parent_name}"/><child link="link{i}"/>'
            f'<origin xyz="{numbers(xyz)}" rpy="{numbers(rpy)}"/><axis xyz="{numbers(axis)}"/>{limit}</joint>'
        )
    parts.append("</robot>")
    return "".join(parts)


class Peer:
    """The robot in Pinocchio, with the states of this package."""

    def __init__(self, text: str, free: bool = False) -> None:
        import pinocchio as pin

        self.pin, self.free = pin, free
        self.model = pin.buildModelFromXML(text, pin.JointModelFreeFlyer()) if free else pin.buildModelFromXML(text)
        self.model.gravity.linear = np.array([0.0, 0.0, -9.81])
        self.data = self.model.createData()
        self.names = [name for name in self.model.names if name != "universe"]

    def order(self, robot) -> list[int]:
        """For each joint of ours the one of Pinocchio."""
        ours = robot.joints[1:] if self.free else robot.joints
        theirs = [name for name in self.names if name != "root_joint"]
        return [theirs.index(name) for name in ours]

    def q(self, robot, q: np.ndarray) -> np.ndarray:
        head, tail = (q[:7], q[7:]) if self.free else (q[:0], q)
        moved = np.empty_like(tail)
        moved[self.order(robot)] = tail
        base = [head[4:7], head[:4]] if self.free else []
        full = []
        joints = [name for name in self.names if name != "root_joint"]
        for name, value in zip(joints, moved):
            joint = self.model.joints[self.model.getJointId(name)]
            full.extend([value] if joint.nq == 1 else [np.cos(value), np.sin(value)])
        return np.concatenate([*base, np.array(full)])

    def v(self, robot, v: np.ndarray) -> np.ndarray:
        head, tail = (v[:6], v[6:]) if self.free else (v[:0], v)
        moved = np.empty_like(tail)
        moved[self.order(robot)] = tail
        base = [head[3:6], head[:3]] if self.free else []
        return np.concatenate([*base, moved])

    def back(self, robot, v: np.ndarray) -> np.ndarray:
        """A vector of Pinocchio's velocity coordinates in ours."""
        head, tail = (v[:6], v[6:]) if self.free else (v[:0], v)
        base = [head[3:6], head[:3]] if self.free else []
        return np.concatenate([*base, tail[self.order(robot)]])


def states(robot, count: int, seed: int = 1) -> tuple[np.ndarray, ...]:
    """q, q̇, q̈ and τ, with unit quaternions."""
    random = np.random.default_rng(seed)
    q = random.uniform(-2.5, 2.5, (count, robot.nq))
    at = 0
    for kind in robot.joint_kinds:
        if kind in ("free", "spherical"):
            q[:, at : at + 4] /= np.linalg.norm(q[:, at : at + 4], axis=1, keepdims=True)
        at += {"free": 7, "spherical": 4, "fixed": 0, "planar": 3}.get(kind, 1)
    v, a, tau = (random.uniform(-2.0, 2.0, (count, robot.nv)) for _ in range(3))
    return q, v, a, tau * 10.0
