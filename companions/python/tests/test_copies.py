"""Robots and scenes that are pickled, copied, and sent to processes."""

import copy
import multiprocessing
import pickle

import numpy as np
import pytest

import machines
import robot_dynamics as rd
from trees import states, urdf

ONES = [1.0] * 6
SCENES = [
    rd.Gravity(9.7, [0.6, 0.0, -0.8]), rd.Inertia(), rd.Coriolis(), rd.MovingBase(ONES, [0.1] * 6), rd.Viscous(ONES),
    rd.Coulomb(ONES, 0.1), rd.AsymmetricCoulomb(ONES, [0.3] * 6, 0.1), rd.Stribeck(ONES, 0.2, 0.1),
    rd.Lugre(ONES, ONES, ONES, ONES, ONES, 0.1, [1e-3] * 6), rd.LoadFriction(ONES, ONES, 0.1), rd.Spring(ONES, [1 / 3] * 6),
    rd.EndStops([-1.0] * 6, ONES, 10.0, 1.0, 0.01), rd.Cogging(ONES, [[0.1, 0.2]] * 6, [[0.3]] * 6), rd.Armature(ONES),
    rd.ConstantTorque([0.1] * 6), rd.GyroscopicRotors([1e-4] * 6, ONES), rd.Payload("wrist_3", 0.7, [0.1, 0.0, 1 / 7]),
    rd.BodyWrench(3, ONES), rd.WorldWrench("wrist_3", ONES),
    rd.Contact([("wrist_3", [0.1, 0.0, 0.0]), (2, [0.0] * 3)], [0.0, 0.6, 0.8], 0.1, 100.0, 1.0, 0.01, 0.5, 0.01),
]  # fmt: skip


def ways(thing):
    yield copy.copy(thing)
    yield copy.deepcopy(thing)
    yield copy.deepcopy([thing])[0]
    for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
        yield pickle.loads(pickle.dumps(thing, protocol))


def test_scenes_are_equal_after_it():
    whole = rd.Scene(*SCENES)
    for scene in (*SCENES, rd.RIGID_BODY, whole, rd.Scene()):
        for again in ways(scene):
            assert again == scene and repr(again) == repr(scene) and hash(again) == hash(scene)
    with pytest.raises(rd.EffectError, match="pickle"):
        rd._native._scene("[1]")


def robots():
    yield rd.Robot("ur5e")
    yield rd.Robot("a1_free")
    yield machines.bars()
    for exact in (True, False):
        yield rd.Robot.from_text(urdf(seed=21, joints=9, kinds=("revolute", "continuous", "prismatic")), exact=exact)
    yield rd.Robot.from_text(urdf(seed=22, joints=40), free_base=True)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_robots_compute_the_same_bits_after_it(dtype):
    for robot in robots():
        q, v, a, _ = (x.astype(dtype) for x in states(robot, 3))
        for again in ways(robot):
            assert again.rnea(q, v, a).tobytes() == robot.rnea(q, v, a).tobytes()
            assert again == robot and hash(again) == hash(robot) and again != rd.Robot("panda")
            assert (again.joints, again.frames, again.notes) == (robot.joints, robot.frames, robot.notes)
    with pytest.raises(rd.ModelError, match="pickle"):
        rd._native._robot("{}")


def test_loops_of_a_file_stay(tmp_path):
    text = (
        '<mujoco><worldbody><body name="a"><inertial pos="0.1 0 0" mass="1" diaginertia="0.01 0.01 0.01"/><joint name="ja" axis="0 0 1"/>'
        '<body name="b" pos="0.2 0 0"><inertial pos="0.1 0 0" mass="1" diaginertia="0.01 0.01 0.01"/><joint name="jb" axis="0 0 1"/>'
        '</body></body><body name="c" pos="0.5 0 0"><inertial pos="0.1 0 0" mass="1" diaginertia="0.01 0.01 0.01"/>'
        '<joint name="jc" axis="0 0 1"/></body></worldbody><equality><connect name="pin" body1="b" body2="c" anchor="0.3 0 0"/>'
        '</equality><actuator><motor joint="ja"/></actuator></mujoco>'
    )
    path = tmp_path / "bars.xml"
    path.write_text(text)
    robot = rd.Robot.from_file(path)
    path.unlink()
    again = pickle.loads(pickle.dumps(robot))
    first, second = rd.Loops(robot), rd.Loops(again)
    assert (first.names, first.actuated, first.nl) == (second.names, second.actuated, second.nl) and first.names == ["pin"]


def test_scenes_and_robots_that_differ_are_not_equal():
    assert rd.Viscous(ONES) != rd.Viscous([2.0] * 6) and rd.Viscous([0.0] * 6) == rd.Viscous([-0.0] * 6)
    assert hash(rd.Viscous([0.0] * 6)) == hash(rd.Viscous([-0.0] * 6)) and len({rd.Gravity(), rd.Gravity(9.81)}) == 1
    text = urdf(seed=24, joints=6)
    assert rd.Robot.from_text(text) == rd.Robot.from_text(text) != rd.Robot.from_text(urdf(seed=25, joints=6))


def torque(robot, scene, q):
    return robot.rnea(q, 0 * q, 0 * q, scene)


def test_a_process_that_is_spawned_has_them():
    robot, scene = rd.Robot.from_text(urdf(seed=23, joints=6)), rd.RIGID_BODY + rd.Viscous(ONES)
    q = states(robot, 4)[0]
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        found = pool.starmap(torque, [(robot, scene, q)])
    assert found[0].tobytes() == torque(robot, scene, q).tobytes()
