"""Prints what the LeRobot of this environment requires for its servos and datasets, in the ranges that
it states, without what `stand_ins.py` stands in for and what no test imports."""

from importlib.metadata import requires

from pip._vendor.packaging.requirements import Requirement
from stand_ins import PACKAGES

LEFT_OUT = {*PACKAGES, "rerun-sdk", "torchcodec", "cmake", "setuptools"}

extras, done = {"", "feetech", "dataset"}, set()
while done != extras:
    done, extras = set(extras), set(extras)
    for needed in map(Requirement, requires("lerobot")):
        if needed.name in LEFT_OUT or not any(needed.marker is None or needed.marker.evaluate({"extra": extra}) for extra in done):
            continue
        if needed.name == "lerobot":
            extras |= needed.extras
        else:
            needed.marker = None
            print(needed)
