"""Builds the wheel, installs it into bare environments, and tests it: the step `python` of `cargo xtask test --full`.

    python3 python/test.py            # builds into target/python
    python3 python/test.py --wheel W  # tests a wheel that is there

It needs Rust, Python 3.10 or later with venv, and pip's index for numpy, maturin and what the tests compare with.
"""

from __future__ import annotations

import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import time
import venv

HERE = pathlib.Path(__file__).resolve().parent
TARGET = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", HERE.parent / "target")).resolve() / "python"
TOOLS = ["maturin>=1.9,<2", "mpmath>=1.3,<2", "numpy", "pin>=3,<5", "pytest", "mypy"]
# From an empty environment to the end of the notebook.
SECONDS = 60


def run(*words: object, **options: object) -> None:
    """Runs a program, and ends with its name if it fails."""
    done = subprocess.run([str(word) for word in words], cwd=HERE, **options)
    if done.returncode != 0:
        sys.exit(f"failed: {' '.join(str(word) for word in words)}")


def environment(path: pathlib.Path, fresh: bool = False) -> pathlib.Path:
    """The Python of a virtual environment."""
    python = path / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    if fresh or not python.exists():
        shutil.rmtree(path, ignore_errors=True)
        venv.create(path, with_pip=True)
    return python


def build(python: pathlib.Path) -> pathlib.Path:
    """The wheel of today's sources."""
    wheels = TARGET / "wheels"
    shutil.rmtree(wheels, ignore_errors=True)
    words = "-m maturin build --quiet --release --locked".split()
    run(python, *words, "--interpreter", python, "--out", wheels, "--target-dir", TARGET)
    (wheel,) = wheels.glob("*.whl")
    return wheel


def bare(wheel: pathlib.Path) -> float:
    """Installs the wheel where nothing is, runs the notebook, and returns the seconds."""
    start = time.monotonic()
    python = environment(TARGET / "bare", fresh=True)
    run(python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", wheel)
    run(python, "run_notebook.py", "five_minutes.ipynb", stdout=subprocess.DEVNULL)
    return time.monotonic() - start


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--wheel", type=pathlib.Path)
    parser.add_argument("--build", action="store_true", help="print where the wheel is, and test nothing")
    arguments, more = parser.parse_known_args()
    python = environment(TARGET / "tools")
    run(python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", *TOOLS)
    wheel = arguments.wheel.resolve() if arguments.wheel else build(python)
    if arguments.build:
        print(wheel)
        return
    seconds = bare(wheel)
    if seconds > SECONDS:
        sys.exit(f"installation and notebook took {seconds:.0f} s, at most {SECONDS}")
    # The workspace's own steps do not know these packages.
    run("cargo", "fmt", "--all", "--check")
    clippy = "clippy --quiet --workspace --locked --target-dir".split()
    run("cargo", *clippy, TARGET, "--", "--deny", "warnings")
    run("cargo", "build", "--quiet", "--release", "--locked", "--package", "robot-dynamics-bits", "--target-dir", TARGET)
    run(python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--force-reinstall", "--no-deps", wheel)
    bits = TARGET / "release" / "robot-dynamics-bits"
    settings = {**os.environ, "ROBOT_DYNAMICS_BITS": str(bits)}
    run(python, "-m", "pytest", "-q", "-p", "no:cacheprovider", "tests", *more, env=settings)
    run(python, "-m", "mypy.stubtest", "--ignore-disjoint-bases", "robot_dynamics", env=settings)
    run(python, "bench.py", "--check")
    print(f"installed and notebook run in {seconds:.0f} s")


if __name__ == "__main__":
    main()
