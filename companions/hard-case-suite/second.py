"""Compares the answers of the suite with a second computation in many digits, that of
host-tests/oracle/hard.py.

    python companions/hard-case-suite/second.py

It shares no line with dynamics.py: bodies are followed in base coordinates, all moments about the
base's origin. Prints the largest difference of each case, relative to the scale of its bound; more
than 10⁻⁴⁵ is an error.
"""

import json
import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parents[1] / "host-tests/oracle"))

import hard  # noqa: E402
from mpmath import mp, mpf  # noqa: E402

mp.dps = 90


def turned_to_z(axis):
    """A rotation, by rows, that takes z to the axis: joints turn about z there."""
    mean = [axis[0], axis[1], axis[2] + 1]  # half a turn about the mean of z and the axis
    square = hard.dot(mean, mean)
    return [[2 * mean[i] * mean[j] / square - (i == j) for j in range(3)] for i in range(3)]


class Body(hard.Body):
    """A link of the suite in a frame whose z is the joint's axis; `before` is that rotation of its
    parent."""

    def __init__(self, link, before):
        exact = [mpf(x) for x in link["axis"]]
        self.own = turned_to_z(hard.times(1 / mp.sqrt(hard.dot(exact, exact)), exact))
        into, back = [list(row) for row in zip(*before)], [list(row) for row in zip(*self.own)]
        given = hard.rotation([mpf(x) for column in zip(*link["rotation"]) for x in column])
        self.parent, self.slides = link["parent"], link["joint"] == "prismatic"
        self.attitude = hard.product(into, hard.product(given, self.own))
        self.place = hard.apply(into, [mpf(x) for x in link["translation"]])
        self.mass, self.moment, self.inertia = mpf(0), [mpf(0)] * 3, [[mpf(0)] * 3 for _ in range(3)]
        self.carry(mpf(link["mass"]), [mpf(x) for x in link["com"]], [mpf(x) for x in link["inertia"]])
        self.moment = hard.apply(back, self.moment)
        self.inertia = hard.product(hard.product(back, self.inertia), self.own)


class Arm(hard.Arm):
    def __init__(self, robot):
        self.bodies, still = [], [[mpf(i == j) for j in range(3)] for i in range(3)]
        for link in robot["links"]:
            self.bodies.append(Body(link, self.bodies[link["parent"]].own if link["parent"] >= 0 else still))
        self.gravity = [mpf(x) for x in robot["gravity"]]
        self.rotors = [mpf(link["armature"]) for link in robot["links"]]


def difference(case):
    arm, worst = Arm(case["robot"]), mpf(0)
    for state, answers, scales in zip(case["states"], case["answers"], case["bound"]["scales"]):
        q, qd, qdd, given = ([mpf(x) for x in state[name]] for name in ("q", "qd", "qdd", "tau"))
        arm.pose(q)
        pairs = list(zip(arm.torques(qd, qdd), answers["tau"], scales["tau"]))
        m = arm.matrix()
        if "M" in answers:
            pairs += [pair for rows in zip(m, answers["M"], scales["M"]) for pair in zip(*rows)]
        l = hard.cholesky(m)
        assert (l is None) == (answers["qdd"] is None), "only one of both says that M is singular"
        if l:
            bias = arm.torques(qd, [mpf(0)] * len(q))
            qdd = hard.solve(l, [t - b for t, b in zip(given, bias)])
            pairs += zip(qdd, answers["qdd"], scales["qdd"])
        worst = max([worst] + [abs(x - mpf(y)) / s if s else abs(x) for x, y, s in pairs])
    return worst


def main():
    far = []
    for path in sorted((HERE / "cases").glob("*.json")):
        worst = difference(json.loads(path.read_text()))
        print(f"{path.name}: {mp.nstr(worst, 2)}", flush=True)
        far += [path.name] if worst > mpf(10) ** -45 else []
    sys.exit(f"not the same: {', '.join(far)}" if far else 0)


if __name__ == "__main__":
    main()
