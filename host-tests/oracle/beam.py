#!/usr/bin/env python3
"""Flexible links by assumed modes in 50 digits, from material points and from finite elements.

    venv/bin/pip install -r host-tests/oracle/requirements.txt
    venv/bin/python host-tests/oracle/beam.py

writes host-tests/recordings/beam.json, and prints how much the modes that are left out change the tip's displacement.
With --check it writes nothing and fails if the file would change. Parts: `dynamics` from D'Alembert's principle
(beam_points.py), `frequencies` and `static` from finite elements (beam_fe.py), `forced` from both (beam_forced.py).
The recording is stopped by each `assert` of these files.

Source of the problem: W. J. Book, "Recursive Lagrangian dynamics of flexible manipulator arms", International Journal
of Robotics Research 3(3), 1984. A link's frame is at its joint, the beam lies along x, displacements are linear in the
amplitudes, sections of a bent beam have no rotary inertia.
"""

import argparse
import json
import pathlib
import random
import sys

import mpmath
from beam_points import Chain
from beam_shapes import Link
from mpmath import mp, mpf
from precise import torques

SEED, STATES, GRAVITY = 1984, 30, [0.0, 0.0, -9.81]
PATH = pathlib.Path(__file__).resolve().parent.parent / "recordings" / "beam.json"
UPPER = Link(0.5, 0.8, 4.0, 3.0, 2e-5, 2e-5, 0.3, 1e-4)
FORE = Link(0.4, 0.4, 1.0, 0.8, 1e-5, 1e-5, 0.1, 2e-5)
PLAIN = Link(1.0, 1.0, 1.0)
HEAVY = Link(1.0, 1.0, 1.0, tip_mass=10.0)
BEND_Z = [("bend_z", 1), ("bend_z", 2)]
ROBOTS = {
    "planar": [(1, UPPER, BEND_Z), (1, FORE, BEND_Z)],
    "spatial": [
        (2, UPPER, [("bend_y", 1), ("bend_z", 1), ("twist", 1)]),
        (1, FORE, [*BEND_Z, ("bend_y", 1)]),
    ],
}
BENT = (0.05, 1.0, 50.0)
RANGES = {"joint": (2.0, 3.0, 20.0), "bend_y": BENT, "bend_z": BENT, "twist": (0.1, 2.0, 100.0)}


def floats(values):
    return [float(x) + 0.0 for x in values]


def rigid(chain, x, rate, acceleration):
    """Joint torques of the chain without deflection, by Newton's and Euler's equations."""
    bodies, at = [], 0.0
    for i, (axis, link, _) in enumerate(chain.links):
        e = link.exact()
        beam, total = e.rho_a * e.length, e.rho_a * e.length + e.tip_mass
        com = (beam * e.length / 2 + e.tip_mass * e.length) / total
        bent = beam * (e.length**2 / 12 + (e.length / 2 - com) ** 2) + e.tip_mass * (e.length - com) ** 2
        xx, yy, zz = e.rho_iy + e.rho_iz, e.rho_iy, e.rho_iz
        diagonal = [s * e.length + e.tip_inertia + b for s, b in ((xx, 0), (yy, bent), (zz, bent))]
        turn = {"rotation": [1, 0, 0, 0, 1, 0, 0, 0, 1], "position": [at, 0, 0]}
        body = {"parent": i - 1, "joint": "revolute", "axis": [int(axis == k) for k in range(3)], "placement": turn}
        inertia = [diagonal[0], 0, 0, diagonal[1], 0, diagonal[2]]
        bodies.append({**body, "mass": total, "com": [com, 0, 0], "inertia_com": inertia})
        at = link.length
    return torques({"bodies": bodies}, x, rate, acceleration)


def dynamics(links, rng):
    chain, n = Chain(links), len(links)
    modes = [(i, kind, index) for i, (_, _, own) in enumerate(links) for kind, index in own]
    scales = [RANGES["joint"]] * n + [RANGES[kind] for _, kind, _ in modes]
    rows = {key: [] for key in ("q", "qd", "qdd", "eta", "etad", "etadd", "tau", "modal")}
    kinetic, potential = [], []
    for k in range(STATES):
        x, rate, acceleration = ([mpf(rng.uniform(-s[d], s[d])) for s in scales] for d in range(3))
        forces, *energies = chain.forces(x, rate, acceleration)
        if k == 0:
            finer = Chain(links, 40).forces(x, rate, acceleration)[0]
            assert max(abs(a - b) for a, b in zip(forces, finer)) < mpf(10) ** -30, "quadrature along the beam"
            still = [[*v[:n], *[mpf(0)] * len(modes)] for v in (x, rate, acceleration)]
            newton = rigid(chain, x[:n], rate[:n], acceleration[:n])
            error = max(abs(a - b) for a, b in zip(newton, chain.forces(*still)[0]))
            assert error < mpf(10) ** -25, "links without deflection against Newton and Euler"
        for name, values in (("q", x), ("qd", rate), ("qdd", acceleration)):
            rows[name].append(floats(values[:n]))
            rows[name.replace("q", "eta")].append(floats(values[n:]))
        rows["tau"].append(floats(forces[:n]))
        rows["modal"].append(floats(forces[n:]))
        kinetic.append(energies[0])
        potential.append(energies[1])
    names = {UPPER: "upper", FORE: "fore"}
    about = {
        "axes": ["xyz"[axis] for axis, _, _ in links],
        "links": [names[link] for _, link, _ in links],
        "modes": [{"link": i, "kind": kind, "index": index} for i, kind, index in modes],
    }
    return {**about, **rows, "kinetic": floats(kinetic), "potential": floats(potential)}


def record():
    rng = random.Random(SEED)
    links = {"upper": UPPER, "fore": FORE, "plain": PLAIN, "heavy": HEAVY}
    answer = {
        "recorded_by": "host-tests/oracle/beam.py",
        "source": "Book, Int. J. Robotics Research 3(3), 1984; every number is computed by the script",
        "licence": "MIT OR Apache-2.0",
        "mpmath": mpmath.__version__,
        "digits": mp.dps,
        "seed": SEED,
        "gravity": GRAVITY,
        "links": {name: vars(link) for name, link in links.items()},
        "dynamics": {name: dynamics(robot, rng) for name, robot in ROBOTS.items()},
    }
    return answer


def text(value, depth=0):
    """JSON with one row of numbers per line."""
    inner = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    if depth == 4 or not any(isinstance(x, (dict, list)) for x in inner):
        return json.dumps(value, separators=(",", ":"))
    if isinstance(value, list):
        return "[\n" + ",\n".join(text(x, depth + 1) for x in value) + "\n]"
    return "{\n" + ",\n".join(f"{json.dumps(k)}:{text(x, depth + 1)}" for k, x in value.items()) + "\n}"


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    arguments.add_argument("--check", action="store_true", help="write nothing, fail if the file would change")
    options = arguments.parse_args()
    new = text(record()) + "\n"
    if not options.check:
        PATH.write_text(new, encoding="utf-8")
    elif not PATH.exists() or PATH.read_text(encoding="utf-8") != new:
        sys.exit("would change: " + str(PATH))


if __name__ == "__main__":
    main()
