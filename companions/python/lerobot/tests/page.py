"""The tables of the page: written with TABLES_WRITE=1, otherwise compared."""

import os
from pathlib import Path

figures: dict = {}
PAGE = Path(os.environ.get("SO101_FLOATING_PAGE", Path(__file__).parents[2] / "docs/lerobot.md"))


def table(name: str, lines: list[str]) -> None:
    """The lines between the markers of this name are these."""
    text = PAGE.read_text()
    begin, end = f"<!-- {name}:begin -->", f"<!-- {name}:end -->"
    head, rest = text.split(begin)
    now, tail = rest.split(end)
    wanted = "\n<!-- written by check --full with TABLES_WRITE=1: do not edit -->\n\n"
    wanted += "\n".join(lines) + "\n\n"
    if os.environ.get("TABLES_WRITE"):
        PAGE.write_text(head + begin + wanted + end + tail)
    else:
        assert now == wanted, f"the table {name} of {PAGE.name} is older than this run:\n{wanted}"
