"""Episodes of a LeRobot dataset, v2.1 or v3, as a table that `cargo xtask identify` reads.

    python -m lerobot_teleoperator_so101_floating.dataset FOLDER OUT.csv [--episodes 0 1]

OUT.csv has `timestamp` in s, `JOINT.pos` in degrees, and `JOINT.torque`, `.effort` or `.current`
as recorded; OUT.toml is the map of the columns. LeRobot stores no units: positions are degrees if
the robot had `use_degrees`, and `identify` asks for the torque's unit unless it is stated here.
Nothing in the dataset names a file: its tables are those in the folders of `data`.
"""

import argparse
import csv
import importlib.util
import json
import math
import re
import sys
from pathlib import Path

POSITIONS, TORQUES = ("pos", "position", "state"), ("torque", "effort", "current")
NAME = re.compile(r"[A-Za-z0-9_-]{1,64}")
BETWEEN = 1.0
"""The time between two episodes in the table, s; in the dataset each begins at zero."""


class UnfitDataset(ValueError):
    """The dataset has not what an identification needs, or is none."""


def _quantities(info: dict) -> dict[str, dict[str, tuple[str, int]]]:
    """For each quantity and joint the observation that has it, and its place there."""
    found: dict[str, dict[str, tuple[str, int]]] = {}
    for feature, of in info["features"].items():
        names = of.get("names")
        names = next(iter(names.values()), None) if isinstance(names, dict) else names
        if not feature.startswith("observation.") or not isinstance(names, list) or len(of.get("shape", ())) != 1:
            continue
        for place, name in enumerate(map(str, names)):
            joint, _, quantity = name.rpartition(".")
            if not joint:
                joint, quantity = name, feature.rpartition(".")[2]
            quantity = "pos" if quantity in POSITIONS else quantity
            if quantity in ("pos", *TORQUES):
                if not NAME.fullmatch(joint):
                    raise UnfitDataset(f"{joint[:80]!r} is no name of a joint: letters, digits, _ and - are")
                found.setdefault(quantity, {})[joint] = (feature, place)
    return found


def _columns(folder: Path) -> dict[str, tuple[str, int]]:
    """The columns of the table, and where each comes from."""
    try:
        quantities = _quantities(json.loads((folder / "meta/info.json").read_text()))
    except UnfitDataset:
        raise
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise UnfitDataset(f"{folder} is no dataset of LeRobot: meta/info.json: {error!r}") from error
    positions = quantities.pop("pos", {})
    torques = next((quantity for quantity in TORQUES if quantity in quantities), None)
    joints = [joint for joint in positions if torques and joint in quantities[torques]]
    if not joints:
        raise UnfitDataset(
            f"the dataset has positions of {list(positions)} and no torque or current of them, from which alone masses and "
            "friction follow: record it beside the positions, with a robot whose observation_features and get_observation "
            'have "JOINT.torque" or "JOINT.current" too, for instance from bus.sync_read("Present_Current")'
        )
    named = [(f"{joint}.pos", positions[joint]) for joint in joints]
    return dict(named + [(f"{joint}.{torques}", quantities[torques][joint]) for joint in joints])


def rows(folder: Path, columns: dict[str, tuple[str, int]], episodes: set[int]):
    """The table's rows, episode by episode."""
    import pyarrow
    import pyarrow.parquet as parquet

    features = sorted({feature for feature, _ in columns.values()})
    end, before, offset = -BETWEEN, None, 0.0
    for file in sorted(folder.glob("data/*/*.parquet")):
        try:
            table = parquet.read_table(file, columns=["timestamp", "episode_index", *features]).to_pylist()
        except (pyarrow.ArrowException, OSError) as error:
            raise UnfitDataset(f"{file}: {error}") from error
        for number, row in enumerate(table):
            try:
                if episodes and row["episode_index"] not in episodes:
                    continue
                values = [float(row["timestamp"]), *(float(row[feature][place]) for feature, place in columns.values())]
            except (KeyError, IndexError, TypeError, ValueError) as error:
                raise UnfitDataset(f"{file}, row {number}: {error!r}") from error
            if not all(map(math.isfinite, values)):
                raise UnfitDataset(f"{file}, row {number}: a value is not finite")
            if row["episode_index"] != before:
                before, offset = row["episode_index"], end + BETWEEN - values[0]
            end = values[0] = values[0] + offset
            yield values


def main(arguments: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--episodes", type=int, nargs="+", default=[])
    parser.add_argument("--torque-unit", choices=["Nm", "mNm", "A", "mA"])
    given = parser.parse_args(arguments)
    if importlib.util.find_spec("pyarrow") is None:
        sys.exit('tables of LeRobot need pyarrow: pip install "lerobot[dataset]"')
    try:
        columns = _columns(given.folder)
        table = list(rows(given.folder, columns, set(given.episodes)))
        if not table:
            raise UnfitDataset(f"{given.folder} has no rows of these episodes")
    except UnfitDataset as error:
        sys.exit(str(error))
    with given.out.open("w", newline="") as file:
        csv.writer(file).writerows([["timestamp", *columns], *table])
    joints = [column.removesuffix(".pos") for column in columns if column.endswith(".pos")]
    torque = next(reversed(columns)).rpartition(".")[2]
    lines = [f"joints = {joints}", "time = 'timestamp'", "time_unit = 's'", "position = '{joint}.pos'"]
    lines += ["position_unit = 'deg'", f"torque = '{{joint}}.{torque}'"]
    lines += [f"torque_unit = '{given.torque_unit}'"] if given.torque_unit else []
    given.out.with_suffix(".toml").write_text("\n".join(lines) + "\n")
    print(f"{len(table)} rows of {', '.join(joints)}")


if __name__ == "__main__":
    main()
