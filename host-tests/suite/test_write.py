"""The check of the suite of hard cases refuses what its scripts do not write."""

import pathlib
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import write


def test_a_changed_case_is_refused(tmp_path, monkeypatch):
    case = next(write.existing())
    monkeypatch.setattr(write, "OUT", tmp_path)
    monkeypatch.setattr(write, "existing", lambda: [case])
    monkeypatch.setattr(write, "found", list)

    def said():
        monkeypatch.setattr(sys, "argv", ["write.py", "--check"])
        with pytest.raises(SystemExit) as end:
            write.main()
        return end.value.code

    monkeypatch.setattr(sys, "argv", ["write.py"])
    write.main()
    assert said() == 0
    (path,) = tmp_path.glob("*.json")
    text = path.read_text()
    # One digit of the last scale.
    place = max(text.rindex(digit) for digit in "0123456789")
    path.write_text(text[:place] + str((int(text[place]) + 1) % 10) + text[place + 1 :])
    assert said() == f"not current: {path.name}"
    path.write_text(text)
    (tmp_path / "99-other.json").write_text(text)
    assert said() == "not current: 99-other.json"
    path.unlink()
    assert said() == f"not current: {path.name}, 99-other.json"
