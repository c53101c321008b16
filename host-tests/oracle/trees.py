#!/usr/bin/env python3
"""Records Pinocchio's derivatives of inverse dynamics of random trees with every kind of joint.

    cargo run -p host-tests --bin export_trees | .venv/bin/python host-tests/oracle/trees.py

writes host-tests/recordings/trees.json.gz: for each tree its q and two matrices by rows, in our coordinates. Pinocchio
wants each body's descendants right after it.
"""

import json
import sys

import numpy as np
import pinocchio as pin
from joints import SIZES
from quantities import in_series
from record import pinocchio_model, shortened
from recorded import RECORDINGS, write


def depth_first(bodies):
    """The numbers of the bodies, each one's descendants right after it."""
    of = lambda parent: [i for i, body in enumerate(bodies) if body["parent"] == parent]
    after = lambda i: [i] + [k for child in of(i) for k in after(child)]
    return [k for root in of(-1) for k in after(root)]


def places(bodies, listed, which):
    """Where the coordinates of the bodies in this order are in ours: of q (0) or of v (1)."""
    sizes = [SIZES[body["joint"]][which] for body in bodies]
    first = np.concatenate([[0], np.cumsum(sizes)])
    return np.concatenate([np.arange(first[i], first[i + 1]) for i in listed])


def record(problem):
    robot, (q, qd, qdd) = problem["robot"], (np.array(problem[key]) for key in ("q", "qd", "qdd"))
    bodies = robot["bodies"]
    listed = depth_first(bodies)
    number = {-1: -1, **{i: k for k, i in enumerate(listed)}}
    moved = [{**bodies[i], "parent": number[bodies[i]["parent"]]} for i in listed]
    # Pinocchio 4.1 is wrong about the first axis of a universal joint: as in quantities.py.
    model, _, order = pinocchio_model({**robot, "bodies": in_series(moved)})
    q_at, v_at = (places(bodies, listed, which) for which in (0, 1))
    data, theirs = model.createData(), (order.q(q[q_at]), order.v(qd[v_at]), order.v(qdd[v_at]))
    found = []
    for by in pin.computeRNEADerivatives(model, data, *theirs)[:2]:
        ours = np.empty_like(by)
        ours[np.ix_(v_at, v_at)] = by[np.ix_(order.at, order.at)]
        found.append(shortened(ours.tolist()))
    return {"q": q.tolist(), "by": [np.ravel(by).tolist() for by in found]}


if __name__ == "__main__":
    text = json.dumps([record(problem) for problem in json.load(sys.stdin)], separators=(",", ":"))
    write(RECORDINGS / "trees.json.gz", text + "\n")
