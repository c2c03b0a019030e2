#!/usr/bin/env python3
"""Round trips through programs that are too large for ./run test: YADE.

Exports the fits named below, runs the program at eight velocities each, compares e with `recoil
simulate`, and writes the result between the engines' marks of docs/export.md. Exit status 1 when a
program is missing or an answer is further off than its export states; the page stays as it was.
"""
import datetime
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
RECOIL = ROOT / "build/release/recoil"
PAGE = ROOT / "docs/export.md"
DIAMETER = "4.9"
FIT = """dataset = "{dataset}"
[model]
adhesion = "{law}"
adhesion_damping_phase = "{phase}"
[parameters]
C_A = {{ initial = {c_a}, free = false }}
"""
# law, phase, C_A [s/m], more options, allowed |delta e| (none: what the export states)
CASES = [
    ("ring", "rebound", 0.03, [], 1e-4),
    ("jkr", "rebound", 0.03, [], 1e-4),
    ("dmt", "both", 0.15, [], 1e-4),
    ("ring", "rebound", 0.03, ["--stock"], None),
]


def run(*words, folder):
    """stdout of a command; ends the program when it fails."""
    done = subprocess.run(words, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"engines: {' '.join(map(str, words))}: {done.stdout[-500:]}{done.stderr[-500:]}")
    return done.stdout


def number(pattern, text):
    found = re.findall(pattern, text, re.MULTILINE)
    if not found:
        sys.exit(f"engines: nothing like '{pattern}' in:\n{text[-500:]}")
    return float(found[-1])


def trip(case, folder):
    """(largest |delta e|, what is allowed, were captures the same) of one case."""
    law, phase, c_a, more, allowed = case
    dataset = ROOT / "datasets/wall1990-molybdenum"
    (folder / "fit.toml").write_text(FIT.format(dataset=os.path.relpath(dataset, folder), law=law,
                                                phase=phase, c_a=c_a))
    run(RECOIL, "fit", "fit.toml", "--replicates", "0", "--out", "fitted", folder=folder)
    values = ["--parameters", "fitted/fit.json", "--diameter", DIAMETER]
    said = run(RECOIL, "export", "fit.toml", *values, "--to", "yade", "--velocity", "0.6,100",
               "--out", "out", *more, folder=folder)
    said = " ".join(said.split())
    capture = number(r"V\* = ([\d.]+)", said)
    worst, captures_agree = 0.0, True
    for factor in (0.8, 1.1, 1.3, 2.0, 4.0, 10.0, 30.0, 70.0):
        v = f"{factor * capture:.6g}"
        answer = run(RECOIL, "simulate", "fit.toml", *values, "--velocity", v, folder=folder)
        e = 0.0 if "outcome: captured" in answer else number(r"^restitution: ([\d.]+)", answer)
        there = number(r"^restitution ([\d.]+)",
                       run("yade", "-n", "-x", "out/impact.py", v, folder=folder))
        worst = max(worst, abs(there - e))
        captures_agree = captures_agree and (e == 0.0) == (there == 0.0)
    if allowed is None:
        allowed = number(r"the largest error is ([\d.]+)", said) + 2e-3
    return worst, allowed, captures_agree


def main():
    if not RECOIL.exists():
        sys.exit("engines: build/release/recoil is missing; ./run engines builds it")
    if shutil.which("yade") is None:
        sys.exit("engines: yade is not installed; ./run engines installs it")
    version = run("dpkg-query", "-W", "-f=${Version}", "yade", folder=ROOT)
    rows, failed = [], False
    for case in CASES:
        with tempfile.TemporaryDirectory() as folder:
            worst, allowed, captures = trip(case, pathlib.Path(folder))
        law, phase, _, more, _ = case
        good = worst <= allowed and (captures or "--stock" in more)
        failed = failed or not good
        what = "nearest stock model" if more else f"{law}, {phase}"
        rows.append(f"| yade {version} | {what} | {worst:.1e} | {allowed:.1e} | "
                    f"{'kept' if captures else 'lost'} |")
        print(rows[-1] + ("" if good else "  FAILED"))
    if failed:
        sys.exit(1)
    text = PAGE.read_text()
    begin, end = "<!-- engines: written by ./run engines -->\n", "<!-- end of the engines -->"
    table = ("| program | export | largest difference of e | allowed | capture |\n"
             "|---|---|---|---|---|\n" + "\n".join(rows) +
             "\n\nEight velocities from 0.8 to 70 V\\*, spheres of 4.9 um on molybdenum; "
             f"{datetime.date.today().isoformat()}.\n")
    head, rest = text.split(begin)
    PAGE.write_text(head + begin + table + end + rest.split(end)[1])
    return 0


if __name__ == "__main__":
    sys.exit(main())
