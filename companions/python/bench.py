"""Measures the installed wheel, and writes the figures of docs/speed.md between its markers.

    python bench.py          # measures and prints
    python bench.py --write  # rewrites the page
    python bench.py --check  # says whether the page is older than the code that it measured

All functions take turns in one process, on the same cores; a figure is the median of five turns, a
ratio the median of the ratios of the turns. Pinocchio is the wheel `pin`, whose loop over states,
`rneaInParallel`, is C++.
"""

from __future__ import annotations

import argparse
import hashlib
import pathlib
import platform
import statistics
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PAGE = HERE / "docs" / "speed.md"
BEGIN, END = "<!-- python:begin -->", "<!-- python:end -->"
STATES, TURNS, CALLS = 100_000, 5, 20_000
# Time of a call beyond the library's own, µs; and the throughput of batches against Pinocchio's.
BARS = {"overhead_us": 2.0, "ratio": 5.0}


def sources() -> str:
    """A digest of the code that is measured."""
    digest = hashlib.sha256()
    folders = [HERE / "src", HERE / "kernels" / "src", ROOT / "dynamics-core" / "src"]
    files = sorted(path for folder in folders for path in folder.rglob("*.rs"))
    for path in [*files, HERE / "Cargo.toml", HERE / "Cargo.lock"]:
        digest.update(path.relative_to(ROOT).as_posix().encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()[:16]


def seconds(call, repeat: int = 1) -> float:
    start = time.perf_counter()
    for _ in range(repeat):
        call()
    return (time.perf_counter() - start) / repeat


def measure() -> dict:
    """The figures of this machine."""
    import numpy as np
    import pinocchio as pin

    import robot_dynamics as rd

    sys.path.insert(0, str(HERE / "tests"))
    from trees import Peer, states, urdf

    threads = rd.threads()
    rows = []
    shapes = {
        "ur5e": None,
        "arm of 6": dict(seed=1, joints=6, chain=True, kinds=("revolute",)),
        "tree of 12": dict(seed=3, joints=12, kinds=("revolute",)),
    }
    single_state = {}
    for name, shape in shapes.items():
        text = urdf(**(shape or shapes["arm of 6"]))
        robot = rd.Robot(name) if shape is None else rd.Robot.from_text(text, exact=False)
        # Pinocchio's time depends on the tree and the kinds of joints alone: those of a UR5e are
        # the arm's of six.
        peer = Peer(text)
        q, v, a, tau = states(robot, STATES)
        single = [x.astype(np.float32) for x in (q, v, a, tau)]
        columns = [np.asfortranarray(x.T) for x in (q, v, a, tau)]
        pool = pin.ModelPool(peer.model, threads)
        calls = {
            ("rnea", "f32"): lambda: robot.rnea(*single[:3]),
            ("rnea", "f64"): lambda: robot.rnea(q, v, a),
            ("rnea", "pinocchio"): lambda: pin.rneaInParallel(threads, pool, *columns[:3]),
            ("aba", "f32"): lambda: robot.aba(single[0], single[1], single[3]),
            ("aba", "f64"): lambda: robot.aba(q, v, tau),
            ("aba", "pinocchio"): lambda: pin.abaInParallel(threads, pool, columns[0], columns[1], columns[3]),
        }
        for call in calls.values():
            call()
        times = {key: [] for key in calls}
        for _ in range(TURNS):
            for key, call in calls.items():
                times[key].append(seconds(call) / STATES * 1e9)
        for algorithm in ("rnea", "aba"):
            theirs = times[algorithm, "pinocchio"]
            rows.append(
                {
                    "robot": name,
                    "algorithm": algorithm,
                    **{kind: statistics.median(times[algorithm, kind]) for kind in ("f32", "f64", "pinocchio")},
                    **{
                        f"ratio_{kind}": statistics.median(t / o for t, o in zip(theirs, times[algorithm, kind]))
                        for kind in ("f32", "f64")
                    },
                }
            )
    robot = rd.Robot("ur5e")
    for dtype, own in ((np.float32, "f32"), (np.float64, "f64")):
        q, v, a, _ = (x.astype(dtype) for x in states(robot, 32))
        one = [x[0].copy() for x in (q, v, a)]
        calls, library = [], []
        robot.rnea(*one)
        for _ in range(TURNS):
            calls.append(seconds(lambda: robot.rnea(*one), CALLS) * 1e6)
            # Seven states in one call are computed one after the other: more of them is the
            # library's own time.
            few, more = [seconds(lambda n=n: robot.rnea(q[:n], v[:n], a[:n]), CALLS // 4) for n in (1, 7)]
            library.append((more - few) / 6 * 1e6)
        single_state[own] = {
            "call_us": statistics.median(calls),
            "library_us": statistics.median(library),
            "overhead_us": statistics.median(c - own for c, own in zip(calls, library)),
        }
    return {
        "states": STATES,
        "threads": threads,
        "machine": platform.machine(),
        "python": platform.python_version(),
        "numpy": np.__version__,
        "pinocchio": pin.__version__,
        "sources": sources(),
        "batches": rows,
        "call": single_state,
    }


def text(found: dict) -> str:
    """The part of the page."""
    lines = [
        BEGIN,
        "<!-- written by `bench.py --write`: do not edit -->",
        f"A call for one state of a UR5e (`rnea`), µs, Python {found['python']}, numpy {found['numpy']}:",
        "",
        "| dtype | a call | the library's own time | beyond it | bar |",
        "| ----- | -----: | ---------------------: | --------: | --: |",
    ]
    for kind, row in found["call"].items():
        lines.append(
            f"| {kind}   | {row['call_us']:6.2f} | {row['library_us']:22.2f} | {row['overhead_us']:9.2f} |"
            f" {BARS['overhead_us']:.0f} |"
        )
    lines += [
        "",
        f"Batches of {found['states']:,} states, ns a state, {found['threads']} threads each, {found['machine']};"
        f" Pinocchio {found['pinocchio']} in f64, which is all that its wheel has, by `rneaInParallel` and"
        " `abaInParallel`:",
        "",
        "| robot, algorithm    |    f32 |    f64 | Pinocchio | Pinocchio / f32 | Pinocchio / f64 |",
        "| ------------------- | -----: | -----: | --------: | --------------: | --------------: |",
    ]
    for row in found["batches"]:
        name = f"{row['robot']}, {row['algorithm']}"
        lines.append(
            f"| {name:19} | {row['f32']:6.1f} | {row['f64']:6.1f} | {row['pinocchio']:9.1f} |"
            f" {row['ratio_f32']:15.1f} | {row['ratio_f64']:15.1f} |"
        )
    lines += ["", f"Bar: 5 for `rnea` of f32. Measured sources: `{found['sources']}`."]
    total = hashlib.sha256("\n".join(lines[1:]).encode()).hexdigest()[:16]
    return "\n".join([*lines, f"<!-- sum of the above: {total} -->", END])


def missed(found: dict) -> list[str]:
    """The bars that are not met."""
    problems = [
        f"a call in {kind} takes {row['overhead_us']:.2f} µs beyond the library's own, at most {BARS['overhead_us']}"
        for kind, row in found["call"].items()
        if row["overhead_us"] > BARS["overhead_us"]
    ]
    return problems + [
        f"{row['robot']}: rnea of f32 is {row['ratio_f32']:.1f} times as fast as Pinocchio, at least {BARS['ratio']}"
        for row in found["batches"]
        if row["algorithm"] == "rnea" and row["ratio_f32"] < BARS["ratio"]
    ]


def check() -> None:
    """Says whether the page is older than the code: times of one machine are no test of another, as
    on the laboratory's peers.md."""
    page = PAGE.read_text(encoding="utf-8")
    if BEGIN not in page or END not in page:
        sys.exit(f"{PAGE.name} has no markers")
    if f"Measured sources: `{sources()}`" not in page:
        print(f"note: {PAGE.name} is older than the code that it measured: bench.py --write")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for flag in ("write", "check"):
        parser.add_argument(f"--{flag}", action="store_true")
    arguments = parser.parse_args()
    if arguments.check:
        check()
        return
    found = measure()
    print(text(found))
    if arguments.write:
        page = PAGE.read_text(encoding="utf-8")
        before, after = page.split(BEGIN)[0], page.split(END)[1]
        PAGE.write_text(before + text(found) + after, encoding="utf-8")
    for problem in missed(found):
        print(f"missed: {problem}", file=sys.stderr)
    sys.exit(1 if missed(found) else 0)


if __name__ == "__main__":
    main()
