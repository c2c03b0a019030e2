#!/usr/bin/env python3
"""coverage_of_tests.py PROFILES PROGRAM...: what runs of programs with clang's counters reached.

PROFILES is the folder of what they counted (*.profraw). Prints a table of lines and branches of src
by folder, then, behind an empty line, the lines and conditions that nothing reached. A branch is one
outcome of a condition of the source, true or false; the instances of a template share theirs, and
what the compiler decides (`if constexpr`) is no condition. Lists of names (`names_of_values`), which
the compiler reads, are no lines.
"""

import collections
import json
import re
import subprocess
import sys
from pathlib import Path

SOURCE = Path(__file__).resolve().parent.parent


def inside(path):
    """The path from the project's folder of a file below src; empty for others."""
    path = Path(path)
    return path.relative_to(SOURCE).as_posix() if path.is_relative_to(SOURCE / "src") else ""


def read_by_compiler(source):
    """The numbers of the lines of the lists of names in `source`."""
    numbers, within = set(), False
    for number, line in enumerate(source, 1):
        within = within or line.startswith("constexpr auto names_of_values(")
        if within:
            numbers.add(number)
        within = within and line != "}"
    return numbers


def counted(profiles, programs):
    """Executions of every line, and of every branch of every line, by file."""
    lines = collections.defaultdict(dict)
    branches = collections.defaultdict(collections.Counter)
    name = ""
    merged = profiles / "merged"
    subprocess.run(["llvm-profdata-14", "merge", "-o", merged, *profiles.glob("*.profraw")], check=True)
    objects = [word for program in programs[1:] for word in ("-object", program)]
    export = ["llvm-cov-14", "export", f"-instr-profile={merged}", programs[0], *objects]
    lcov = subprocess.run([*export, "-format=lcov"], stdout=subprocess.PIPE, text=True, check=True)
    for entry in lcov.stdout.splitlines():
        kind, _, rest = entry.partition(":")
        if kind == "SF":
            name = inside(rest)
        elif name and kind == "DA":
            number, count = rest.split(",")[:2]
            lines[name][int(number)] = int(count)
    # Only this format has the columns, which tell two conditions of a line from two instances of one.
    tree = subprocess.run([*export, "-format=text", "-skip-functions", "-skip-expansions"],
                          stdout=subprocess.PIPE, check=True)
    for file in json.loads(tree.stdout)["data"][0]["files"]:
        name = inside(file["filename"])
        source = (SOURCE / name).read_text().splitlines() if name else []
        for number in read_by_compiler(source):
            lines[name].pop(number, None)
        for line, column, _, _, taken, passed, *_ in file["branches"] if name else []:
            if "if constexpr" in source[line - 1]:
                continue
            branches[name][line, column, True] += taken
            branches[name][line, column, False] += passed
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
    lines, branches = counted(Path(sys.argv[1]), sys.argv[2:])
    if not lines:
        sys.exit("coverage_of_tests.py: nothing was counted")
    folders = collections.defaultdict(lambda: [0, 0, 0, 0])
    for name, counts in lines.items():
        folder = folders[re.match(r"src/[^/]+", name)[0]]
        folder[0] += len(counts)
        folder[1] += sum(count > 0 for count in counts.values())
        folder[2] += len(branches[name])
        folder[3] += sum(count > 0 for count in branches[name].values())
    print("| folder | lines | reached | branches | reached |\n|---|---:|---:|---:|---:|")
    for folder, (total, reached, ways, taken) in sorted(folders.items()):
        share = f"{100 * taken / ways:.1f} %" if ways else ""
        print(f"| {folder} | {total} | {100 * reached / total:.1f} % | {ways} | {share} |")
    print()
    for name, counts in sorted(lines.items()):
        missed = {number for number, count in counts.items() if count == 0}
        half = {key[0] for key, count in branches[name].items() if count == 0} - missed
        if missed or half:
            print(f"{name}: lines {ranges(missed) or 'none'}; conditions of {ranges(half) or 'none'}")


if __name__ == "__main__":
    main()
