#!/usr/bin/env python3
"""Forward dynamics in 50 digits at the states where errors come nearest to their proven bounds.

    venv/bin/python companions/certification/forward.py

reads the robots' bodies and the states from forward.json, which `certify --write forward` writes,
and adds the accelerations, rounded from 50 digits to f64. With --check it writes nothing and fails
if the file would change.

Torques are those of precise.py, in base coordinates. M has the torques of unit accelerations as
columns; M q̈ = τ − b is solved by mpmath's LU decomposition with pivoting: neither LᵀDL nor the
inverse of the search.
"""

import json
import pathlib
import sys

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE.parents[1] / "host-tests/oracle"))

from mpmath import lu_solve, matrix, mpf
from precise import torques
from recorded import of_one

PATH = HERE / "forward.json"


def body(numbers):
    """As precise.py has bodies: with the centre of mass, and second moments about it."""
    mass, first = mpf(numbers["inertia"][0]), [mpf(x) for x in numbers["inertia"][1:4]]
    com = [x / mass if mass else mpf(0) for x in first]
    square = sum(x * x for x in com)
    pairs = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))
    shifts = (mass * ((square if i == j else 0) - com[i] * com[j]) for i, j in pairs)
    return {
        "parent": -1 if numbers["parent"] is None else numbers["parent"],
        "joint": "fixed" if numbers["moves"] == "Fixed" else "revolute",
        "axis": (0, 0, 1),
        "placement": {"position": numbers["pos"], "rotation": [numbers["rot"][j][i] for i in range(3) for j in range(3)]},
        "mass": mass,
        "com": com,
        "inertia_com": [mpf(x) - shift for x, shift in zip(numbers["inertia"][4:], shifts)],
    }


def accelerations(robot, state):
    """q̈ of the joints, rad/s²."""
    n = len(state["q"])
    none = [0] * n
    bias, still = torques(robot, state["q"], state["qd"], none), torques(robot, state["q"], none, none)
    units = [[int(i == j) for i in range(n)] for j in range(n)]
    columns = [torques(robot, state["q"], none, unit) for unit in units]
    inertia = matrix([[columns[j][i] - still[i] for j in range(n)] for i in range(n)])
    return lu_solve(inertia, matrix([mpf(tau) - b for tau, b in zip(state["tau"], bias)]))


def text():
    certificates = json.loads(PATH.read_text(encoding="utf-8"))
    for one in certificates:
        assert all(body["moves"] == "Fixed" or "Turns" in body["moves"] for body in one["bodies"])
        robot = {"bodies": [body(numbers) for numbers in one["bodies"]]}
        one["exact"] = [[float(x) for x in accelerations(robot, state)] for state in one["worst"]]
        print(one["robot"], one["function"], file=sys.stderr)
    return "[\n" + ",\n".join(json.dumps(one, separators=(",", ":")) for one in certificates) + "\n]\n"


if __name__ == "__main__":
    of_one(__doc__, PATH, text)
