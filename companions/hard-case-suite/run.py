"""Runs the suite in f64 through Pinocchio, and prints who passes what.

    python companions/hard-case-suite/run.py [--write]

needs `pip install pin`. The columns of this library are from its test, by cargo. --write replaces
the table of results.md. Another library needs a class as this one's.
"""

import json
import math
import os
import re
import subprocess
import sys
from decimal import Decimal
from pathlib import Path

import numpy as np
import pinocchio as pin

HERE = Path(__file__).parent
BEGIN, END = "<!-- suite:begin -->\n", "<!-- suite:end -->\n"
QUANTITIES = ("tau", "M", "qdd")


class Pinocchio:
    """Featherstone's algorithms in link coordinates: rnea, crba and aba."""

    def __init__(self, links, gravity):
        self.model = pin.Model()
        self.model.gravity.linear = np.array(gravity)
        ids = {-1: 0}
        for i, link in enumerate(links):
            place = pin.SE3(np.array(link["rotation"]), np.array(link["translation"]))
            ids[i] = self.model.addJoint(ids[link["parent"]], self.joint(link), place, f"joint{i}")
            xx, xy, xz, yy, yz, zz = link["inertia"]
            about = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
            load = pin.Inertia(link["mass"], np.array(link["com"]), about)
            self.model.appendBodyToJoint(ids[i], load, pin.SE3.Identity())
        self.model.armature = np.array([link["armature"] for link in links])
        self.data = self.model.createData()

    def joint(self, link):
        slides = link["joint"] == "prismatic"
        for letter, along in zip("XYZ", np.eye(3)):
            if np.array_equal(link["axis"], along):
                return getattr(pin, f"JointModel{'P' if slides else 'R'}{letter}")()
        name = "JointModelPrismaticUnaligned" if slides else "JointModelRevoluteUnaligned"
        return getattr(pin, name)(np.array(link["axis"]))

    def tau(self, q, qd, qdd):
        return pin.rnea(self.model, self.data, q, qd, qdd).copy()

    def matrix(self, q):
        upper = np.triu(pin.crba(self.model, self.data, q))
        return upper + np.triu(upper, 1).T

    def qdd(self, q, qd, tau):
        return pin.aba(self.model, self.data, q, qd, tau).copy()


def depth_first(links):
    """The links in depth-first order, and where each of them was."""
    order = []

    def visit(parent):
        for i, link in enumerate(links):
            if link["parent"] == parent:
                order.append(i)
                visit(i)

    visit(-1)
    return [
        dict(links[i], parent=order.index(links[i]["parent"]) if links[i]["parent"] >= 0 else -1) for i in order
    ], order


def share(found, truth, scale, bound, underflow):
    """The largest error over its bound; infinite if a number is none."""
    worst = 0.0
    for x, y, s in zip(np.ravel(found), np.ravel(truth), np.ravel(scale)):
        if not np.isfinite(x):
            return math.inf
        error, allowed = float(abs(Decimal(float(x)) - Decimal(str(y)))), bound * s + underflow
        worst = max(worst, error / allowed if allowed else (math.inf if error else 0.0))
    return worst


def run(case):
    """For each quantity the share of the bound, or a word."""
    links, order = depth_first(case["robot"]["links"])
    bound = case["bound"]["f64"]
    underflow = case["bound"]["underflow"]["f64"]
    robot = Pinocchio(links, case["robot"]["gravity"])
    results = {name: 0.0 for name in QUANTITIES}
    back = np.argsort(order)
    for state, answer, scale in zip(case["states"], case["answers"], case["bound"]["scales"]):
        q, qd, qdd, tau = (np.array(state[name])[order] for name in ("q", "qd", "qdd", "tau"))

        def compare(name, found):
            results[name] = max(results[name], share(found, answer[name], scale[name], bound, underflow[name]))

        compare("tau", robot.tau(q, qd, qdd)[back])
        if "M" in answer:
            compare("M", robot.matrix(q)[np.ix_(back, back)])
        else:
            results["M"] = ""
        accel = robot.qdd(q, qd, tau)[back]
        if answer["qdd"] is None:
            said = "refused" if not np.all(np.isfinite(accel)) else "undetected"
            results["qdd"] = said if results["qdd"] != "undetected" else "undetected"
        else:
            compare("qdd", accel)
    return results


def own(cases):
    """This library's shares in f64, from its test."""
    command = ["cargo", "test", "--", "every_case", "--nocapture"]
    printed = subprocess.run(
        command, cwd=HERE, env=os.environ | {"SUITE_SHOW": "1"}, capture_output=True, text=True, check=True
    ).stdout
    number = r"([\d.]+|inf)"
    pattern = rf"case (\d+), (\S+): .*f64 Shares {{ rnea: {number}, crba: {number}, forward: {number}, aba: {number} }}"
    found = {(int(m[1]), m[2]): [float(x) for x in m.groups()[2:]] for m in re.finditer(pattern, printed)}
    results = []
    for case in cases:
        rnea, crba, forward, aba = found[case["case"], case["name"]]
        singular = all(answer["qdd"] is None for answer in case["answers"])
        results.append(
            {
                "tau": rnea,
                "M": crba if "M" in case["answers"][0] else "",
                "qdd": "refused" if singular else max(forward, aba),
            }
        )
    return results


def passes(x):
    return x in ("", "refused") or not isinstance(x, str) and x <= 1


def shown(x):
    if isinstance(x, str):
        return x if passes(x) else f"**{x}**"
    text = "not finite" if math.isinf(x) else f"{x:.2f}" if x < 100 else f"{x:.1e}"
    return text if passes(x) else f"**{text}**"


def table(cases, columns):
    """A row a robot, three columns a library, and how many pass."""
    names = [f"{name}: τ | M | q̈" for name in columns]
    rows = [" | ".join(["case", *names]), " | ".join(["---"] + ["---:"] * 3 * len(columns))]
    for k, case in enumerate(cases):
        numbers = [shown(results[k][name]) for results in columns.values() for name in QUANTITIES]
        rows.append(" | ".join([f"{case['case']}. {case['title']}", *numbers]))
    counts = []
    for results in columns.values():
        for name in QUANTITIES:
            asked = [r[name] for r in results if r[name] != ""]
            counts.append(f"{sum(map(passes, asked))} of {len(asked)}")
    rows.append(" | ".join(["passed", *counts]))
    return "".join(f"| {row} |\n" for row in rows)


def main():
    cases = [json.loads(path.read_text()) for path in sorted((HERE / "cases").glob("*.json"))]
    columns = {"this library": own(cases), f"Pinocchio {pin.__version__}": [run(case) for case in cases]}
    text = table(cases, columns)
    print(text)
    if "--write" in sys.argv:
        page = (HERE / "results.md").read_text()
        before, after = page.split(BEGIN)[0], page.split(END)[1]
        (HERE / "results.md").write_text(f"{before}{BEGIN}{text}{END}{after}")


if __name__ == "__main__":
    main()
