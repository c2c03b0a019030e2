#!/usr/bin/env python3
"""Would the tests notice? Changes one thing in src at a time, builds, tests, and lists what survived.

A mutant is one random change of a source of src: a constant, a comparison, a sign, a connective. It is
compiled in a copy of the tree (build/mutants/tree) and put to the tests, those of its folder first,
then those of later folders; the first failing test kills it. A mutant that does not compile, or whose
object code is that of the original, is no mutant and another one is drawn.

To be affordable, only the changed source is compiled (its object is linked before the original, whose
functions it replaces), and only quick tests are run: all of the same folder, others as long as a budget
lasts. So the share that is killed is a lower bound. With --thorough a survivor is put to all tests that
take less than a minute.

Finished mutants are kept in build/mutants/SEED.jsonl, each with its source as it was: a stopped run goes
on where it was, and an edited source only loses its own.

    tests/mutation/mutate.py 100 1               what ./run mutate 100 1 runs
    tests/mutation/mutate.py 20 7 --only estimate/
    tests/mutation/mutate.py 100 1 --again       puts the survivors to the tests as they are now
"""

import argparse
import hashlib
import json
import math
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
WORK = HOME / "work"
SLOW, LONGEST = 60.0, 300.0  # seconds: of a test for --thorough; of measuring one program

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


def sites_of(source):
    """Every place of one source that can be changed: (offset, length, kind)."""
    text = blanked(source)
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
    """One change. Which one depends on the seed and on the text of its own source alone."""

    def __init__(self, path, text, site, rank):
        self.path, self.rank, (self.offset, length, number) = path, rank, site
        draw = random.Random(rank)
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


def digest(*parts):
    return hashlib.sha256("\0".join(str(p) for p in parts).encode()).hexdigest()


def mutants_of(texts, seed):
    """All of them in the order of their turn. A site is known by its line, not by its number, so that
    an edit elsewhere leaves it its turn."""
    turns = []
    for path, text in texts.items():
        seen = {}
        for site in sites_of(text):
            begin = text.rfind("\n", 0, site[0]) + 1
            line = text[begin:text.find("\n", site[0])].strip()
            place = (line, site[0] - begin, site[2])
            seen[place] = seen.get(place, 0) + 1
            turns.append((digest(seed, path.relative_to(ROOT), *place, seen[place]), path, site))
    for rank, path, site in sorted(turns):
        yield Mutant(path, texts[path], site, rank)


def run(command, seconds, **options):
    """Exit status of `command` ('timeout' when it takes longer) and what it printed."""
    options.setdefault("env", {**os.environ, "RC_PARAMS": "seed=20260101"})
    shell = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, text=True, errors="replace",
                             start_new_session=True, **options)
    try:
        said = shell.communicate(timeout=seconds)[0]
        return shell.returncode, said
    except subprocess.TimeoutExpired:
        os.killpg(shell.pid, 9)
        return "timeout", shell.communicate()[0]
    except KeyboardInterrupt:
        os.killpg(shell.pid, 9)
        raise


def copy_tree(tree):
    """The tracked files and the new ones, copied where they differ, so that little is rebuilt."""
    names = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, text=True,
                           stdout=subprocess.PIPE, check=True).stdout.splitlines()
    wanted = set(names)
    for folder in ("src", "tests"):
        for old in (tree / folder).rglob("*"):
            if old.is_file() and str(old.relative_to(tree)) not in wanted:
                old.unlink()
    for name in names:
        source, target = ROOT / name, tree / name
        if not source.is_file():
            continue
        if target.is_file() and target.read_bytes() == source.read_bytes():
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(source, target)
        os.utime(target)


class Build:
    """The tree as it is, built so that the object of one changed source can be put in its place."""

    def __init__(self, folder):
        self.folder = folder
        self.tree = HOME / "tree"
        if (folder / "CMakeCache.txt").is_file():
            cache = (folder / "CMakeCache.txt").read_text()
            self.tree = Path(re.search(r"CMAKE_HOME_DIRECTORY:INTERNAL=(.*)", cache)[1])
        if self.tree.resolve() == ROOT:
            sys.exit("mutate: that is a build of this tree; it has to be one of a copy")
        self.tree.mkdir(parents=True, exist_ok=True)
        self.put_back()
        copy_tree(self.tree)
        self.check(["cmake", "-S", str(self.tree), "-B", str(folder), "-G", "Ninja",
                    "-DCMAKE_BUILD_TYPE=Release", "-DBUILD_TESTING=ON", "-DCMAKE_UNITY_BUILD=ON",
                    "-DCMAKE_UNITY_BUILD_BATCH_SIZE=12",
                    f"-DCMAKE_PROJECT_INCLUDE={self.tree}/tests/mutation/replaceable.cmake"])
        self.programs = self.test_programs()
        self.check(["cmake", "--build", str(folder), "--target", "recoil", "recoil_study",
                    *(p.name for p in self.programs)])
        self.commands = {}
        for entry in json.loads((folder / "compile_commands.json").read_text()):
            output = re.search(r" -o (\S+)", entry["command"])[1]
            self.commands[output] = (entry["command"], Path(entry["file"]))
        order = (self.tree / "tests" / "CMakeLists.txt").read_text()
        self.stages = re.search(r"foreach\(stage ([^)]*)\)", order)[1].split()
        self.links, self.passed = {}, set()

    def check(self, command):
        status, said = run(command, 7200)
        if status != 0:
            sys.exit("mutate: the tree does not build as it is:\n" + said[-3000:])
        return said

    def ask_ninja(self, tool, *words):
        return self.check(["ninja", "-C", str(self.folder), "-t", tool, *words])

    def test_programs(self):
        """Every test program with its folder below tests."""
        said, found = self.ask_ninja("targets", "all"), {}
        for name in re.findall(r"^(tests/(\w+)/\w+_test): CXX_EXECUTABLE_LINKER", said, re.M):
            found[self.folder / name[0]] = name[1]
        return found

    def link(self, program):
        """The command that links a program, without what follows on it."""
        if program not in self.links:
            said = self.ask_ninja("commands", "-s", str(program.relative_to(self.folder)))
            self.links[program] = next(part for part in said.strip().splitlines()[-1].split(" && ")
                                       if " -o " in part)
        return self.links[program]

    def objects_of(self, path):
        """Which objects have this source or header: {object: alone}; a source that is compiled
        together with others can be compiled alone."""
        target = self.tree / path.relative_to(ROOT)
        if path.suffix == ".cpp":
            return [o for o, (_, file) in self.commands.items()
                    if file == target or (file.suffix == ".cxx" and
                                          f'#include "{target}"' in file.read_text())]
        found = []
        for block in self.ask_ninja("deps").split("\n\n"):
            name, _, rest = block.partition(":")
            if name in self.commands and str(target) in rest.split():
                found.append(name)
        return found

    def archive_of(self, name):
        """The archive that an object of src is in, '' when it is a program's own."""
        said = self.ask_ninja("query", name)
        archives = re.findall(r"^\s+(\S+\.a)$", said.partition("outputs:")[2], re.M)
        return archives[0] if archives else ""

    def compile(self, name, output, source=None, shadow=None):
        """Exit status of compiling what makes object `name`, from another source or with headers
        in `shadow` before the original ones."""
        command, file = self.commands[name]
        command = re.sub(r" -o \S+", f" -o {output}", command)
        if source:
            command = command.replace(f" -c {file}", f" -c {source}")
        if shadow:
            command = command.replace(" -I", f" -I{shadow} -I", 1)
        return run(command, 1800, shell=True, cwd=self.folder)[0]

    def fails_anyway(self, program, test):
        """Does a test fail in the tree as it is? Asked once of each that kills."""
        if test not in self.passed:
            self.put_back()
            if run([str(program), f"--gtest_filter={test}"], 600, cwd=program.parent)[0] != 0:
                return True
            self.passed.add(test)
        return False

    def put_back(self):
        for kept in self.folder.glob("*.original"):
            os.replace(kept, kept.with_suffix(""))

    def put_in_place(self, program, made):
        """The tests call this program by its path."""
        kept = program.with_name(program.name + ".original")
        os.link(program, kept)
        shutil.copy2(made, f"{program}.new")
        os.replace(f"{program}.new", program)


def tests_of(build, quick):
    """{program: {test: seconds}} of all tests. What is not known from an earlier run, of this program
    or of ctest, is measured."""
    costs, kept = build.folder / "Testing" / "Temporary" / "CTestCostData.txt", HOME / "times.json"
    by_ctest = {}
    if costs.is_file():
        by_ctest = dict((w[0], float(w[2])) for w in map(str.split, costs.read_text().splitlines())
                        if len(w) == 3)
    known = json.loads(kept.read_text()) if kept.is_file() else {}
    times = {}
    for program in build.programs:
        names, suite = [], ""
        for line in run([str(program), "--gtest_list_tests"], 60)[1].splitlines():
            words = line.split("#")[0].strip()
            if line.startswith(" "):
                names.append(suite + words)
            else:
                suite = words
        own = known.setdefault(program.name, {})
        own.update({n: by_ctest[n] for n in names if n not in own and by_ctest.get(n, 0.0) > quick})
        if unknown := [n for n in names if n not in own]:
            begin = time.time()
            said = run([str(program), "--gtest_filter=" + ":".join(unknown)], LONGEST,
                       cwd=program.parent)[1]
            measured = {t: float(ms) / 1000 for t, ms in
                        re.findall(r"^\[       OK \] (\S+) \((\d+) ms\)", said, re.M)}
            # What had no turn is slow, or stands behind what is.
            own.update({n: measured.get(n, LONGEST) for n in unknown})
            kept.write_text(json.dumps(known))
            print(f"  {program.name:24} {len(measured):4} tests, {time.time() - begin:5.1f} s", flush=True)
        times[program] = {n: own[n] for n in names}
    return times


def plan(build, times, stage, quick, budget):
    """[(program, tests, their seconds)] in the order in which they are run, and how many are left out:
    the quick tests of the folder, and of later folders the quickest that fit into the budget."""
    stages = build.stages
    sees = [p for p, folder in build.programs.items()
            if folder in (stage, "ground") or stage not in stages or folder not in stages or
            stages.index(folder) >= stages.index(stage)]
    chosen, spent, left_out = {}, 0.0, 0
    for seconds, test, program in sorted((s, t, p) for p in sees for t, s in times[p].items()):
        own = build.programs[program] == stage
        if seconds > quick or not own and spent + seconds > budget:
            left_out += 1
            continue
        spent += 0.0 if own else seconds
        chosen.setdefault(program, {})[test] = seconds
    order = sorted(chosen, key=lambda p: (build.programs[p] != stage, sum(chosen[p].values())))
    return [(program, chosen[program]) for program in order], left_out


def verdict_on(mutant, build, times, quick, budget):
    """Builds and tests one mutant: ('killed', by whom), ('survived', '') or ('none', why)."""
    stage = mutant.path.relative_to(ROOT / "src").parts[0]
    shutil.rmtree(WORK, ignore_errors=True)
    shadow = WORK / "headers"
    changed = shadow / mutant.path.relative_to(ROOT / "src")
    changed.parent.mkdir(parents=True)
    changed.write_text(mutant.text)
    own, put_first, archives = {}, {}, set()
    alone = mutant.path.suffix == ".cpp"
    names = build.objects_of(mutant.path)
    for name in (n for n in names if n.startswith("src/")):
        put_first[name] = WORK / f"{len(put_first)}.o"
        if build.compile(name, put_first[name], changed if alone else None,
                         None if alone else shadow) != 0:
            return "none", "does not compile"
        archives.add(build.archive_of(name) or name)

    def same_code():
        """What kills a mutant sees a difference; only for others it is worth compiling again."""
        plain = WORK / "plain.o"
        for name, made in put_first.items() if alone else ():
            build.compile(name, plain, build.tree / mutant.path.relative_to(ROOT))
            if stripped(made) != stripped(plain):
                return False
        return alone

    def linked(program):
        """The program with the mutant in it, None when it has no part of it."""
        command = build.link(program)
        words = [w for w in names if f" {w} " in command and not w.startswith("src/")]
        if not words and not any(f" {a}" in command for a in archives):
            return None
        for word in words:
            if word not in own:
                own[word] = WORK / f"own{len(own)}.o"
                build.compile(word, own[word], None, shadow)
            command = command.replace(f" {word} ", f" {own[word]} ")
        output = WORK / program.name
        first = " ".join(map(str, put_first.values()))
        command = re.sub(r" -o \S+", f" -o {output}", command)
        command = re.sub(r" (\S+\.o) ", lambda m: f" -Wl,-z,muldefs {first} {m[1]} ", command, count=1)
        status, said = run(command, 600, shell=True, cwd=build.folder)
        if status != 0:
            sys.exit(f"mutate: {program.name} does not link with {mutant.path}:\n{said[-2000:]}")
        return output

    try:
        commands = False
        for name in ("recoil", "recoil_study"):
            if made := linked(build.folder / name):
                build.put_in_place(build.folder / name, made)
                commands = True
        compared = False
        for program, tests in plan(build, times, stage, quick, budget)[0]:
            if build.programs[program] != stage and not compared:
                if same_code():
                    return "none", "the same object code"
                compared = True
            made = linked(program)
            if not made and not commands:
                continue
            status, said = run([str(made or program), "--gtest_brief=1", "--gtest_fail_fast",
                                "--gtest_filter=" + ":".join(tests)], 30 + 4 * sum(tests.values()),
                               cwd=program.parent)
            if status == "timeout":
                return "killed", f"{program.name}: does not end"
            if status != 0:
                failed = re.findall(r"\[  FAILED  \] ([^\s,]+)", said)
                if failed and build.fails_anyway(program, failed[0]):
                    sys.exit(f"mutate: {failed[0]} fails without a mutant")
                return "killed", failed[0] if failed else f"{program.name}: ends badly"
            if made:
                made.unlink()
        return ("survived", "") if compared or not same_code() else ("none", "the same object code")
    finally:
        build.put_back()


def stripped(path):
    """An object's code and data, without the name of its source."""
    run(["objcopy", "--strip-unneeded", "--remove-section=.comment", str(path), f"{path}.s"], 60)
    return Path(f"{path}.s").read_bytes()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("count", type=int, help="how many mutants")
    parser.add_argument("seed", type=int, nargs="?", default=1)
    parser.add_argument("--only", default="", help="files whose path contains this")
    parser.add_argument("--headers", action="store_true",
                        help="change headers too: minutes for one that many sources include")
    parser.add_argument("--quick", type=float, default=5.0, metavar="SECONDS",
                        help="run tests that take at most this (default: 5)")
    parser.add_argument("--budget", type=float, default=30.0, metavar="SECONDS",
                        help="of tests of other folders (default: 30)")
    parser.add_argument("--thorough", action="store_true", help="slower tests for what survives")
    parser.add_argument("--again", action="store_true", help="try the survivors of earlier runs again")
    parser.add_argument("--build", type=Path, default=HOME / "tree" / "build" / "mutants",
                        help="another build to use, of a copy of this tree that may be overwritten")
    options = parser.parse_args()
    WORK.mkdir(parents=True, exist_ok=True)
    files = sorted(p for p in (ROOT / "src").rglob("*.[ch]pp" if options.headers else "*.cpp")
                   if options.only in str(p))
    if not files:
        sys.exit(f"mutate: no source has '{options.only}' in its path")
    print("Building and timing the tests as they are.", flush=True)
    build = Build(options.build.absolute())
    times = tests_of(build, options.quick)
    journal = HOME / f"{options.seed}.jsonl"
    finished = {}
    if journal.is_file():
        finished = {m["key"]: m for m in map(json.loads, journal.read_text().splitlines())}
    texts = {p: p.read_text() for p in files}  # they may be edited meanwhile
    counted = []
    for mutant in mutants_of(texts, options.seed):
        if len(counted) == options.count:
            break
        key = digest(mutant.rank, texts[mutant.path])
        entry = finished.get(key)
        if entry is None or entry["outcome"] == "survived" and (
                options.again or options.thorough and not entry["thorough"]):
            begin = time.time()
            outcome, by = verdict_on(mutant, build, times, options.quick, options.budget)
            thorough = options.thorough and outcome == "survived"
            if thorough:
                outcome, by = verdict_on(mutant, build, times, SLOW, math.inf)
            entry = {"key": key, "outcome": outcome, "by": by, "thorough": thorough,
                     "seconds": round(time.time() - begin, 1), **mutant.describe()}
            with journal.open("a") as out:
                out.write(json.dumps(entry) + "\n")
        if entry["outcome"] == "none":
            continue
        counted.append(entry)
        mark = "killed  " if entry["outcome"] == "killed" else "SURVIVED"
        print(f"{len(counted):4} {mark} {entry['seconds']:5.0f} s {mutant.path.relative_to(ROOT)}:"
              f"{mutant.line} ({mutant.kind}) {entry['by']}", flush=True)
    survivors = [m for m in counted if m["outcome"] == "survived"]
    print(f"\n{len(counted) - len(survivors)} of {len(counted)} mutants were killed (seed {options.seed}).")
    for m in survivors:
        limits = (SLOW, math.inf) if m["thorough"] else (options.quick, options.budget)
        left_out = plan(build, times, Path(m["file"]).parts[1], *limits)[1]
        print(f"\n{m['file']}:{m['line']} ({m['kind']}); {left_out} tests of this and later folders were "
              f"not run\n  - {m['before']}\n  + {m['after']}")
    print(f"\nEach survivor wants a test, or the removal of code that nothing needs. "
          f"Kept in {journal.relative_to(ROOT)}.")


if __name__ == "__main__":
    main()
