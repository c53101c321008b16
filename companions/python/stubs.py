"""Writes the docstrings of the compiled module into its stub, which says them to editors.

    python stubs.py --write  # of the installed wheel
    python stubs.py          # ends with what differs
"""

from __future__ import annotations

import ast
import inspect
import json
import pathlib
import sys

STUB = pathlib.Path(__file__).resolve().parent / "package/robot_dynamics/_native.pyi"


def documented(source: str, module: object) -> str:
    """The stub with the docstring of each public name in place of the body of a function."""
    lines = source.splitlines()

    def put(nodes: list[ast.stmt], owner: object) -> None:
        # From the end, so that lines before keep their numbers.
        for node in reversed(nodes):
            if not isinstance(node, (ast.FunctionDef, ast.ClassDef)) or node.name.startswith("_"):
                continue
            thing, at = inspect.getattr_static(owner, node.name), node.body[0]
            written = json.dumps(getattr(thing, "__func__", thing).__doc__, ensure_ascii=False)
            if isinstance(node, ast.FunctionDef):
                lines[at.lineno - 1] = lines[at.lineno - 1].encode()[: at.col_offset].decode() + written
                continue
            put(node.body, thing)
            if isinstance(at, ast.Expr):
                lines[at.lineno - 1] = f"    {written}"
            else:
                lines.insert(node.lineno, f"    {written}")

    put(ast.parse(source).body, module)
    return "\n".join(lines) + "\n"


def main() -> None:
    from robot_dynamics import _native

    source = STUB.read_text(encoding="utf-8")
    whole = documented(source, _native)
    if "--write" in sys.argv:
        STUB.write_text(whole, encoding="utf-8")
    elif whole != source:
        old = set(source.splitlines())
        sys.exit("stubs.py --write: " + "\n".join(line for line in whole.splitlines() if line not in old))


if __name__ == "__main__":
    main()
