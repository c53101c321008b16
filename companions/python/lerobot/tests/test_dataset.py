"""Episodes of LeRobot's datasets become the table and the map that an identification reads."""

import csv
import json

import pytest

from lerobot_teleoperator_so101_floating import dataset

parquet = pytest.importorskip("pyarrow.parquet")


def write(folder, version, names, extra=None, value=0.5):
    """Two episodes of three rows: a file for each in v2.1, one for both in v3."""
    import pyarrow

    count = len(names["motors"] if isinstance(names, dict) else names)
    features = {"observation.state": {"dtype": "float32", "shape": [count], "names": names}} | (extra or {})
    info = {"codebase_version": version, "fps": 30, "data_path": "../../etc/{episode_index}", "features": features}
    (folder / "meta").mkdir(parents=True)
    (folder / "meta/info.json").write_text(json.dumps(info))
    rows = [
        {"timestamp": tick / 30, "episode_index": episode, "frame_index": tick}
        | {feature: [value + 10 * place + tick for place in range(of["shape"][0])] for feature, of in features.items()}
        for episode in (0, 1)
        for tick in range(3)
    ]
    parts = [rows[:3], rows[3:]] if version == "v2.1" else [rows]
    (folder / "data/chunk-000").mkdir(parents=True)
    for number, part in enumerate(parts):
        parquet.write_table(pyarrow.Table.from_pylist(part), folder / f"data/chunk-000/file-{number:03d}.parquet")


CURRENT = {"observation.current": {"dtype": "float32", "shape": [2], "names": ["lift", "pan"]}}
LAYOUTS = {
    "v3.0": (["pan.pos", "lift.pos", "pan.torque", "lift.torque"], None, "torque", [20.5, 30.5]),
    "v2.1": ({"motors": ["pan", "lift"]}, CURRENT, "current", [10.5, 0.5]),
}


@pytest.mark.parametrize("version", LAYOUTS)
def test_episodes_become_a_table_and_its_map(tmp_path, version):
    names, extra, torque, first = LAYOUTS[version]
    write(tmp_path / "set", version, names, extra)
    out = tmp_path / "log.csv"
    dataset.main([str(tmp_path / "set"), str(out), "--torque-unit", "mA"])
    titles, *rows = list(csv.reader(out.open()))
    assert titles == ["timestamp", "pan.pos", "lift.pos", f"pan.{torque}", f"lift.{torque}"] and len(rows) == 6
    times = [float(row[0]) for row in rows]
    assert [float(x) for x in rows[0]] == pytest.approx([0.0, 0.5, 10.5, *first])
    assert times[3] - times[2] == pytest.approx(1.0) and times == sorted(times)
    assert f"position_unit = 'deg'\ntorque = '{{joint}}.{torque}'\ntorque_unit = 'mA'\n" in (tmp_path / "log.toml").read_text()
    dataset.main([str(tmp_path / "set"), str(out), "--episodes", "1"])
    assert len(out.read_text().splitlines()) == 4


def write_broken(folder):
    write(folder, "v3.0", ["pan.pos", "pan.torque"])
    (folder / "data/chunk-000/file-000.parquet").write_bytes(b"PAR1 and no more")


WRONG = {
    "a broken table": (write_broken, "file-000.parquet"),
    "positions alone": (lambda folder: write(folder, "v3.0", ["pan.pos", "lift.pos"]), "no torque or current .*Present_Current"),
    "a name that is a path": (lambda folder: write(folder, "v3.0", ["../../pan.pos"]), "is no name of a joint"),
    "no number": (lambda folder: write(folder, "v3.0", ["pan.pos", "pan.torque"], value=float("nan")), "row 0: .*not finite"),
    "another folder": (lambda folder: folder.mkdir(), "is no dataset of LeRobot"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_no_record_of_torques_is_refused(tmp_path, name):
    make, words = WRONG[name]
    make(tmp_path / "set")
    with pytest.raises(SystemExit, match=words):
        dataset.main([str(tmp_path / "set"), str(tmp_path / "log.csv")])
    assert not (tmp_path / "log.csv").exists()
