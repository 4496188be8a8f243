"""Runs the cells of a notebook in order, without Jupyter. Prints the results that Jupyter would display below their headings, and
writes figures to OUT, in files that are named after the headings. Leaves out empty tables."""

import argparse
import ast
import json
import os
import re
import sys
import traceback


def cells_of(file):
    """Returns (heading, source) for each code cell."""
    cells, heading = [], ""
    with open(file, encoding="utf-8") as text:
        for each in json.load(text)["cells"]:
            source = "".join(each["source"])
            if each["cell_type"] == "code":
                cells.append((heading, source))
            elif source.startswith("#"):
                heading = source.split("\n")[0].lstrip("# ")
    return cells


def file_name(heading, used):
    """Returns a file name that is not in `used`, and adds it. It consists of the words of the heading before punctuation."""
    words = re.sub(r"[^a-z0-9]+", "_", re.split("[:?.]", heading.lower())[0]).strip("_") or "figure"
    name, number = words, 1
    while name in used:
        number += 1
        name = f"{words}_{number}"
    used.add(name)
    return f"{name}.svg"


def run_cell(source, names, where):
    """Executes a cell and returns the value of its last expression, as Jupyter does."""
    tree = ast.parse(source, where)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, where, "exec"), names)
    return eval(compile(ast.Expression(last.value), where, "eval"), names) if last else None


def show(value, title, folder, used, heading):
    """Prints a result below the title, or writes it to the folder. Returns whether there was a result."""
    if value is None or getattr(value, "empty", False):
        return False
    if title:
        print(f"\n{title}")
    if hasattr(value, "_repr_svg_"):
        file = os.path.join(folder, file_name(heading, used))
        with open(file, "w", encoding="utf-8") as text:
            text.write(value._repr_svg_())
        print(file)
    else:
        print(value.to_string() if hasattr(value, "to_string") else value)
    return True


def main(words=None):
    parser = argparse.ArgumentParser(prog="notebook", description=__doc__)
    parser.add_argument("notebook")
    parser.add_argument("tables", help="a folder that `triptych export` wrote, or a store")
    parser.add_argument("--out", required=True)
    arguments = parser.parse_args(words)
    os.makedirs(arguments.out, exist_ok=True)
    os.environ.update(TRIPTYCH_TABLES=arguments.tables, TRIPTYCH_ANALYSIS=arguments.out)
    names = {"__name__": "__main__"}
    used, printed = set(), ""
    for number, (heading, source) in enumerate(cells_of(arguments.notebook), 1):
        where = f"{arguments.notebook}, cell {number}"
        try:
            value = run_cell(source, names, where)
            title = heading if heading != printed else ""
            if show(value, title, arguments.out, used, heading):
                printed = heading
        except Exception:
            traceback.print_exc()
            print(f"{where} failed", file=sys.stderr)
            return 1
    print(f"\nTables and figures were written to {arguments.out}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
