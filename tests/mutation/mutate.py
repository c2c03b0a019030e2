#!/usr/bin/env python3
"""Would the tests notice? Changes one thing in src at a time, builds, tests, and lists what survived.

A mutant is one random change of a source of src: a constant, a comparison, a sign, a connective. Every
mutant is compiled in a copy of the tree (build/mutants/tree) and put to the test programs, those that
mirror its folder first; the first failing test kills it. A mutant that does not compile, or whose
object code is that of the original, is no mutant and another one is drawn. Finished mutants are kept in
build/mutants/SEED.jsonl, so that a stopped run goes on where it was.

    tests/mutation/mutate.py 100 1          what ./run mutate 100 1 runs
    tests/mutation/mutate.py 20 7 --only estimate/
"""

import argparse
import hashlib
import json
import os
import random
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
HOME = ROOT / "build" / "mutants"
TREE = HOME / "tree"
BUILD = TREE / "build" / "mutants"

# (what it is, pattern, replacements). Binary operators have a blank on either side in formatted code,
# brackets of templates have none.
OPERATORS = [
    ("comparison", r"(?<= )<(?= )", ["<=", ">="]),
    ("comparison", r"(?<= )<=(?= )", ["<", ">"]),
    ("comparison", r"(?<= )>(?= )", [">=", "<="]),
    ("comparison", r"(?<= )>=(?= )", [">", "<"]),
    ("comparison", r"(?<= )==(?= )", ["!="]),
    ("comparison", r"(?<= )!=(?= )", ["=="]),
    ("sign", r"(?<= )\+(?= )", ["-"]),
    ("sign", r"(?<= )-(?= )", ["+"]),
    ("sign", r"(?<= )\*(?= )", ["/"]),
    ("sign", r"(?<= )/(?= )", ["*"]),
    ("sign", r"(?<= )\+=(?= )", ["-="]),
    ("sign", r"(?<= )-=(?= )", ["+="]),
    ("sign", r"(?<=[(,=] )-(?=[\w(])|(?<=\()-(?=[\w(])|(?<=return )-(?=[\w(])", [""]),
    ("connective", r"(?<= )&&(?= )", ["||"]),
    ("connective", r"(?<= )\|\|(?= )", ["&&"]),
    ("connective", r"\btrue\b", ["false"]),
    ("connective", r"\bfalse\b", ["true"]),
    ("connective", r"\bstd::min\b", ["std::max"]),
    ("connective", r"\bstd::max\b", ["std::min"]),
]
NUMBER = re.compile(r"(?<![\w.])(\d+\.\d*(?:[eE][-+]?\d+)?|\d+[eE][-+]?\d+|\d+)(?![\w.])")
# Nothing that runs depends on what stands here.
SILENT = re.compile(r"^\s*(#|static_assert|using |template|assert\()")


def blanked(text):
    """`text` with comments, strings and characters blanked, of the same length."""
    pattern = re.compile(
        r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<!\w)\'(?:\\.|[^\'\\\n])+\'', re.S)
    return pattern.sub(lambda m: re.sub(r"[^\n]", " ", m.group()), text)


def other_number(literal, draw):
    """A constant that differs: integers by one, others by a third or more."""
    if re.fullmatch(r"\d+", literal):
        value = int(literal)
        return str(value + 1 if value == 0 or draw.random() < 0.5 else value - 1)
    value = float(literal)
    if value == 0.0:
        return "1.0"
    return repr(value * draw.choice([0.5, 1.5, 2.0]))


def sites_of(path):
    """Every place of one file that can be changed: (offset, length, kind)."""
    text = blanked(path.read_text())
    silent, begin = [], 0
    for line in text.splitlines(keepends=True):
        if SILENT.match(line):
            silent.append((begin, begin + len(line)))
        begin += len(line)
    found = []
    for number, (kind, pattern, _) in enumerate(OPERATORS):
        found += [(m.start(), m.end() - m.start(), number) for m in re.finditer(pattern, text)]
    found += [(m.start(), m.end() - m.start(), -1) for m in NUMBER.finditer(text)]
    return sorted(s for s in found if not any(a <= s[0] < b for a, b in silent))


class Mutant:
    """One change, drawn from (seed, index): the same whichever run makes it."""

    def __init__(self, files, seed, index):
        draw = random.Random(f"{seed}/{index}")
        sites = [(path, site) for path in files for site in sites_of(path)]
        self.path, (self.offset, length, number) = draw.choice(sites)
        text = self.path.read_text()
        self.old = text[self.offset:self.offset + length]
        if number < 0:
            self.kind, self.new = "constant", other_number(self.old, draw)
        else:
            self.kind, self.new = OPERATORS[number][0], draw.choice(OPERATORS[number][2])
        self.text = text[:self.offset] + self.new + text[self.offset + length:]
        self.line = text.count("\n", 0, self.offset) + 1
        begin = text.rfind("\n", 0, self.offset) + 1
        end = text.find("\n", self.offset)
        self.before = text[begin:end].strip()
        self.after = (text[begin:self.offset] + self.new + text[self.offset + length:end]).strip()

    def describe(self):
        place = self.path.relative_to(ROOT)
        return {"file": str(place), "line": self.line, "kind": self.kind, "before": self.before,
                "after": self.after}


def run(command, seconds, **options):
    """Exit status of `command` ('timeout' when it takes longer) and what it printed."""
    try:
        done = subprocess.run(command, timeout=seconds, stdin=subprocess.DEVNULL, text=True,
                              errors="replace", stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              **options)
        return done.returncode, done.stdout
    except subprocess.TimeoutExpired as late:
        return "timeout", str(late.stdout or "")


def copy_tree():
    """The tracked files and the new ones, copied where they differ, so that little is rebuilt."""
    names = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, text=True,
                           stdout=subprocess.PIPE, check=True).stdout.splitlines()
    wanted = set(names)
    for old in TREE.rglob("*"):
        name = str(old.relative_to(TREE))
        if old.is_file() and not name.startswith("build/") and name not in wanted:
            old.unlink()
    for name in names:
        source, target = ROOT / name, TREE / name
        if not source.is_file():
            continue
        if target.is_file() and target.read_bytes() == source.read_bytes():
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(source, target)
        os.utime(target)


def ninja(*targets, seconds=1800):
    return run(["ninja", "-C", str(BUILD), *targets], seconds)


def test_programs():
    """Every test program with its folder below tests."""
    listing = json.loads(run(["ctest", "--test-dir", str(BUILD), "--show-only=json-v1"], 300)[1])
    programs = {}
    for test in listing["tests"]:
        if "command" not in test:
            continue
        program = Path(test["command"][0])
        if program.name.endswith("_test") and BUILD in program.parents:
            programs[program] = program.parent.relative_to(BUILD / "tests").parts[0]
    return programs


def prepare():
    """Builds the tree as it is; returns how long each program takes when nothing is wrong."""
    copy_tree()
    status, said = run(["cmake", "-S", str(TREE), "-B", str(BUILD), "-G", "Ninja",
                        "-DCMAKE_BUILD_TYPE=Release", "-DBUILD_TESTING=ON"], 600)
    if status == 0:
        status, said = ninja(seconds=7200)
    if status != 0:
        sys.exit("mutate: the tree does not build as it is:\n" + said[-3000:])
    kept, seconds = HOME / "times.json", {}
    key = hashlib.sha256(b"".join(p.read_bytes() for p in sorted(TREE.rglob("*.[ch]pp"))
                                  if "build" not in p.parts)).hexdigest()
    if kept.is_file() and (known := json.loads(kept.read_text()))["key"] == key:
        return {Path(p): s for p, s in known["seconds"].items()}
    for program in test_programs():
        begin = time.time()
        status, said = run([str(program), "--gtest_brief=1"], 3600)
        if status != 0:
            sys.exit(f"mutate: {program.name} fails without a mutant:\n" + said[-3000:])
        seconds[str(program)] = time.time() - begin
        print(f"  {program.name:32} {seconds[str(program)]:6.1f} s", flush=True)
    kept.write_text(json.dumps({"key": key, "seconds": seconds}))
    return {Path(p): s for p, s in seconds.items()}


def verdict_on(mutant, seconds, folders):
    """Builds and tests one mutant: ('killed', by whom), ('survived', '') or ('none', why)."""
    target = TREE / mutant.path.relative_to(ROOT)
    original = target.read_text()
    stage = mutant.path.relative_to(ROOT / "src").parts[0]
    before = {p: hashlib.sha256(p.read_bytes()).digest() for p in seconds}
    target.write_text(mutant.text)
    try:
        status, _ = ninja("recoil")
        if status != 0:
            return "none", "does not compile"
        changed = False
        for program in sorted(seconds, key=lambda p: (folders[p] != stage, seconds[p])):
            status, _ = ninja(str(program.relative_to(BUILD)))
            if status != 0:
                return "none", "does not compile"
            if hashlib.sha256(program.read_bytes()).digest() == before[program] and stage != "cli":
                continue  # it does not contain what was changed, or the compiler sees no difference
            changed = True
            limit = 60 + 5 * seconds[program]
            status, said = run([str(program), "--gtest_brief=1", "--gtest_fail_fast"], limit,
                               env={**os.environ, "RC_PARAMS": "seed=20260101"})
            if status == "timeout":
                return "killed", f"{program.name}: does not end"
            if status != 0:
                failed = re.findall(r"\[  FAILED  \] (\S+)", said)
                return "killed", failed[0].rstrip(",") if failed else f"{program.name}: ends badly"
        return ("survived", "") if changed else ("none", "the same program")
    finally:
        target.write_text(original)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("count", type=int, help="how many mutants")
    parser.add_argument("seed", type=int, nargs="?", default=1)
    parser.add_argument("--only", default="", help="files whose path contains this")
    options = parser.parse_args()
    HOME.mkdir(parents=True, exist_ok=True)
    TREE.mkdir(exist_ok=True)
    files = sorted(p for p in (ROOT / "src").rglob("*.[ch]pp") if options.only in str(p))
    if not files:
        sys.exit(f"mutate: no source has '{options.only}' in its path")
    print("Building and timing the tests as they are.", flush=True)
    seconds = prepare()
    folders = test_programs()
    stamp = hashlib.sha256(b"".join(p.read_bytes() for p in files)).hexdigest()[:12]
    journal = HOME / f"{options.seed}-{stamp}.jsonl"
    finished = {}
    if journal.is_file():
        finished = {m["index"]: m for m in map(json.loads, journal.read_text().splitlines())}
    counted, index = [], 0
    while len(counted) < options.count:
        index += 1
        if index not in finished:
            mutant = Mutant(files, options.seed, index)
            outcome, by = verdict_on(mutant, seconds, folders)
            finished[index] = {"index": index, "outcome": outcome, "by": by, **mutant.describe()}
            with journal.open("a") as out:
                out.write(json.dumps(finished[index]) + "\n")
        entry = finished[index]
        if entry["outcome"] == "none":
            continue
        counted.append(entry)
        mark = "killed  " if entry["outcome"] == "killed" else "SURVIVED"
        print(f"{len(counted):4} {mark} {entry['file']}:{entry['line']} ({entry['kind']}) {entry['by']}",
              flush=True)
    survivors = [m for m in counted if m["outcome"] == "survived"]
    print(f"\n{len(counted) - len(survivors)} of {len(counted)} mutants were killed (seed {options.seed}).")
    for m in survivors:
        print(f"\n{m['file']}:{m['line']} ({m['kind']})\n  - {m['before']}\n  + {m['after']}")
    print(f"\nEach survivor wants a test, or the removal of code that nothing needs. "
          f"Kept in {journal.relative_to(ROOT)}.")


if __name__ == "__main__":
    main()
