#!/usr/bin/env python3
"""Flexible links by assumed modes in 50 digits, from material points and from finite elements.

    venv/bin/pip install -r host-tests/oracle/requirements.txt
    venv/bin/python host-tests/oracle/beam.py

writes host-tests/recordings/beam.json.gz, and prints how much the modes that are left out change the tip's displacement.
With --check it writes nothing and fails if the file would change. Parts: `dynamics` from D'Alembert's principle
(beam_points.py), `frequencies` and `static` from finite elements (beam_fe.py), `forced` from both (beam_forced.py).

What can fail, besides a change of the file: quadrature with more points; the power of the forces on points against that
of the generalised forces; joint torques against Newton's and Euler's equations (precise.py), of straight links and of
the joint behind a bent link; masses of the modes on points against finite elements; frequencies and slopes of 60
elements against 40 elements and against the closed form (1.8751, 4.6941, 7.8548 of the plain beam); static deflection
against the closed form; Taylor polynomials with half the step; the forced modes' equations and the hub's torque against
forces on points; the number of modes of the full model.

Source of the problem: W. J. Book, "Recursive Lagrangian dynamics of flexible manipulator arms", International Journal
of Robotics Research 3(3), 1984. A link's frame is at its joint, the beam lies along x, displacements are linear in the
amplitudes, sections of a bent beam have no rotary inertia.
"""

import json
import random

import mpmath
from beam_fe import NODE, Elements, dot
from beam_forced import TIMES, forced
from beam_points import Chain, rodrigues
from beam_shapes import Link, bending, modal, torsion
from mpmath import mp, mpf
from precise import torques
from recorded import RECORDINGS, of_one

SEED, STATES, GRAVITY = 1984, 30, [0.0, 0.0, -9.81]
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
    """Joint torques by Newton's and Euler's equations; deflections only move and turn the next joint."""
    bodies, n, turn = [], len(chain.links), {"rotation": list(mp.eye(3)), "position": [0, 0, 0]}
    for i, (axis, link, _) in enumerate(chain.links):
        e = link.exact()
        beam, total = e.rho_a * e.length, e.rho_a * e.length + e.tip_mass
        com = (beam * e.length / 2 + e.tip_mass * e.length) / total
        bent = beam * (e.length**2 / 12 + (e.length / 2 - com) ** 2) + e.tip_mass * (e.length - com) ** 2
        xx, yy, zz = e.rho_iy + e.rho_iz, e.rho_iy, e.rho_iz
        diagonal = [s * e.length + e.tip_inertia + b for s, b in ((xx, 0), (yy, bent), (zz, bent))]
        body = {"parent": i - 1, "joint": "revolute", "axis": [int(axis == k) for k in range(3)], "placement": turn}
        inertia = [diagonal[0], 0, 0, diagonal[1], 0, diagonal[2]]
        bodies.append({**body, "mass": total, "com": [com, 0, 0], "inertia_com": inertia})
        amplitudes = x[chain.first[i] : chain.first[i + 1]]
        end, angles = ([dot([v[k] for v in vs], amplitudes) for k in range(3)] for vs in zip(*chain.ends[i]))
        turn = {"rotation": [x for row in rodrigues(angles) for x in row], "position": [e.length + end[0], *end[1:]]}
    return torques({"bodies": bodies}, x[:n], rate[:n], acceleration[:n])


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
            error = max(abs(a - b) for a, b in zip(rigid(chain, *still), chain.forces(*still)[0]))
            assert error < mpf(10) ** -25, "links without deflection against Newton and Euler"
            still[0] = [a if j < chain.first[1] else b for j, (a, b) in enumerate(zip(x, still[0]))]
            error = abs(rigid(chain, *still)[1] - chain.forces(*still)[0][1])
            assert error < mpf(10) ** -25, "the second joint of a bent link against Newton and Euler"
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


def against_elements():
    """Holds the modes' masses, and what a turn of the hub does to them, against finite elements."""
    for kind, axis, sign in (("bend_y", 2, 1), ("bend_z", 1, -1), ("twist", 0, 1)):
        chain, order = Chain([(axis, UPPER, [(kind, 1)])]), 1 if kind == "twist" else 2
        rest, moved = (chain.forces([mpf(0)] * 2, [mpf(0)] * 2, [mpf(0), mpf(a)])[0] for a in (0, 1))
        basis = Elements(UPPER, 40, order)
        mode = basis.modes(1)[0][1]
        inertial = basis.times(basis.m, [a / mode[basis.tip] for a in mode])
        turn = basis.uniform() if kind == "twist" else basis.lever()
        expected = (sign * dot(inertial, turn), dot(inertial, mode) / mode[basis.tip])
        for a, b, c in zip(moved, rest, expected):
            assert abs(a - b - c) < mpf(10) ** -25 * abs(c), "points against elements: " + kind


def frequencies(link, kind):
    """Frequencies of 60 elements, against 40 elements and against the closed form."""
    order, exact = (2, bending(link, 4)) if kind == "bending" else (1, torsion(link, 4))
    coarse, fine = (Elements(link, count, order) for count in (40, 60))
    answer, worst = {"omega": [], "tip_slope": [], "modal_mass": []}, mpf(0)
    if link == PLAIN and order == 2:
        tabulated = [mp.sqrt(w) for w, _ in exact[:3]]
        assert max(abs(a - b) for a, b in zip(tabulated, (1.8751, 4.6941, 7.8548))) < 1e-4, "tabulated frequencies"
    for (rough, _), (omega, x), (closed, w) in zip(coarse.modes(4), fine.modes(4), exact):
        worst = max(worst, abs(rough / omega - 1))
        assert abs(omega / closed - 1) < mpf(10) ** -17, "frequencies against the closed form"
        answer["omega"].append(omega)
        answer["modal_mass"].append(1 / x[fine.tip] ** 2)
        if order == 2:
            slope = fine.slope(x, fine.count) / x[fine.tip]
            assert abs(slope / w(mpf(link.length), 1) - 1) < mpf(10) ** -17, "slopes against the closed form"
            answer["tip_slope"].append(slope)
    assert worst < mpf(10) ** -15, "elements are too few"
    answer = {key: floats(values) for key, values in answer.items() if values}
    return {**answer, "error_of_40_elements": float(mp.nstr(worst, 3))}


def static(link):
    """Deflection of the horizontal link under gravity at quarters of its length, and the tip's by the first modes."""
    basis, e, g = Elements(link, 40), link.exact(), mpf("9.81")
    load = [-g * x for x in basis.times(basis.m, basis.uniform())]
    x = basis.solve(basis.factors(mpf(0)), load)
    rows, tips, partial, errors = [], [], mpf(0), []
    for node in (10, 20, 30, 40):
        at, length = basis.h * node, e.length
        pair = (x[NODE * node], basis.slope(x, node))
        beam = e.rho_a * at * at * (6 * length**2 - 4 * length * at + at**2) / 24
        turned = e.rho_a * at * (3 * length**2 - 3 * length * at + at**2) / 6
        closed = (beam + e.tip_mass * at * at * (3 * length - at) / 6, turned + e.tip_mass * at * (length - at / 2))
        error = max(abs(a / (-g / e.ei * b) - 1) for a, b in zip(pair, closed))
        assert error < mpf(10) ** -30, "deflection against the closed form"
        rows.append(floats((at, *pair)))
    tip = x[basis.tip]
    for _, w in bending(link, 8):
        _, stiffness, force = modal(link, w)
        partial -= g * force / stiffness
        tips.append(partial)
        errors.append(abs(partial / tip - 1))
    return {"x_deflection_slope": rows, "tip_of_modes": floats(tips), "error_of_modes": rounded(errors)}


def rounded(values):
    return [float(mp.nstr(x, 3)) for x in values]


def turning():
    full, tips, hubs, errors, converged = forced(UPPER)
    rows = {"t": TIMES, "tip": full}
    answer = {"link": "upper", "angle": 1.0, "duration": 0.4, **{key: floats(values) for key, values in rows.items()}}
    answer |= {"tip_of_modes": [floats(x) for x in tips], "torque_of_modes": [floats(x) for x in hubs]}
    # The full model, with 15 in place of 20 modes whose inertia counts.
    return {**answer, "error_of_modes": rounded(errors), "error_of_tip": rounded(converged[-5:-4])[0]}


def table(recording):
    names = ("upper", "fore")
    columns = [recording["static"][name]["error_of_modes"] for name in names] + [recording["forced"]["error_of_modes"]]
    print("modes  static tip, upper  static tip, fore  forced tip, upper")
    for m in range(8):
        cells = [f"{c[m]:.1e}" if m < len(c) else "" for c in columns]
        print(f"{m + 1:5}  {cells[0]:>17}  {cells[1]:>16}  {cells[2]:>17}")


def record():
    against_elements()
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
        "frequencies": {
            "bending": {name: frequencies(link, "bending") for name, link in links.items()},
            "torsion": {name: frequencies(links[name], "torsion") for name in ("upper", "fore")},
        },
        "static": {name: static(links[name]) for name in ("upper", "fore")},
        "forced": turning(),
    }
    table(answer)
    return answer


def text(value, depth=0):
    """JSON with one row of numbers per line."""
    inner = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    if depth == 4 or not any(isinstance(x, (dict, list)) for x in inner):
        return json.dumps(value, separators=(",", ":"))
    if isinstance(value, list):
        return "[\n" + ",\n".join(text(x, depth + 1) for x in value) + "\n]"
    return "{\n" + ",\n".join(f"{json.dumps(k)}:{text(x, depth + 1)}" for k, x in value.items()) + "\n}"


if __name__ == "__main__":
    of_one(__doc__, RECORDINGS / "beam.json.gz", lambda: text(record()) + "\n")
