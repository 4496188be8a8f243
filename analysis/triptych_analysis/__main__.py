"""python3 -m triptych_analysis SOURCE… --out FOLDER"""

import argparse
import os
import sys

from . import analysis, correlation, dataset, output, tables

EXIT_NOTHING, EXIT_USAGE = 2, 3


def arguments_of(words):
    parser = argparse.ArgumentParser(
        prog="analyze", description="Computes distributions, correlations, speed-ups, predictions and comparisons of views "
        "from exported tables. Writes a CSV file for each table and an SVG file for each figure to FOLDER/SUITE/SIGNAL.",
        epilog="Exit codes: 0 success, 2 nothing could be computed, 3 usage or I/O error.")
    parser.add_argument("source", nargs="+", help="a folder that `triptych export` wrote, or a store")
    parser.add_argument("--out", required=True, help="write tables and figures to this folder")
    parser.add_argument("--plan", help="use only the records of this plan, SUITE/PLAN (default: the records of all plans)")
    parser.add_argument("--clock", choices=["auto", "device", "wall"], default="auto",
                        help="clock to use; auto is the device clock if it is trusted for every record, otherwise the wall clock")
    parser.add_argument("--reference", action="append", default=[], metavar="FACTOR=LEVEL",
                        help="compute the speed-ups of this factor relative to this level (repeatable)")
    parser.add_argument("--seed", type=int, default=1, help="seed for all random numbers")
    return parser.parse_args(words)


def references_of(words):
    references = {}
    for each in words:
        factor, equals, level = each.partition("=")
        if not (factor and equals and level):
            raise tables.InputError(f"--reference {each}: expected FACTOR=LEVEL")
        references[factor] = level
    return references


def run(arguments):
    references = references_of(arguments.reference)
    records = tables.read(arguments.source, arguments.plan)
    nothing = True
    found = dataset.datasets(records, arguments.clock)
    correlation.require_references(found, references)
    for data in found:
        of = analysis.analyse(data, references, arguments.seed)
        output.write(of, os.path.join(arguments.out, data.suite, data.signal))
        print("\n".join(output.summary(of)), flush=True)
        nothing = nothing and of.empty()
    return EXIT_NOTHING if nothing else 0


def main(words=None):
    try:
        arguments = arguments_of(words)
    except SystemExit as left:  # argparse exits with code 2, which means "nothing could be computed" here
        return left.code and EXIT_USAGE
    try:
        return run(arguments)
    except (tables.InputError, OSError) as error:
        print(f"analyze: {error}", file=sys.stderr)
        return EXIT_USAGE


if __name__ == "__main__":
    sys.exit(main())
