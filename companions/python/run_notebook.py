"""Runs the code of a notebook in this process, without jupyter: `python run_notebook.py
five_minutes.ipynb`.

A cell that raises ends the program with its number; `--write` stores what the cells print.
"""

from __future__ import annotations

import ast
import contextlib
import io
import json
import pathlib
import sys


def run(path: pathlib.Path) -> dict:
    """The notebook with the outputs of its cells."""
    notebook = json.loads(path.read_text(encoding="utf-8"))
    names: dict = {"__name__": "__main__"}
    count = 0
    for number, cell in enumerate(notebook["cells"], 1):
        if cell["cell_type"] != "code":
            continue
        count += 1
        source = "".join(cell["source"])
        tree = ast.parse(source, f"cell {number}")
        last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
        printed, value = io.StringIO(), None
        try:
            with contextlib.redirect_stdout(printed):
                exec(compile(tree, f"cell {number}", "exec"), names)
                if last is not None:
                    value = eval(compile(ast.Expression(last.value), f"cell {number}", "eval"), names)
        except Exception as error:
            raise SystemExit(f"{path.name}, cell {number}: {type(error).__name__}: {error}") from error
        cell["execution_count"] = count
        cell["outputs"] = []
        if printed.getvalue():
            text = printed.getvalue().splitlines(keepends=True)
            cell["outputs"].append({"name": "stdout", "output_type": "stream", "text": text})
        if value is not None:
            data = {"text/plain": repr(value).splitlines(keepends=True)}
            cell["outputs"].append(
                {"data": data, "execution_count": count, "metadata": {}, "output_type": "execute_result"}
            )
    return notebook


if __name__ == "__main__":
    arguments = [one for one in sys.argv[1:] if one != "--write"]
    if len(arguments) != 1:
        sys.exit("usage: python run_notebook.py NOTEBOOK.ipynb [--write]")
    path = pathlib.Path(arguments[0])
    done = run(path)
    if "--write" in sys.argv:
        path.write_text(json.dumps(done, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    print(sum(cell["cell_type"] == "code" for cell in done["cells"]), "cells")
