"""Writes the docstrings of the compiled module into its stub, which says them to editors.

    python stubs.py --write  # of the installed wheel
    python stubs.py          # ends with what differs
"""

from __future__ import annotations

import ast
import inspect
import pathlib
import sys

STUB = pathlib.Path(__file__).resolve().parent / "package/robot_dynamics/_native.pyi"


def documented(source: str, module: object) -> str:
    """The stub with the docstring of each public name; a body of `...` becomes it."""
    lines = source.splitlines()

    def put(nodes: list[ast.stmt], owner: object) -> None:
        # From the end, so that lines before keep their numbers.
        for node in reversed(nodes):
            if not isinstance(node, (ast.FunctionDef, ast.ClassDef)) or node.name.startswith("_"):
                continue
            thing = inspect.getattr_static(owner, node.name)
            text = getattr(thing, "__func__", thing).__doc__
            written = '"' + text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n") + '"'
            if isinstance(node, ast.ClassDef):
                put(node.body, thing)
                at = node.body[0]
                if isinstance(at, ast.Expr):
                    lines[at.lineno - 1] = f"    {written}"
                else:
                    first = min([at.lineno, *(one.lineno for one in getattr(at, "decorator_list", []))])
                    lines.insert(first - 1, f"    {written}")
            else:
                at = node.body[0]
                lines[at.lineno - 1] = lines[at.lineno - 1].encode()[: at.col_offset].decode() + written

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
