"""Fifty-digit answers to the hard cases with kinematic loops, from the very numbers that the library computes with.

    cargo run -p loop-tests --bin hard_loop_inputs | .venv/bin/python host-tests/oracle/loops_precise.py [CASE ...]

writes host-tests/recordings/hard/loops/CASE.json. The coordinates that a problem names `held` are given, with their
rates and accelerations; the others follow from the points that coincide where a loop is closed, by Newton's method.
Torques of the tree are moments of Newton's and Euler's forces in base coordinates. G spans the motions of closed loops;
the motors' torques are the least ones that do the work of the tree's on them. Accelerations solve
M q'' - K^T l = S t - C, K q'' = k over independent rows of K, and are held against
(G^T M G) y'' = G^T (S t - C - M g). A problem with `gamma` has instead of loops each coordinate as a sum of polynomials
of the independent ones.
"""


import numpy as np
from closed_machine import ZERO, Gamma, Machine, apply, dot, eliminated, explicit, solved, transposed
from mpmath import mp, mpf
from recorded import of_cases

mp.dps = 50
# Squares of G of the motors: a posture that f64 numbers describe is singular but for 1e-16.
SINGULAR = mpf(10) ** -20


def single(values):
    return [float(np.float32(float(x))) for x in values]


def floats(values):
    return None if values is None else [float(x) + 0.0 for x in values]


def reduced(m, c, g, bias, tau):
    """Accelerations of the motions G."""
    inertia = [[dot(a, apply(m, b)) for b in transposed(g)] for a in transposed(g)]
    rest = [t - x for t, x in zip(tau, [x + y for x, y in zip(c, apply(m, bias))])]
    ydd = solved(inertia, [dot(column, rest) for column in transposed(g)])
    return ydd, [x + b for x, b in zip(apply(g, ydd), bias)]


def of_gamma(problem, state):
    machine, n = Gamma(problem), len(problem["gamma"][0])
    y, yd, ydd = ([mpf(x) for x in state[key][:n]] for key in ("q", "qd", "qdd"))
    q, g, bias = machine.maps(y, yd)
    machine.pose(q)
    qd, still = apply(g, yd), [mpf(0)] * len(q)
    qdd = [x + b for x, b in zip(apply(g, ydd), bias)]
    tau = apply(transposed(g), machine.torques(qd, qdd))
    given = single(tau)
    m, c = machine.mass_matrix(), machine.torques(qd, still)
    # The motors' torques act on y: Gᵀ of the tree's part is subtracted from them.
    inertia = [[dot(a, apply(m, b)) for b in transposed(g)] for a in transposed(g)]
    rest = [x + z for x, z in zip(c, apply(m, bias))]
    forward = solved(inertia, [mpf(t) - dot(column, rest) for t, column in zip(given, transposed(g))])
    answer = {"q": q, "qd": qd, "qdd": ydd, "tau": tau, "given": given, "forward": forward}
    return {key: floats(values) for key, values in answer.items()}


def of_loops(problem, state):
    machine, held, motors = Machine(problem), problem["held"], problem["actuated"]
    q, qd, qdd = ([mpf(x) for x in state[key]] for key in ("q", "qd", "qdd"))
    q = machine.close(q, held)
    machine.pose(q)
    rows = machine.rows()
    n, still = machine.nv, [mpf(0)] * machine.nv
    map_ = explicit(rows, [mpf(0)] * len(rows), held)
    tau = None
    if map_ is None:  # a singular configuration: the rates are given, and are those of closed loops
        assert max(abs(x) for x in apply(rows, qd)) < ZERO, "the rates open a loop"
    else:
        qd = apply(map_[0], [qd[j] for j in held])
        g, bias = explicit(rows, machine.bias(qd), held)
        qdd = [x + b for x, b in zip(apply(g, [qdd[j] for j in held]), bias)]
        tree = machine.torques(qd, qdd)
        of_motors = [g[j] for j in motors]
        squares = [[dot(a, b) for b in transposed(of_motors)] for a in transposed(of_motors)]
        weights = solved(squares, [dot(column, tree) for column in transposed(g)], SINGULAR)
        tau = None if weights is None else apply(of_motors, weights)
    given = single(tau) if tau is not None else [float(k + 1) for k in range(len(motors))]
    spread = [mpf(0)] * n
    for j, t in zip(motors, given):
        spread[j] = mpf(t)
    m, c, right = machine.mass_matrix(), machine.torques(qd, still), machine.bias(qd)
    done, _, _ = eliminated(rows, range(n), [[x] for x in right])
    independent, pivots = [i for i, _ in done], {j for _, j in done}
    k = [rows[i] for i in independent]
    system = [m[i] + [-row[i] for row in k] for i in range(n)] + [row + [mpf(0)] * len(k) for row in k]
    forward = solved(system, [t - x for t, x in zip(spread, c)] + [right[i] for i in independent])[:n]
    g, bias = explicit(rows, right, [j for j in range(n) if j not in pivots])
    _, other = reduced(m, c, g, bias, spread)
    scale = max(abs(x) for x in forward)
    assert max(abs(x - y) for x, y in zip(forward, other)) <= mpf(10) ** -20 * scale, "two ways to accelerations"
    answer = {"q": q, "qd": qd, "qdd": qdd, "tau": tau, "given": given, "forward": forward}
    return {key: floats(values) for key, values in answer.items()}


def record(problem):
    of = of_gamma if problem.get("gamma") else of_loops
    states = [of(problem, state) for state in problem["states"]]
    return {"name": problem["name"], "inputs": problem["inputs"], "states": states}


if __name__ == "__main__":
    of_cases("hard/loops", record)
