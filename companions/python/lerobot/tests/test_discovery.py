"""LeRobot finds the plug-in by its name and makes it from its configuration."""

import subprocess
import sys
from pathlib import Path

import pytest

FRESH = """
import pathlib, sys
sys.path.insert(0, {here!r})
import stand_ins
stand_ins.install()
from lerobot.utils.import_utils import register_third_party_plugins
from lerobot.teleoperators import TeleoperatorConfig, Teleoperator, make_teleoperator_from_config
assert "so101_floating" not in TeleoperatorConfig.get_known_choices()
assert "lerobot_teleoperator_so101_floating" not in sys.modules
register_third_party_plugins()
made = TeleoperatorConfig.get_choice_class("so101_floating")
config = made(port="/dev/null", id="fresh", calibration_dir=pathlib.Path({folder!r}))
made = make_teleoperator_from_config(config)
assert isinstance(made, Teleoperator) and config.type == "so101_floating", made
print(type(made).__name__)
"""


def test_a_fresh_lerobot_finds_the_installed_plugin(tmp_path):
    program = FRESH.format(here=str(Path(__file__).parent), folder=str(tmp_path))
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, cwd=tmp_path)
    assert ended.stdout.strip() == "So101Floating", ended.stderr


def test_the_plugin_takes_the_lerobot_that_is_here():
    """Otherwise `pip install` of it would replace LeRobot, and torch with it."""
    from importlib.metadata import requires, version

    from packaging.requirements import Requirement

    for line in requires("lerobot_teleoperator_so101_floating"):
        needed = Requirement(line)
        if needed.marker is None:
            assert needed.specifier.contains(version(needed.name)), line
            # Nor does it exclude a later one.
            assert not any(each.operator in ("<", "<=", "==", "~=") for each in needed.specifier), line


def test_the_demonstration_runs(monkeypatch, capsys):
    from lerobot_teleoperator_so101_floating import demo

    monkeypatch.setattr(sys, "argv", ["demo", "--fast"])
    demo.main()
    *_, off, fell = capsys.readouterr().out.splitlines()
    assert off.endswith("its torque is off") and float(fell.split("°")[0].split()[-1]) <= 2.0


def test_features_are_known_without_a_connection(bench, at_rest):
    from lerobot.teleoperators.so_leader import SOLeader
    from lerobot.utils.errors import DeviceNotConnectedError

    bus = bench.bus(at_rest)
    teleoperator = bench.teleoperator(bus)
    assert teleoperator.action_features == SOLeader.action_features.fget(teleoperator)
    assert set(teleoperator.feedback_features) == {key.replace(".pos", ".torque") for key in teleoperator.action_features}
    assert not teleoperator.is_connected
    for call in (teleoperator.get_action, lambda: teleoperator.send_feedback({}), teleoperator.disconnect):
        with pytest.raises(DeviceNotConnectedError):
            call()


def test_lerobots_command_line_sets_every_field(tmp_path):
    import draccus
    from lerobot.utils.import_utils import register_third_party_plugins

    register_third_party_plugins()
    from lerobot.scripts.lerobot_teleoperate import TeleoperateConfig

    arguments = [
        "--robot.type=so101_follower", "--robot.port=/dev/null", "--teleop.type=so101_floating", "--teleop.port=/dev/zero",
        "--teleop.gears=[345, 345, 345, 345, 345, 345]", "--teleop.friction_share=0.5", "--teleop.supply=5.0",
        "--teleop.guardian=false",
    ]  # fmt: skip
    config = draccus.parse(TeleoperateConfig, args=arguments).teleop
    assert config.gears == (345.0,) * 6 and config.friction_share == 0.5 and config.supply == 5.0 and not config.guardian


WRONG = [
    {"friction_share": 0.95}, {"rate": 0.0}, {"torque_limit": float("nan")}, {"gears": (345.0,) * 5},
    {"gravity_scale": (1.0, 1.0, -1.0, 1.0, 1.0, 1.0)}, {"most_duty": 1.5}, {"least_supply": 9.0},
]  # fmt: skip


@pytest.mark.parametrize("wrong", WRONG)
def test_impossible_configurations_are_refused(wrong):
    from lerobot_teleoperator_so101_floating import So101FloatingConfig, WrongConfiguration

    with pytest.raises(WrongConfiguration):
        So101FloatingConfig(port="/dev/null", **wrong)
