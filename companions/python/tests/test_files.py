"""Robots from files, and files that are hostile."""

import pathlib

import numpy as np
import pytest

import robot_dynamics as rd
from trees import urdf

MJCF = """<mujoco model="m"><worldbody><body name="rod"><joint name="pivot" axis="0 1 0" damping="0.3" armature="0.02"
 frictionloss="0.1"/><inertial pos="0 0 -0.5" mass="2" diaginertia="0.1 0.1 0.001"/></body></worldbody></mujoco>"""
PENDULUM = """<robot name="pendulum"><link name="base"/><link name="rod"><inertial><mass value="2"/>
<origin xyz="0 0 -0.5"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.001"/></inertial></link>
<joint name="pivot" type="revolute"><parent link="base"/><child link="rod"/><axis xyz="0 1 0"/>
<limit lower="-1" upper="2" effort="30" velocity="4"/></joint></robot>"""


def test_a_file_is_its_text(tmp_path):
    path = tmp_path / "pendulum.urdf"
    path.write_text(PENDULUM)
    for robot in (rd.Robot.from_file(path), rd.Robot.from_file(str(path)), rd.Robot.from_text(PENDULUM)):
        assert (robot.name, robot.bodies, robot.joints) == ("pendulum", ["rod"], ["pivot"])
        assert (robot.nq, robot.nv, robot.parents, robot.joint_kinds) == (1, 1, [None], ["revolute"])
        assert robot.lower_limits == [-1.0] and robot.upper_limits == [2.0]
        assert robot.velocity_limits == [4.0] and robot.torque_limits == [30.0]
        assert robot.library_name is None and "pendulum" in repr(robot)
        assert np.allclose(robot.gravity([0.5]), 2 * 9.81 * 0.5 * np.sin(0.5))


def test_mjcf_has_its_friction():
    robot = rd.Robot.from_text(MJCF)
    assert np.array_equal([robot.damping, robot.friction, robot.armature], [[0.3], [0.1], [0.02]])
    stated = rd.RIGID_BODY + rd.Viscous([0.3]) + rd.Coulomb([0.1], 0.02) + rd.Armature([0.02])
    assert robot.scene() == stated and rd.Robot.from_text(PENDULUM).scene() == rd.RIGID_BODY
    assert robot.scene(0.5).names == stated.names and robot.scene(0.5) != stated
    assert np.allclose(robot.gravity([0.5]), 2 * 9.81 * 0.5 * np.sin(0.5))


def test_selections_of_a_file():
    text = urdf(seed=11, joints=8, chain=True, kinds=("revolute",))
    assert rd.Robot.from_text(text).nv == 8
    assert rd.Robot.from_text(text, tip="link4").joints == [f"joint{i}" for i in range(5)]
    assert rd.Robot.from_text(text, joints=["joint1", "joint3"]).nv == 2
    assert rd.Robot.from_text(text, without=["link6"]).nv == 6
    assert rd.Robot.from_text(text, lock={"joint2": 0.3}).nv == 7
    free = rd.Robot.from_text(text, free_base=True)
    assert (free.nq, free.nv, free.joint_kinds[0]) == (15, 14, "free")
    for wrong in (dict(tip="hand"), dict(joints=["elbow"]), dict(lock={"joint2": float("nan")}), dict(base="hand")):
        with pytest.raises(rd.DescriptionError):
            rd.Robot.from_text(text, **wrong)


def test_errors_have_line_and_element():
    with pytest.raises(rd.DescriptionError) as error:
        rd.Robot.from_text(PENDULUM.replace('mass value="2"', 'mass value="two"'))
    assert error.value.line == 1 and "mass" in error.value.problem + error.value.element
    with pytest.raises(FileNotFoundError) as error:
        rd.Robot.from_file("/no/such/robot.urdf")
    assert isinstance(error.value, rd.UnreadableFile) and isinstance(error.value, rd.DescriptionError)
    with pytest.raises(rd.UnreadableFile) as error:
        rd.Robot.from_file("/")
    assert not isinstance(error.value, FileNotFoundError)
    with pytest.raises(rd.DescriptionError, match="link `rod`: its mass is -2 kg"):
        rd.Robot.from_text(PENDULUM.replace('mass value="2"', 'mass value="-2"'))
    with pytest.raises(rd.ModelError, match="at most 64") as error:
        rd.Robot.from_text(urdf(seed=12, joints=65, kinds=("revolute",)))
    assert error.value.body is None


# Further ones are those of the importer's own tests.
HOSTILE = {
    "no xml": "hello",
    "nothing moves": "<robot name='a'><link name='b'/></robot>",
    "outside entity": '<!DOCTYPE a [<!ENTITY x SYSTEM "file:///etc/passwd">]><robot name="&x;"/>',
    "huge": PENDULUM.replace('xyz="0 0 -0.5"', 'xyz="1e300 0 0"'),
    "deep": "<a>" * 100_000,
    "include": "<mujoco><include file='../../../../etc/passwd'/></mujoco>",
}


@pytest.mark.parametrize("text", HOSTILE.values(), ids=HOSTILE)
def test_hostile_files_raise_and_write_nothing(text, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises((rd.DescriptionError, rd.ModelError)):
        rd.Robot.from_text(text)
    path = tmp_path / "robot.xml"
    path.write_bytes(text.encode())
    with pytest.raises((rd.DescriptionError, rd.ModelError)):
        rd.Robot.from_file(path)
    assert [entry.name for entry in tmp_path.iterdir()] == ["robot.xml"]


def test_a_file_that_is_no_text_or_a_folder_raises(tmp_path):
    path = tmp_path / "robot.urdf"
    path.write_bytes(bytes(range(256)) * 10)
    for wrong in (path, tmp_path, "/dev/null"):
        with pytest.raises(rd.DescriptionError):
            rd.Robot.from_file(wrong)
    path.write_bytes(b"<robot>" + b" " * (40 << 20))
    with pytest.raises(rd.DescriptionError, match="bytes in the file"):
        rd.Robot.from_file(path)


HERE = pathlib.Path(__file__).parent / "files"


def test_joints_that_follow_others_are_told():
    claw = rd.Robot.from_file(HERE / "claw.urdf")
    found = {(c.joint, c.leader): (c.ratio, c.offset) for c in claw.couplings}
    assert found == {
        ("f1", "lead"): (-1.5, 0.25),
        ("slide", "lead"): (0.02, 0.01),
        # It follows f1, which follows: 2 (−1.5 lead + 0.25) is not what the file says; it says
        # lead.
        ("f2", "lead"): (2.0, 0.0),
    }
    assert rd.Robot.from_text(PENDULUM).couplings == [] and rd.Robot("ur5e").couplings == []


def test_advice_of_the_importer_is_there():
    arm = rd.Robot.from_file(HERE / "grams_and_millimetres.urdf")
    units = [one for one in arm.advice if one.topic == "units" or one.topic == "placeholder"]
    assert {one.name for one in units} == {"upper", "fore"}
    assert all(("kg·mm²" in one.text or "other units" in one.text) and one.line in (2, 3, 4) for one in units), arm.advice
    assert rd.Robot("ur5e").advice == [] == rd.Robot("ur5e").notes


def test_what_a_file_states_and_the_robot_has_not_is_noted():
    ball = rd.Robot.from_file(HERE / "spring.xml")
    (note,) = [note for note in ball.notes if "spring" in note.lower() or "stiffness" in note]
    assert [one.text for one in ball.advice if one.topic == "left-out"] == ball.notes and note
    text = MJCF.replace('armature="0.02"', 'armature="0.02" stiffness="3" springref="20"')
    hinge = rd.Robot.from_text(text)
    assert hinge.spring_stiffness == [3.0] and np.allclose(hinge.spring_rest, [np.radians(20.0)])
    without = rd.Robot.from_text(urdf(seed=11, joints=8, chain=True, kinds=("revolute",)), without=["link6"])
    assert any("link6" in note and "kg" in note for note in without.notes), without.notes
