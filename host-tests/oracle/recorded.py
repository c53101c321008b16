"""The files of the recordings, and the command lines of the scripts that write them.

A name that ends in .gz is compressed without a time stamp: the same numbers give the same bytes. Rust reads such a
file by `recordings::read`.
"""

import argparse
import gzip
import json
import pathlib
import sys

RECORDINGS = pathlib.Path(__file__).resolve().parent.parent / "recordings"


def read(path):
    data = path.read_bytes()
    return (gzip.decompress(data) if path.suffix == ".gz" else data).decode()


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    data = text.encode()
    path.write_bytes(gzip.compress(data, 9, mtime=0) if path.suffix == ".gz" else data)


def load(name):
    return json.loads(read(RECORDINGS / f"{name}.json.gz"))


def finish(check, files):
    """Writes the (path, text) of `files`, or with --check fails if a file would change."""
    stale = []
    for path, text in files:
        if not check:
            write(path, text)
        elif not path.exists() or read(path) != text:
            stale.append(str(path))
    if stale:
        sys.exit("would change: " + ", ".join(stale))


def arguments(doc):
    parser = argparse.ArgumentParser(description=doc.split("\n\n")[0])
    parser.add_argument("--check", action="store_true", help="write nothing, fail if a file would change")
    return parser


def of_one(doc, path, text):
    """The command of a script that writes one file."""
    finish(arguments(doc).parse_args().check, [(path, text())])


def of_robots(doc, folder, record):
    """The command of a script that writes a file for each robot that it is given."""
    parser = arguments(doc)
    parser.add_argument("robots", nargs="?", default="-", help="JSON of an exporter; - or nothing: stdin")
    parser.add_argument("--out", type=pathlib.Path, default=RECORDINGS / folder, help="folder of the recordings")
    options = parser.parse_args()
    source = sys.stdin if options.robots == "-" else open(options.robots, encoding="utf-8")
    robots = json.load(source)
    finish(options.check, ((options.out / f"{robot['name']}.json.gz", record(robot)) for robot in robots))


def of_cases(folder, record):
    """The command of a script that writes a file for each hard case: of the numbers given, or of all."""
    only, cases = {int(x) for x in sys.argv[1:]}, {}
    for problem in json.load(sys.stdin):
        if not only or problem["case"] in only:
            cases.setdefault(problem["case"], []).append(problem)
    for case, problems in sorted(cases.items()):
        print(case, [p["name"] for p in problems], file=sys.stderr, flush=True)
        text = json.dumps([record(p) for p in problems], ensure_ascii=False, indent=0)
        write(RECORDINGS / folder / f"{case}.json", text + "\n")
