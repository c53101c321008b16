"""Frames that are fixed to bodies, against Pinocchio's frames, and joints by the names of their file."""

import pathlib

import numpy as np
import pytest

import robot_dynamics as rd
from trees import Peer, states

pin = pytest.importorskip("pinocchio")
FILE = pathlib.Path(__file__).parents[3] / "tools/robot-import/tests/urdf/so101.urdf"
JOINTS = ["shoulder_pan", "shoulder_lift", "elbow_flex", "wrist_flex", "wrist_roll", "gripper"]
TOOL = "gripper_frame_link"


@pytest.fixture(scope="module")
def arm():
    return rd.Robot.from_file(FILE, exact=False)


def near(found, expected):
    assert np.abs(found - expected).max() <= 1e-12 * max(np.abs(expected).max(), 1.0)


@pytest.mark.parametrize("name", [TOOL, "base_link", "gripper_link"])
def test_frames_are_pinocchios(arm, name):
    peer = Peer(FILE.read_text())
    model, data, at = peer.model, peer.data, peer.model.getFrameId(name)
    assert name in (arm.bodies if name == "gripper_link" else arm.frames)
    for q, v, a, _ in zip(*states(arm, 5)):
        given = peer.q(arm, q), peer.v(arm, v), peer.v(arm, a)
        pin.computeJointJacobians(model, data, given[0])
        pin.forwardKinematics(model, data, *given)
        place = pin.updateFramePlacement(model, data, at)
        rotation, position = arm.poses(q, name)
        near(rotation, place.rotation), near(position, place.translation)
        for frame, reference in (("local", pin.LOCAL), ("world", pin.WORLD), ("local_world_aligned", pin.LOCAL_WORLD_ALIGNED)):
            theirs = pin.getFrameJacobian(model, data, at, reference)[[3, 4, 5, 0, 1, 2]]
            near(arm.jacobian(q, name, frame), theirs.T[peer.order(arm)].T)
            velocity, _ = arm.kinematics(q, v, a, frame, (rd.Inertia(), rd.Coriolis()), at=name)
            moving = pin.getFrameVelocity(model, data, at, reference)
            near(velocity, np.concatenate([moving.angular, moving.linear]))
            near(arm.jacobian(q, name, frame) @ v, velocity)
        near(arm.osim_inverse(q, name), arm.operational_space(q, name)[2])


def test_tools_of_batches_and_of_the_library(arm):
    own = rd.Robot("so101")
    q = states(arm, 9)[0].reshape(3, 3, 6)
    assert arm.jacobian(q, TOOL).shape == (3, 3, 6, 6) and arm.poses(q, at=TOOL)[1].shape == (3, 3, 3)
    exact = rd.Robot.from_file(FILE)
    assert np.allclose(own.poses(q, TOOL)[1], exact.poses(q, TOOL)[1], atol=1e-12)
    rotation, position = own.poses(np.zeros(6), TOOL)
    found = rd.PoseSolver(own, TOOL).solve(rotation, position, start=[0.1] * 6)
    assert np.allclose(own.poses(found, TOOL)[1], position, atol=1e-6)
    with pytest.raises(rd.UnknownBody, match=f"its frames are {TOOL}"):
        own.jacobian(np.zeros(6), "tool0")


def test_joints_have_the_names_of_their_file(arm):
    assert arm.joints == JOINTS == rd.Robot("so101").joints and rd.Robot("so101").bodies == arm.bodies
    assert rd.Robot("ur5e").joints[:4] == ["shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint", "wrist_1_joint"]
    assert rd.Robot("panda").joints[6] == "panda_joint7" and rd.Robot("a1_free").joints[:2] == ["floating_base", "FR_hip_joint"]
    for name in rd.robots():
        robot = rd.Robot(name)
        assert len(set(robot.joints)) == len(robot.bodies) and not set(robot.joints) & set(robot.bodies)


def test_effects_act_at_frames(arm):
    """Torques of wrenches by the frame's Jacobian, and a load by its inertia in the frame."""
    wrench = np.array([0.3, -0.2, 0.4, 5.0, -3.0, 2.0])
    mass, com, inertia = 0.7, np.array([0.01, -0.02, 0.05]), [2e-3, 1e-4, -2e-4, 3e-3, 3e-4, 4e-3]
    xx, xy, xz, yy, yz, zz = inertia
    c = np.cross(np.eye(3), com)
    about = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) - mass * c @ c
    spatial = np.block([[about, mass * c], [-mass * c, mass * np.eye(3)]])
    for q, v, a, _ in zip(*states(arm, 5)):
        bare = arm.rnea(q, v, a)
        for effect, axes in ((rd.BodyWrench, "local"), (rd.WorldWrench, "local_world_aligned")):
            torque = arm.rnea(q, v, a, rd.RIGID_BODY + effect(TOOL, wrench)) - bare
            near(torque, -arm.jacobian(q, TOOL, axes).T @ wrench)
        jacobian = arm.jacobian(q, TOOL, "local")
        added = arm.crba(q, rd.Inertia() + rd.Payload(TOOL, mass, com, inertia)) - arm.crba(q)
        near(added, jacobian.T @ spatial @ jacobian)
    # A load at one frame, and the result at another.
    probe = "<link name='probe'/><joint name='p' type='fixed'><parent link='lower_arm_link'/><child link='probe'/><origin xyz='0.1 0 0.05'/></joint></robot>"
    probed = rd.Robot.from_text(FILE.read_text().replace("</robot>", probe), exact=False)
    scene, jacobian = rd.Inertia() + rd.Payload("probe", mass), probed.jacobian(q, TOOL, "local")
    near(probed.osim_inverse(q, TOOL, effects=scene), jacobian @ np.linalg.inv(probed.crba(q, scene)) @ jacobian.T)
    with pytest.raises(rd.EffectError, match="no body of the name `nothing`"):
        arm.rnea(q, v, a, rd.BodyWrench("nothing", wrench))
