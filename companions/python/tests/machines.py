"""The machines of `bits/src/machines.rs` as files: a four-bar linkage, and a beam with an arm."""

from __future__ import annotations

import robot_dynamics as rd


def link(name: str, mass: float, com: object, inertia: object) -> str:
    xyz = " ".join(map(repr, com))
    moments = " ".join(f'{name}="{x!r}"' for name, x in zip(("ixx", "ixy", "ixz", "iyy", "iyz", "izz"), inertia))
    return f'<link name="{name}"><inertial><mass value="{mass!r}"/><origin xyz="{xyz}"/><inertia {moments}/></inertial></link>'


def joint(parent: str, child: str, x: float, axis: str = "0 0 1") -> str:
    return (
        f'<joint name="{child}_joint" type="revolute"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{x!r} 0 0"/><axis xyz="{axis}"/><limit lower="-7" upper="7" effort="9" velocity="9"/></joint>'
    )


def bar(parent: str, name: str, x: float, mass: float) -> str:
    return link(name, mass, (0.1, 0.01, 0.02), (0.001, 0.0002, 0.0001, 0.004, 0.0003, 0.004)) + joint(parent, name, x)


def bars() -> rd.Robot:
    parts = [bar("base", "crank", 0.0, 0.5), bar("crank", "coupler", 0.2, 1.0), bar("base", "rocker", 0.6, 0.8)]
    return rd.Robot.from_text('<robot name="bars"><link name="base"/>' + "".join(parts) + "</robot>", exact=False)


def pin(kind: str = "revolute") -> rd.LoopJoint:
    return rd.LoopJoint("pin", kind, ("coupler", "rocker"), ([0.5, 0.0, 0.0], [0.4, 0.0, 0.0]))


def four_bar() -> rd.Linkage:
    return rd.FourBar(0.6, 0.2, 0.5, 0.4)


BEAM = rd.Beam(0.5, 0.8, bending=[4.0, 6.0], tip=[0.3, 1e-4], damping_ratio=0.02)


def boom() -> rd.FlexibleRobot:
    beam = link("beam", BEAM.mass, BEAM.com, BEAM.inertia) + joint("base", "beam", 0.0, "0 1 0")
    text = '<robot name="boom"><link name="base"/>' + beam + bar("beam", "arm", 0.5, 0.4) + "</robot>"
    shapes = [("bend_z", 1), ("bend_z", 2), ("bend_y", 1)]
    return rd.FlexibleRobot(rd.Robot.from_text(text, exact=False), [BEAM.link("beam", shapes)])
