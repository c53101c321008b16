"""The package itself: what it needs, its stubs and its documentation."""

import importlib.metadata
import inspect
import json
import pathlib
import re

import robot_dynamics as rd
from robot_dynamics import _native

HERE = pathlib.Path(__file__).resolve().parents[1]


def test_numpy_is_its_only_dependency():
    (needed,) = importlib.metadata.requires("robot_dynamics")
    assert needed.startswith("numpy")


def test_every_public_name_is_documented():
    for name in rd.__all__:
        thing = getattr(rd, name)
        assert inspect.getdoc(thing), name
    for name, method in vars(rd.Robot).items():
        if not name.startswith("_"):
            assert method.__doc__, name


def test_algorithms_state_shapes_and_units():
    for name in ("rnea", "crba", "aba", "jacobian", "kinetic_energy", "momentum", "center_of_mass"):
        text = getattr(rd.Robot, name).__doc__
        assert "(…" in text, name
    assert "N·m" in rd.Robot.rnea.__doc__ and "kg·m²" in rd.Robot.crba.__doc__ and "J" in rd.Robot.kinetic_energy.__doc__


def test_everything_native_is_exported():
    hidden = {name for name in dir(_native) if not name.startswith("_")} - set(rd.__all__)
    assert hidden == set()


def test_the_notebook_has_no_error_stored():
    notebook = json.loads((HERE / "five_minutes.ipynb").read_text())
    code = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    assert len(code) >= 8
    for cell in code:
        assert cell["execution_count"] and all(out["output_type"] != "error" for out in cell["outputs"])


def test_the_guide_runs():
    page = (HERE.parent / "docs/guide/src/python.md").read_text()
    names = {}
    for block in re.findall(r"```python\n(.*?)```", page, re.S):
        exec(block, names)
    assert names["tau"].shape == (6,)
