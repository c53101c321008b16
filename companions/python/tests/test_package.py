"""The package itself: what it needs, its stubs and its documentation."""

import importlib.metadata
import inspect
import json
import pathlib
import re

import subprocess
import sys

import robot_dynamics as rd
from robot_dynamics import _native

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
import stubs  # noqa: E402

PUBLIC = [name for name in dir(rd) if not name.startswith("_") and name != "errors"]
HERE = pathlib.Path(__file__).resolve().parents[1]


def test_numpy_is_its_only_dependency():
    (needed,) = importlib.metadata.requires("robot_dynamics")
    assert needed.startswith("numpy")


def test_every_public_name_is_documented():
    for name in PUBLIC:
        thing = getattr(rd, name)
        assert inspect.getdoc(thing), name
    for thing in {getattr(rd, name) for name in CLASSES.values()}:
        for name, method in vars(thing).items():
            if not name.startswith("_"):
                assert method.__doc__, name


def test_algorithms_state_shapes_and_units():
    for name in algorithms():
        module, function = name.split(".")
        text = getattr(getattr(rd, CLASSES[module]), function, None)
        assert text is None or "(…" in text.__doc__ or function in ("neutral", "inertial_parameters"), name
    assert "N·m" in rd.Robot.rnea.__doc__ and "kg·m²" in rd.Robot.crba.__doc__ and "J" in rd.Robot.kinetic_energy.__doc__


CORE = HERE.parents[1] / "dynamics-core/src"
# The class of the wheel that has a module's functions.
CLASSES = {"algorithms": "Robot", "drivetrain": "Robot", "manifold": "Robot", "loops": "Loops", "clusters": "Linkages", "flexible": "FlexibleRobot"}
WITHOUT = {
    "algorithms.classical": "lin + ω × v of the arrays of `kinematics`",
    "algorithms.damped_inverse": "`operational_space` computes it",
    "algorithms.eigen": "hidden in the library: numpy.linalg.eigh",
    "algorithms.shifted_solution": "hidden in the library: numpy.linalg.solve",
    "algorithms.jacobian_rows": "`jacobian` has rows",
    "algorithms.task_jacobian": "directions @ `jacobian`",
    "algorithms.motor_torque": "`rnea` of all effects at once: it saves a pass of firmware",
    "algorithms.regressor_row_of_bodies": "`regressor_row` with zeros for the bodies left out: it saves cycles of firmware",
    "clusters.aba": "`forward_dynamics` of the wheel has its accelerations; its passes are compiled for clusters of a type",
    "clusters.rnea_with_status": "`rnea`, with G and the singular of `motion`",
    "clusters.conditioning": "the largest entry of the G of `motion`",
    "algorithms.rnea_along": "`rnea_derivatives` times the changes: it saves the matrices in firmware",
    "algorithms.rnea_transposed": "the transposed `rnea_derivatives` times the factors: it saves the matrices in firmware",
    "clusters.regular": "a choice by the singular of `motion`",
    "clusters.singular": "`motion` returns it",
    "clusters.state": "`motion` returns it",
    "clusters.configuration": "`motion` returns it",
    "clusters.torque": "Gᵀ τ of the G of `motion`",
    "clusters.inertia": "Gᵀ M G of the G of `motion`",
    "clusters.jacobian": "J G of the G of `motion`",
    "clusters.motors": "G[motors] of the G of `motion`",
    "clusters.rnea_of_motors": "numpy.linalg.solve(G[motors].T, `rnea`), of the G of `motion`",
    "clusters.to_motors": "numpy.linalg.solve(G[motors].T, τ), of the G of `motion`",
    "clusters.from_motors": "G[motors].T @ τ, of the G of `motion`",
    "clusters.stiffness": "differences of `rnea` at rest",
    "drivetrain.elastic_step": "a step of a simulated plant",
    "manifold.nearest_turn": "`normalise`; `difference` takes the short way",
    "flexible.step": "a step of a simulated plant, of models of joints of one coordinate",
}


def algorithms():
    """The public functions of the library's modules of algorithms."""
    found = []
    for module in ("algorithms", "drivetrain", "loops", "flexible"):
        text = (CORE / module / "mod.rs").read_text()
        for names in re.findall(r"^pub use [\w:]*?(?:\{([^}]*)\}|(\w+));", text, re.M):
            all_names = [name.strip() for name in ",".join(names).split(",")]
            found += [f"{module}.{name}" for name in all_names if re.match(r"[a-z]", name) and name != "frame"]
    for module, files in (("clusters", "clusters/*.rs"), ("flexible", "flexible/f[er]e[dq]*.rs"), ("manifold", "state/manifold.rs")):
        for path in sorted(CORE.glob(files)):
            # Functions of a cluster's motion, and what says whether numbers are finite, are no
            # algorithms.
            named = re.findall(r"^ {0,4}pub fn (\w+)", path.read_text(), re.M) if path.name != "cluster.rs" else []
            found += [f"{module}.{name}" for name in named]
    return list(dict.fromkeys(found))


def missing(names, without):
    """Those that the wheel has not and no reason is given for, and reasons without an algorithm
    that the wheel lacks."""
    def has(name):
        module, function = name.split(".")
        return hasattr(getattr(rd, CLASSES[module]), function)

    lacking = [name for name in names if not has(name) and name not in without]
    return lacking, [name for name in without if name not in names or has(name)]


def test_every_algorithm_of_the_library_is_there_or_has_a_reason():
    names = algorithms()
    assert len(names) > 70 and {"algorithms.rnea", "loops.assemble", "flexible.tick", "clusters.rnea"} <= set(names)
    assert missing(names, WITHOUT) == ([], [])


def test_a_new_algorithm_or_a_stale_reason_is_missed():
    names = algorithms()
    assert missing([*names, "algorithms.gibbs_appell"], WITHOUT) == (["algorithms.gibbs_appell"], [])
    assert missing(names, {**WITHOUT, "algorithms.rnea": "why", "loops.gone": "why"}) == ([], ["algorithms.rnea", "loops.gone"])
    reasons = {name: reason for name, reason in WITHOUT.items() if name != "clusters.aba"}
    assert missing(names, reasons) == (["clusters.aba"], [])


def test_editors_see_the_docstrings_of_the_compiled_module():
    source = stubs.STUB.read_text()
    assert stubs.documented(source, _native) == source, "stubs.py --write"
    changed = source.replace("The names of the library's robots.", "")
    assert changed != source and stubs.documented(changed, _native) == source


def test_signatures_have_their_defaults():
    things = [getattr(rd, name) for name in PUBLIC]
    things += [getattr(thing, name) for thing in things if inspect.isclass(thing) for name in vars(thing) if not name.startswith("_")]
    for thing in things:
        signature = getattr(thing, "__text_signature__", None) or ""
        assert "..." not in signature, (thing, signature)
    assert rd.__version__ == importlib.metadata.version("robot_dynamics")


def test_everything_native_is_exported():
    hidden = {name for name in dir(_native) if not name.startswith("_")} - set(PUBLIC)
    assert hidden == set()


def test_the_notebook_has_no_error_stored_and_the_costs_of_today():
    notebook = json.loads((HERE / "five_minutes.ipynb").read_text())
    stored = "".join(text for cell in notebook["cells"] for out in cell.get("outputs", []) for text in out.get("text", []))
    (cost,) = [one for one in rd.Robot("ur5e").costs() if (one.algorithm, one.form, one.inputs, one.trigonometry) == ("rnea", "engine", "full", True)]
    assert f"{cost.cycles} cycles" in stored, "run_notebook.py five_minutes.ipynb --write"
    done = subprocess.run([sys.executable, HERE / "run_notebook.py"], capture_output=True, text=True)
    assert done.returncode == 1 and done.stderr.startswith("usage: ")
    code = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    assert len(code) >= 8
    for cell in code:
        assert cell["execution_count"] and all(out["output_type"] != "error" for out in cell["outputs"])


def test_the_guide_runs():
    page = (HERE / "docs/guide.md").read_text()
    names = {}
    for block in re.findall(r"```python\n(.*?)```", page, re.S):
        exec(block, names)
    assert names["tau"].shape == (6,)
