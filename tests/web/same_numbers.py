#!/usr/bin/env python3
"""Compares what build/web/recoil.html computes in headless Chromium, opened from the disk, with the
program: every shipped fit with 199 replicates, one diagnosis, and one import of each format. Writes
reports/web.md, which lists every number that differs by more than 1e-9. Exit status 1 if a parameter, an
error or an interval does, if another number differs by more than 1e-5, if words differ, or if the page
makes a request.

usage: same_numbers.py [FIT...]      (default: every shipped fit)
"""

import ctypes
import io
import itertools
import json
import math
import pathlib
import random
import re
import struct
import subprocess
import sys
import tempfile
import time
import wave
import zipfile

root = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(root / "tests/web"))
from tab import PAGE, Tab, chromium  # noqa: E402

PROGRAM = root / "build/release/recoil"
SAME = 1e-9
CLOSE = 1e-5  # of what is not a parameter, an error or an interval
# Numbers that say how a search went, when, or with what.
ASIDE = ("seconds", "evaluations", "iterations", "threads", "starts", "version", "timing", "curve")

BALL = ["--ball", "table-tennis"]


def bouncing():
    """A film of a ball that falls 0.5 m and bounces with e = 0.9, 100 frames in a second."""
    rows, start, speed, height = ["t,h"], 0.0, 0.0, 0.5
    for k in range(240):
        t = 0.01 * k
        h = height + speed * (t - start) - 4.903 * (t - start) ** 2
        if h < 0.0:
            speed_at = math.sqrt(speed ** 2 + 2 * 9.806 * height)
            start += (speed + speed_at) / 9.806
            speed, height = 0.9 * speed_at, 0.0
            h = speed * (t - start) - 4.903 * (t - start) ** 2
        rows.append(f"{t:.2f},{h:.4f}")
    return "\n".join(rows) + "\n"


def sound():
    """The sound of six bounces with e = 0.9 in a quiet room, the first after 0.1 s, as a WAV file."""
    rate, at, wait = 16000, 0.1, 0.5
    noise = random.Random(1)
    samples = [noise.gauss(0.0, 0.003) for _ in range(3 * rate)]
    for _ in range(6):
        for k in range(400):
            samples[int(at * rate) + k] += math.exp(-k / 60) * math.sin(0.9 * k)
        at, wait = at + wait, 0.9 * wait
    file = io.BytesIO()
    with wave.open(file, "wb") as out:
        out.setparams((1, 2, rate, len(samples), "NONE", ""))
        out.writeframes(b"".join(struct.pack("<h", int(20000 * s)) for s in samples))
    return file.getvalue()


def as_format(wav, major, minor):
    """A WAV file as libsndfile writes it in another format (SF_FORMAT_...)."""
    class Info(ctypes.Structure):
        _fields_ = [("frames", ctypes.c_int64), *((n, ctypes.c_int) for n in ("rate", "channels", "format", "a", "b"))]
    lib = ctypes.CDLL("libsndfile.so.1")
    lib.sf_open.restype = ctypes.c_void_p
    with wave.open(io.BytesIO(wav)) as read, tempfile.NamedTemporaryFile() as file:
        count = read.getnframes()
        info = Info(0, read.getframerate(), 1, major | minor, 0, 0)
        opened = ctypes.c_void_p(lib.sf_open(file.name.encode(), 0x20, ctypes.byref(info)))
        lib.sf_writef_short(opened, read.readframes(count), ctypes.c_int64(count))
        lib.sf_close(opened)
        return pathlib.Path(file.name).read_bytes()


def workbook():
    """Drop and rebound heights as an Excel workbook."""
    rows = [("drop_height (cm)", "rebound_height (cm)"), (30, 24), (60, 47), (90, 69)]
    cells = "".join("<row>" + "".join(
        f'<c t="inlineStr"><is><t>{c}</t></is></c>' if isinstance(c, str) else f"<c><v>{c}</v></c>"
        for c in row) + "</row>" for row in rows)
    main = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
    office = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
    package = "http://schemas.openxmlformats.org/package/2006/relationships"
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as out:
        out.writestr("_rels/.rels", f'<Relationships xmlns="{package}"><Relationship Id="r1" Type="{office}/officeDocument" '
                                    'Target="xl/workbook.xml"/></Relationships>')
        out.writestr("xl/workbook.xml", f'<workbook xmlns="{main}" xmlns:r="{office}"><sheets>'
                                        '<sheet name="drops" sheetId="1" r:id="r1"/></sheets></workbook>')
        out.writestr("xl/_rels/workbook.xml.rels", f'<Relationships xmlns="{package}"><Relationship Id="r1" '
                                                   f'Type="{office}/worksheet" Target="worksheets/sheet1.xml"/></Relationships>')
        out.writestr("xl/worksheets/sheet1.xml", f'<worksheet xmlns="{main}"><sheetData>{cells}</sheetData></worksheet>')
    return file.getvalue()


IMPORTS = {
    "csv": ("V;e\n2,0;0,5\n3,1;0,62\n4,2;0,70\n6,0;0,75\n9,5;0,78\n", ["import", "--into", "mine", "--map",
            "incident_velocity=V:m/s,restitution=e", "--diameter", "4.9um", "--particle", "polystyrene",
            "--surface", "molybdenum", "--provenance", "measured"]),
    "heights": ("h0,h1\n30,24\n30,23.8\n60,47\n60,46.5\n90,69\n",
                ["bounce", "--map", "drop_height=h0:cm,rebound_height=h1:cm", *BALL]),
    "intervals": ("t\n0.45\n0.41\n0.372\n0.338\n0.307\n", ["bounce", "--map", "interval=t:s", *BALL]),
    "tops": ("h\n60\n47\n37\n29\n", ["bounce", "--map", "top=h:cm", *BALL]),
    "rest": ("h,t\n30,5.1\n30,5.0\n60,7.2\n", ["bounce", "--map", "drop_height=h:cm,rest_time=t:s", *BALL]),
    "blocks": ("n,t\n5,2.1\n5,1.4\n5,0.9\n", ["bounce", "--map", "bounces=n,block_time=t:s", *BALL]),
    "track": (bouncing(), ["bounce", "--map", "time=t:s,height=h:m", *BALL]),
    "recording": (sound(), ["bounce", *BALL]),
    "recording, FLAC": (as_format(sound(), 0x170000, 0x2), ["bounce", "--format", "recording", *BALL]),
    "recording, Ogg Vorbis": (as_format(sound(), 0x200000, 0x60), ["bounce", "--format", "recording", *BALL]),
    "workbook": (workbook(), ["bounce", "--format", "heights", *BALL]),
    "webplotdigitizer": ("a,\nX,Y\n2,0.5\n3,0.62\n4,0.7\n6,0.75\n", ["import", "--into", "mine", "--diameter",
                         "4.9um", "--particle", "polystyrene", "--surface", "molybdenum"]),
}


def numbers(node, path=""):
    """Every number, word and truth value of a JSON tree with its path."""
    if isinstance(node, dict):
        for key, inner in node.items():
            yield from numbers(inner, f"{path}.{key}" if path else key)
    elif isinstance(node, list):
        for i, inner in enumerate(node):
            yield from numbers(inner, f"{path}[{i}]")
    else:
        yield path, node


def scale_of(path, tree):
    """What a difference of the number at `path` is compared with: the whole that it is a part of, or itself."""
    if path.endswith("largest_difference"):
        return 1.0  # a difference of two e
    budget = re.match(r"(.*\.budget)\[\d+\]\.(sd|share)$", path)
    if budget and budget[2] == "share":
        return 1.0
    if budget:
        return math.sqrt(sum(v ** 2 for k, v in tree.items() if k.startswith(budget[1] + "[") and k.endswith(".sd")))
    return abs(tree[path])


def differences(native, tab):
    """(count of numbers, largest relative difference, [(path, native, tab) that differ], are they too different?)."""
    one, other = dict(numbers(native)), dict(numbers(tab))
    wrong, largest, count, failed = [], 0.0, 0, False
    for path in sorted(one.keys() | other.keys()):
        if any(word in path for word in ASIDE):
            continue
        a, b = one.get(path), other.get(path)
        if isinstance(a, float) and isinstance(b, (int, float)):
            count += 1
            scale = max(scale_of(path, one), scale_of(path, other))
            by = abs(a - b) / scale if scale > 0 and math.isfinite(scale) else 0.0
            largest = max(largest, by)
            if by > SAME:
                wrong.append((path, a, b))
                failed = failed or by > (SAME if path.startswith(("parameters", "derived")) else CLOSE)
        elif a != b:
            wrong.append((path, a, b))
            failed = True
    return count, largest, wrong, failed


def native(files, args):
    """The same by the program."""
    with tempfile.TemporaryDirectory() as folder:
        for path, content in files.items():
            target = pathlib.Path(folder, path)
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(content)
        begin = time.time()
        done = subprocess.run([str(PROGRAM), *args], cwd=folder, capture_output=True, text=True)
        seconds = time.time() - begin
        written = {str(path.relative_to(folder)): path.read_bytes()
                   for path in pathlib.Path(folder).rglob("*") if path.is_file()}
        return {"status": done.returncode, "out": done.stdout.rstrip("\n"), "seconds": seconds, "files": written}


def compared(name, tab, files, args, result, rows, listed):
    """Adds the row of one command: of the JSON file `result`, or of what is printed without one. True if it holds."""
    one, other = native(files, args), tab.run(files, args)
    same_words = one["status"] == other["status"] and (bool(result) or one["out"] == other["out"].rstrip("\n"))
    count, largest, wrong, failed = 0, 0.0, [], not same_words
    if result:
        count, largest, wrong, failed = differences(*(json.loads(r["files"].get(result, b"null")) for r in (one, other)))
    if not same_words:
        lines = next((pair for pair in itertools.zip_longest(one["out"].split("\n"), other["out"].split("\n"))
                      if pair[0] != pair[1]), ("", ""))
        wrong.append(("status or words", f"{one['status']} {lines[0]}", f"{other['status']} {lines[1]} {other['err'][:300]}"))
    rows.append((name, count, largest, len(wrong), one["seconds"], other["seconds"]))
    listed += [(name, *each) for each in wrong]
    print(f"{name}: {count} numbers, largest difference {largest:.1e}, {len(wrong)} differ; "
          f"{one['seconds']:.1f} s, in the tab {other['seconds']:.1f} s", flush=True)
    return not failed


def main():
    tab = Tab()
    rows, listed = [], []
    fits = sys.argv[1:] or [fit.stem for fit in sorted((root / "fits").glob("*.toml"))]

    def of_fit(name):
        paths = [root / f"fits/{name}.toml", *(path for path in (root / "datasets").glob("*/*") if path.is_file())]
        return {str(path.relative_to(root)): path.read_bytes() for path in paths}
    holds = [compared(name, tab, of_fit(name),
                      ["fit", f"fits/{name}.toml", "--out", "out", "--replicates", "199", "--threads", "1"],
                      "out/fit.json", rows, listed) for name in fits]
    holds.append(compared("diagnosis of " + fits[-1], tab, of_fit(fits[-1]),
                          ["diagnose", f"fits/{fits[-1]}.toml", "--out", "out", "--threads", "1"],
                          "out/diagnosis.json", rows, listed))
    for name, (content, args) in IMPORTS.items():
        how = [] if "--format" in args else ["--format", name]
        files = {"a.csv": content if isinstance(content, bytes) else content.encode()}
        holds.append(compared("import of " + name, tab, files, [args[0], "a.csv", *how, *args[1:]], "", rows, listed))
    requests = chromium.complaints_in(tab.browser.events, PAGE.resolve().as_uri())
    tab.browser.close()
    lines = ["# recoil in the browser: the same numbers", "",
             "Made by `./run web --check`: build/web/recoil.html in headless Chromium, opened from the disk, beside the",
             "program. A number differs if it does so by more than 1e-9.", "",
             "| command | numbers | largest relative difference | differ | program [s] | tab [s] |", "|---|---|---|---|---|---|"]
    lines += [f"| {n} | {c} | {l:.1e} | {w} | {s:.2f} | {t:.2f} |" for n, c, l, w, s, t in rows]
    lines += ["", f"What the browser said about the page: {'; '.join(sorted(set(requests))) or 'nothing; it made no request'}.", ""]
    if listed:
        lines += ["| command | what differs | program | tab |", "|---|---|---|---|"]
        lines += [f"| {n} | `{p}` | {str(a)[:60]} | {str(b)[:60]} |".replace("\n", " ") for n, p, a, b in listed[:200]]
    (root / "reports/web.md").write_text("\n".join(lines).rstrip("\n") + "\n")
    return 0 if all(holds) and not requests else 1


if __name__ == "__main__":
    sys.exit(main())
