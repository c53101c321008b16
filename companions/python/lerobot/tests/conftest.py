"""Fixtures: an SO-101 in simulated time, and the teleoperator that floats it."""

import json
import os
import sys
from pathlib import Path

import stand_ins

sys.path.insert(0, str(Path(__file__).parent))
stand_ins.install()

import pytest  # noqa: E402

from lerobot_teleoperator_so101_floating.motors import JOINTS  # noqa: E402
from lerobot_teleoperator_so101_floating.simulated import SCENE_GEARS, TICK, Arm, Bench, Still, calibration, install, run  # noqa: E402

install()

REPOSITORY = Path(__file__).parents[4]


@pytest.fixture
def bench(tmp_path):
    made = Bench(tmp_path)
    yield made
    made.close()


@pytest.fixture
def at_rest():
    """An arm that stands in a stretched posture."""
    return Still([0.0, 0.6, -0.6, 0.2, 0.0, 0.3])


@pytest.fixture(scope="session")
def scene():
    """The commands of the firmware's scene, recorded by the bin so101_floating of ../bits."""
    path = os.environ.get("SO101_FLOATING_SCENE")
    if not path:
        pytest.fail("SO101_FLOATING_SCENE names the record of the scene: run check --full")
    return json.loads(Path(path).read_text())


__all__ = ["JOINTS", "SCENE_GEARS", "TICK", "Arm", "Bench", "Still", "calibration", "run"]
