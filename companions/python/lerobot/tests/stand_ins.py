"""Stand-ins for what LeRobot imports on the way to its teleoperators and never uses there, above
all torch.

PyPI's torch for Linux takes several gigabytes with its libraries, which no test here needs:
LeRobot's base classes, its bus, its plug-in discovery and its teleoperation loop are the real ones,
and name torch in annotations and as base classes alone. Each stand-in accepts any attribute; a
program that computed with one would fail. A package that is installed has no stand-in.
"""

import importlib.abc
import importlib.machinery
import importlib.util
import sys
import types

PACKAGES = ("torch", "torchvision", "accelerate", "diffusers", "transformers", "rerun", "wandb", "pynput")


class StandIn(types.ModuleType):
    """A module, function or value of any name."""

    __path__: list[str] = []
    __version__ = "2.10.0"

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        # Names in capitals become classes, which may be inherited from.
        made = (
            type(name, (), {"__init__": lambda self, *a, **k: None}) if name[0].isupper() else StandIn(f"{self.__name__}.{name}")
        )
        setattr(self, name, made)
        return made

    def __call__(self, decorated=None, *_, **__):
        return decorated if callable(decorated) else StandIn(self.__name__)

    def __or__(self, _):
        return object

    __ror__ = __or__


class Finder(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    def __init__(self, packages):
        self.packages = packages

    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in self.packages:
            return importlib.machinery.ModuleSpec(name, self, is_package=True)
        return None

    def create_module(self, spec):
        return StandIn(spec.name)

    def exec_module(self, module):
        pass


def install() -> None:
    lacking = {name for name in PACKAGES if importlib.util.find_spec(name) is None}
    sys.meta_path.insert(0, Finder(lacking))
