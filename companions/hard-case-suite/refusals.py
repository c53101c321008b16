"""The check of the suite refuses what its scripts do not write: a changed digit, a file too many,
and one that is missing."""

import tempfile
from pathlib import Path

import write

with tempfile.TemporaryDirectory() as folder:
    write.OUT = Path(folder)
    case = next(write.existing())
    path = write.OUT / f"{case.number:02}-{case.name}.json"
    text = write.written(case)
    path.write_text(text)
    assert write.stale({path: text}) == []
    # One digit of the last scale.
    place = max(text.rindex(digit) for digit in "0123456789")
    path.write_text(text[:place] + str((int(text[place]) + 1) % 10) + text[place + 1 :])
    assert write.stale({path: text}) == [path.name]
    path.write_text(text)
    (write.OUT / "99-other.json").write_text(text)
    assert write.stale({path: text}) == ["99-other.json"]
    path.unlink()
    assert write.stale({path: text}) == [path.name, "99-other.json"]
