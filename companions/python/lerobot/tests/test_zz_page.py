"""The page has the figures of this run and all errors; it comes last, after the tests that
measure."""

import math

import page
import pytest


def rounded_up(value: float) -> str:
    """Two digits, never less than measured."""
    step = 10.0 ** (math.floor(math.log10(value)) - 1)
    return f"{math.ceil(value / step - 1e-9) * step:.10f}".rstrip("0").rstrip(".")


def percent(share: float) -> str:
    return f"{rounded_up(100.0 * share)} %"


def test_the_tables_are_those_of_this_run():
    wanted = {f"{way} {law}" for way in ("rest", "motion", "release") for law in ("scene", "leader")}
    wanted |= {"release off -1", "release off +1", "bus lost", "down scene", "down leader"}
    if not wanted <= set(page.figures):
        pytest.skip("some of the tests that measure did not run, or failed")
    f = page.figures
    names = {"scene": "gears and law of the scene `so101_teach`", "leader": "a leader's gears, hand guiding (the default)"}
    lines = ["| | at rest, mean of a second | in motion, mean of 50 ms | single ticks |", "| --- | ---: | ---: | ---: |"]
    for law, name in names.items():
        (rest, rounding), (motion, whole) = f[f"rest {law}"], f[f"motion {law}"]
        lines.append(f"| {name} | {percent(rest)} | {percent(motion)} | {percent(max(rounding, whole))} |")
    page.table("torque", lines)
    off = max(f["release off -1"][0], f["release off +1"][0])
    lines = ["| released for two seconds | greatest drift |", "| --- | ---: |"]
    lines += [
        f"| gears of the scene, model exact | {rounded_up(f['release scene'][0])}° |",
        f"| a leader's gears, model exact | {rounded_up(f['release leader'][0])}° |",
        f"| gravity 3 % off, friction 10 % less than the model's | {rounded_up(off)}° |",
        f"| the adapter unplugged at the release: the last duties stay | {rounded_up(f['bus lost'][0])}° |",
        f"| without torque, the posture that falls least | {math.floor(min(f['release scene'][1], f['release leader'][1]))}° |",
    ]
    page.table("release", lines)
    down = [max(each) for each in zip(f["down scene"], f["down leader"], strict=True)]
    lines = ["| disconnected, in no hand | |", "| --- | ---: |"]
    lines += [f"| greatest fall of a joint, two seconds after its torque is off | {rounded_up(down[0])}° |"]
    lines += [f"| greatest speed of a joint while the arm comes down | {rounded_up(down[1])} rad/s |"]
    page.table("down", lines)


def test_every_error_is_on_the_page():
    import lerobot_teleoperator_so101_floating as package

    text = page.PAGE.read_text()
    for name in package.__all__:
        if isinstance(getattr(package, name), type) and issubclass(getattr(package, name), Exception):
            assert f"`{name}`" in text, name
