"""Writes the suite as data: cases/NUMBER-NAME.json, one robot each, with answers of 50 digits.

python companions/hard-case-suite/write.py            # writes all cases
python companions/hard-case-suite/write.py --check    # says whether the files are those of the scripts
"""

import json
import sys
from pathlib import Path

from cases import existing
from dynamics import DIGITS, Tree, cholesky, inverse, solve
from mpmath import mp, mpf
from proofs import found
from robots import single

OUT = Path(__file__).parent / "cases"
MATRICES = 8  # Up to this many joints M is written; that of 64 rods is 4096 numbers a state.
# The error of a sum of n rounded terms grows as √n (Higham and Mary, 2019). The factor is for what
# is rounded before the sum: placements, inertias about the origin of a frame, and sines, which in
# f32 have errors of two units.
FACTOR = 3
UNIT = {"f32": 2.0**-24, "f64": 2.0**-53}
SCALE = "the scale of the same state and joint, or entry of M"


def digits(row, sizes):
    """Fifty digits of each number; what is left where terms cancel to zero, of 90 digits, is
    zero."""
    return [
        mp.nstr(x, DIGITS, strip_zeros=False) if abs(x) > size * mpf(10) ** -75 else "0" for x, size in zip(row, sizes)
    ]


def rounded(x):
    """Three digits of a number, or of each in a list of lists."""
    return x and [rounded(y) for y in x] if isinstance(x, (list, type(None))) else float(mp.nstr(x, 3))


def answer(robot, state):
    """The answers and scales of one state."""
    q, qd, qdd = ([mpf(x) for x in row] for row in state)
    tree = Tree(robot, q)
    tau, sizes = tree.torques(qd, qdd)
    m, m_sizes = tree.mass_matrix()
    given = [single(float(x)) if abs(x) > 1e-300 or not x else float(x) for x in tau]
    answers = {"tau": digits(tau, sizes), "qdd": None}
    if len(q) <= MATRICES:
        answers["M"] = [digits(*rows) for rows in zip(m, m_sizes)]
    scale = {"tau": sizes, "qdd": None}
    if len(q) <= MATRICES:
        scale["M"] = m_sizes
    l, reach = cholesky(m), mpf(0)
    if l:
        bias, _ = tree.torques(qd, [mpf(0)] * len(q))
        accel = solve(l, [mpf(t) - b for t, b in zip(given, bias)])
        rows = inverse(l)
        # The effect that an error of one unit in every contribution to a torque may have on the
        # accelerations.
        scale["qdd"] = [sum(abs(x) * s for x, s in zip(row, sizes)) for row in rows]
        answers["qdd"] = digits(accel, scale["qdd"])
        reach = max(sum(abs(x) for x in row) for row in rows)
    return given, answers, scale, reach


def written(case):
    robot = {"gravity": case.gravity, "links": case.links}
    states, answers, scales, reach = [], [], [], mpf(0)
    for q, qd, qdd in case.states:
        given, told, scale, one = answer(robot, (q, qd, qdd))
        reach = max(reach, one)
        states.append({"q": q, "qd": qd, "qdd": qdd, "tau": given})
        answers.append(told)
        scales.append(scale)
    shown = [{name: rounded(x) for name, x in scale.items()} for scale in scales]
    bound = {name: float(f"{FACTOR * len(case.links) ** 0.5 * unit:.2g}") for name, unit in UNIT.items()}
    if not case.in_f32:
        bound["f32"] = None
    # The underflow of a torque, of M, and through M⁻¹ of an acceleration.
    underflow = {name: {"tau": x, "M": x, "qdd": float(mp.nstr(x * reach, 3))} for name, x in zip(UNIT, case.underflow)}
    parts = [
        ("case", case.number),
        ("name", case.name),
        ("title", case.title),
        ("reason", case.reason),
        ("robot", robot),
        ("states", states),
        ("answers", answers),
        ("bound", {**bound, "underflow": underflow, "refusal": case.refusal, "relative_to": SCALE, "scales": shown}),
    ]
    return "{\n" + ",\n".join(f'"{name}": {lines(value)}' for name, value in parts) + "\n}\n"


def lines(value):
    """JSON with a line for each item of the lists that matter: links, states, answers, scales."""
    text = lambda x: json.dumps(x, ensure_ascii=False)
    if isinstance(value, dict):
        return "{" + ", ".join(f"{text(k)}: {lines(v)}" for k, v in value.items()) + "}"
    if isinstance(value, list) and value and isinstance(value[0], dict):
        return "[\n" + ",\n".join(text(x) for x in value) + "\n]"
    return text(value)


def stale(wanted):
    """The names of the files that are not those of the scripts: of other text, missing, or of no
    case."""
    other = [path.name for path, text in wanted.items() if not path.exists() or path.read_text() != text]
    return other + [path.name for path in OUT.glob("*.json") if path not in wanted]


def main():
    wanted = {}
    for case in [*existing(), *found()]:
        path = OUT / f"{case.number:02}-{case.name}.json"
        assert path not in wanted, path
        wanted[path] = written(case)
        print(path.name, file=sys.stderr, flush=True)
    if "--check" in sys.argv:
        names = stale(wanted)
        sys.exit(f"not current: {', '.join(names)}" if names else 0)
    OUT.mkdir(exist_ok=True)
    for path in OUT.glob("*.json"):
        path.unlink()
    for path, text in wanted.items():
        path.write_text(text)


if __name__ == "__main__":
    main()
