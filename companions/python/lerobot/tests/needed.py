"""Prints what the LeRobot of this environment requires for its servos and datasets, in the ranges that
it states, without what `stand_ins.py` stands in for and what no test imports."""

from importlib.metadata import requires

from pip._vendor.packaging.requirements import Requirement
from stand_ins import PACKAGES

LEFT_OUT = {*PACKAGES, "lerobot", "rerun-sdk", "torchcodec", "cmake", "setuptools"}
EXTRAS = ("", "feetech", "pyserial-dep", "deepdiff-dep", "dataset", "av-dep")

for needed in map(Requirement, requires("lerobot")):
    here = needed.marker is None or any(needed.marker.evaluate({"extra": extra}) for extra in EXTRAS)
    if here and needed.name not in LEFT_OUT:
        needed.marker = None
        print(needed)
# LeRobot 0.4.4 has it by way of accelerate, which is left out.
print("safetensors")
