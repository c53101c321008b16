"""Episodes of LeRobot's datasets become the table and the map that an identification reads."""

import csv
import json

import pytest

from lerobot_teleoperator_so101_floating import dataset

parquet = pytest.importorskip("pyarrow.parquet")


def write(folder, version, names, extra=None, value=0.5):
    """Two episodes of three rows: a file for each in v2.1, one for both in v3."""
    import pyarrow

    features = {"observation.state": {"dtype": "float32", "shape": [len(names)], "names": names}} | (extra or {})
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
    listed = names if isinstance(names, list) else names["motors"]
    write(tmp_path / "set", version, listed, extra)
    if isinstance(names, dict):
        info = json.loads((tmp_path / "set/meta/info.json").read_text())
        info["features"]["observation.state"]["names"] = names
        (tmp_path / "set/meta/info.json").write_text(json.dumps(info))
    out = tmp_path / "log.csv"
    dataset.main([str(tmp_path / "set"), str(out), "--torque-unit", "mA"])
    titles, *rows = list(csv.reader(out.open()))
    assert titles == ["timestamp", "pan.pos", "lift.pos", f"pan.{torque}", f"lift.{torque}"] and len(rows) == 6
    assert [float(x) for x in rows[0]] == pytest.approx([0.0, 0.5, 10.5, *first])
    times = [float(row[0]) for row in rows]
    assert times[3] - times[2] == pytest.approx(1.0) and times == sorted(times)
    wanted = f"position_unit = 'deg'\ntorque = '{{joint}}.{torque}'\ntorque_unit = 'mA'\n"
    assert (tmp_path / "log.toml").read_text().endswith(wanted)
    dataset.main([str(tmp_path / "set"), str(out), "--episodes", "1"])
    assert len(out.read_text().splitlines()) == 4


WRONG = {
    "positions alone": (lambda folder: write(folder, "v3.0", ["pan.pos", "lift.pos"]), "no torque or current .*Present_Current"),
    "a name that is a path": (lambda folder: write(folder, "v3.0", ["../../pan.pos"]), "is no name of a joint"),
    "a name with a line": (lambda folder: write(folder, "v3.0", ["pan\n.pos"]), "is no name of a joint"),
    "a value that is none": (
        lambda folder: write(folder, "v3.0", ["pan.pos", "pan.torque"], value=float("nan")),
        "file-000.parquet, row 0: a value is not finite",
    ),
    "another folder": (lambda folder: folder.mkdir(), "is no dataset of LeRobot"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_no_record_of_torques_is_refused(tmp_path, name):
    make, words = WRONG[name]
    make(tmp_path / "set")
    with pytest.raises(SystemExit, match=words):
        dataset.main([str(tmp_path / "set"), str(tmp_path / "log.csv")])
    assert not (tmp_path / "log.csv").exists()


def test_a_broken_table_is_refused(tmp_path):
    write(tmp_path / "set", "v3.0", ["pan.pos", "pan.torque"])
    (tmp_path / "set/data/chunk-000/file-000.parquet").write_bytes(b"PAR1 and no more")
    with pytest.raises(SystemExit, match="file-000.parquet"):
        dataset.main([str(tmp_path / "set"), str(tmp_path / "log.csv")])
