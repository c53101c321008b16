#!/usr/bin/env python3
"""Records the durations of Ruckig (the package ruckig) from any state to rest at a goal, six joints together.

    .venv/bin/python host-tests/oracle/moving_goals.py
    .venv/bin/python host-tests/oracle/moving_goals.py FILE

Writes host-tests/recordings/moving_goals.json.gz: of each problem the joints' limits of velocity, acceleration and jerk, their
velocity and acceleration, and their way to the goal, with the duration. With a FILE, which the test of a hundred thousand
goals writes (`GOALS=FILE`), it prints the durations there as shares of Ruckig's, which are 1.0 to 1.05. Needs requirements.txt.
"""
import json
import sys
from importlib.metadata import version

import numpy as np
import ruckig
from recorded import RECORDINGS, write

PROBLEMS = 1500


def joint(rng):
    """Limits over one and a half decades, a state from which they can be kept, and a way of any size."""
    speed = 10 ** rng.uniform(-0.5, 1.0)
    acceleration = speed * 10 ** rng.uniform(-0.3, 1.2)
    jerk = acceleration * 10 ** rng.uniform(-0.3, 1.2)
    while True:
        v, a = 0.999 * speed * rng.uniform(-1, 1), 0.999 * acceleration * rng.uniform(-1, 1)
        if abs(v + a * abs(a) / (2 * jerk)) < 0.998 * speed:
            break
    way = rng.uniform(-1, 1) * 10 ** rng.uniform(-3, 0.8)
    return [float(f"{x:.4g}") for x in (speed, acceleration, jerk, v, a, way)]


def seconds(joints):
    speed, acceleration, jerk, v, a, way = map(list, zip(*joints))
    problem, trajectory = ruckig.InputParameter(len(joints)), ruckig.Trajectory(len(joints))
    problem.max_velocity, problem.max_acceleration, problem.max_jerk = speed, acceleration, jerk
    problem.current_velocity, problem.current_acceleration = v, a
    problem.target_position = way
    result = ruckig.Ruckig(len(joints)).calculate(problem, trajectory)
    assert result in (ruckig.Result.Working, ruckig.Result.Finished), result
    return trajectory.duration


def record():
    rng = np.random.default_rng(50)
    problems = [[joint(rng) for _ in range(6)] for _ in range(PROBLEMS)]
    recording = {
        "ruckig": version("ruckig"),
        "problems": [{"joints": joints, "seconds": seconds(joints)} for joints in problems],
    }
    write(RECORDINGS / "moving_goals.json.gz", json.dumps(recording))


def compare(path):
    goals = np.fromfile(path).reshape(-1, 37)
    pairs = [(goal[36], seconds(goal[:36].reshape(6, 6))) for goal in goals]
    shares = np.array([ours / theirs for ours, theirs in pairs if theirs > 1e-6])
    print(f"{len(shares)} goals, duration / Ruckig's: {shares.min():.6f} to {shares.max():.6f}, mean {shares.mean():.6f}")
    assert len(shares) > 90_000 and shares.min() >= 1.0 and shares.max() <= 1.05


compare(sys.argv[1]) if len(sys.argv) > 1 else record()
