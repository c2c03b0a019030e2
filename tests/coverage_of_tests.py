#!/usr/bin/env python3
"""coverage_of_tests.py BUILD: what the tests of a build with counters reached.

Prints a table of lines and branches of src by folder, then, behind an empty line, the lines that
nothing reached. Branches are those of conditions; the ways out of a call that throws are not
counted, for every call has one.
"""

import collections
import json
import re
import subprocess
import sys
from pathlib import Path

SOURCE = Path(__file__).resolve().parent.parent


def counted(build):
    """Executions of every line, and of every branch of every line, by file."""
    lines = collections.defaultdict(lambda: collections.defaultdict(int))
    branches = collections.defaultdict(lambda: collections.defaultdict(int))
    for data in sorted(build.rglob("*.gcda")):
        report = subprocess.run(
            ["gcov", "--json-format", "--branch-probabilities", "--stdout", str(data)],
            capture_output=True, text=True, check=True, cwd=build,
        ).stdout
        for document in filter(None, report.splitlines()):
            for file in json.loads(document)["files"]:
                path = (build / file["file"]).resolve()
                if not path.is_relative_to(SOURCE / "src"):
                    continue
                name = path.relative_to(SOURCE).as_posix()
                seen = collections.Counter()
                for line in file["lines"]:
                    number = line["line_number"]
                    lines[name][number] += line["count"]
                    for branch in line["branches"]:
                        key = (number, seen[number])
                        seen[number] += 1
                        if not branch["throw"]:
                            branches[name][key] += branch["count"]
    return lines, branches


def ranges(numbers):
    """1,2,3,7 as "1-3, 7"."""
    text = []
    for number in sorted(numbers):
        if text and text[-1][1] == number - 1:
            text[-1][1] = number
        else:
            text.append([number, number])
    return ", ".join(f"{a}" if a == b else f"{a}-{b}" for a, b in text)


def main():
    lines, branches = counted(Path(sys.argv[1]).resolve())
    if not lines:
        sys.exit("coverage_of_tests.py: nothing was counted")
    folders = collections.defaultdict(lambda: [0, 0, 0, 0])
    for name, counts in lines.items():
        folder = folders[re.match(r"src/[^/]+", name)[0]]
        folder[0] += len(counts)
        folder[1] += sum(count > 0 for count in counts.values())
        folder[2] += len(branches[name])
        folder[3] += sum(count > 0 for count in branches[name].values())
    print(f"{'folder':20}{'lines':>8}{'reached':>10}{'branches':>10}{'reached':>10}")
    for folder, (total, reached, ways, taken) in sorted(folders.items()):
        share = f"{100 * taken / ways:9.1f}%" if ways else f"{'-':>10}"
        print(f"{folder:20}{total:8}{100 * reached / total:9.1f}%{ways:10}{share}")
    print()
    for name, counts in sorted(lines.items()):
        missed = [number for number, count in counts.items() if count == 0]
        if missed:
            print(f"{name}: {ranges(missed)}")


if __name__ == "__main__":
    main()
