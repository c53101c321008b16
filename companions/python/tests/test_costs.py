"""Cycles are those of the repository's pages."""

import json
import pathlib
import re

import pytest

import robot_dynamics as rd

DOCS = pathlib.Path(__file__).parents[3] / "docs"


def test_costs_are_those_of_the_page():
    rows = json.loads((DOCS / "costs.json").read_text())["rows"]
    names = ("robot", "algorithm", "form", "inputs", "trig")
    (row,) = [row for row in rows if [row[name] for name in names] == ["ur5e", "rnea", "engine", "full", True]]
    (cost,) = [
        cost
        for cost in rd.Robot("ur5e").costs()
        if (cost.algorithm, cost.form, cost.inputs, cost.trigonometry) == ("rnea", "engine", "full", True)
    ]
    found = [cost.instructions, cost.cycles, cost.code, cost.stack]
    assert found == [row[name] for name in ("instructions", "cycles", "code_bytes", "stack_bytes")]
    assert cost.microseconds == pytest.approx(cost.cycles / 168)
    assert len({repr(cost) for cost in rd.Robot("ur5e").costs()}) == len(rd.Robot("ur5e").costs())


def test_the_tick_of_a_scene_is_that_of_the_page():
    page = (DOCS / "scenes.md").read_text()
    cycles = re.search(r"\| \*\*ur5e\*\* +\| +([0-9,]+)", page).group(1)
    assert rd.Robot("ur5e").scene_cycles() == int(cycles.replace(",", ""))


def test_a_robot_without_a_record_says_so():
    for call in (rd.Robot("gen3").costs, rd.Robot("gen3").scene_cycles):
        with pytest.raises(rd.NotRecorded, match="gen3") as error:
            call()
        assert error.value.robot == "gen3"
    file = rd.Robot.from_text(
        '<robot name="ur5e"><link name="a"/><link name="b"><inertial><mass value="1"/>'
        '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>'
        '<joint name="c" type="continuous"><parent link="a"/><child link="b"/></joint></robot>'
    )
    with pytest.raises(rd.NotRecorded):
        file.costs()
