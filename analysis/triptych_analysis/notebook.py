"""Runs the cells of a notebook in order, without Jupyter. Prints the results that Jupyter would display, and writes figures to
OUT/cell_N.svg."""

import argparse
import ast
import json
import os
import sys
import traceback


def cells_of(file):
    with open(file, encoding="utf-8") as text:
        return ["".join(each["source"]) for each in json.load(text)["cells"] if each["cell_type"] == "code"]


def run_cell(source, names, where):
    """Executes a cell and returns the value of its last expression, as Jupyter does."""
    tree = ast.parse(source, where)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, where, "exec"), names)
    return eval(compile(ast.Expression(last.value), where, "eval"), names) if last else None


def show(value, file):
    if hasattr(value, "_repr_svg_"):
        with open(file, "w", encoding="utf-8") as text:
            text.write(value._repr_svg_())
        print(file)
    elif value is not None:
        print(value.to_string() if hasattr(value, "to_string") else value)


def main(words=None):
    parser = argparse.ArgumentParser(prog="notebook", description=__doc__)
    parser.add_argument("notebook")
    parser.add_argument("tables", help="a folder that `triptych export` wrote, or a store")
    parser.add_argument("--out", required=True)
    arguments = parser.parse_args(words)
    os.makedirs(arguments.out, exist_ok=True)
    os.environ.update(TRIPTYCH_TABLES=arguments.tables, TRIPTYCH_ANALYSIS=arguments.out)
    names = {"__name__": "__main__"}
    for number, source in enumerate(cells_of(arguments.notebook), 1):
        where = f"{arguments.notebook}, cell {number}"
        try:
            show(run_cell(source, names, where), os.path.join(arguments.out, f"cell_{number}.svg"))
        except Exception:
            traceback.print_exc()
            print(f"{where} failed", file=sys.stderr)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
