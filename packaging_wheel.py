#!/usr/bin/python3
"""packaging_wheel.py PACKAGE OUT: packs the built package (build/release/python/recoil) as a wheel in
OUT and prints its path. A wheel is a zip file of the package and a list of its files (PEP 427).
This one works with the running Python version and on machines with the same libraries."""

import base64
import hashlib
import re
import sys
import sysconfig
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent
MANY_YEARS_AGO = (1980, 1, 1, 0, 0, 0)  # fixed, so that the same package gives the same bytes


def version() -> str:
    found = re.search(r"project\(recoil VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())
    assert found, "CMakeLists.txt states no version"
    return found.group(1)


def metadata() -> str:
    return f"""Metadata-Version: 2.1
Name: recoil
Version: {version()}
Summary: Impact of microspheres with surfaces: estimation and uncertainty
License: GPL-3.0-or-later
Requires-Python: ==3.{sys.version_info.minor}.*
Requires-Dist: numpy
Provides-Extra: pandas
Requires-Dist: pandas; extra == "pandas"
Provides-Extra: pictures
Requires-Dist: matplotlib; extra == "pictures"
"""


def make_wheel(package: Path, out: Path) -> Path:
    python = f"cp3{sys.version_info.minor}"
    tag = f"{python}-{python}-{re.sub('[-.]', '_', sysconfig.get_platform())}"
    info = f"recoil-{version()}.dist-info"
    files = {f"recoil/{file.relative_to(package).as_posix()}": file.read_bytes()
             for file in sorted(package.rglob("*"))
             if file.is_file() and "__pycache__" not in file.parts}
    files[f"{info}/METADATA"] = metadata().encode()
    files[f"{info}/WHEEL"] = (
        f"Wheel-Version: 1.0\nGenerator: recoil\nRoot-Is-Purelib: false\nTag: {tag}\n").encode()
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    record = ""
    for name, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        record += f"{name},sha256={digest},{len(content)}\n"
    files[f"{info}/RECORD"] = (record + f"{info}/RECORD,,\n").encode()
    out.mkdir(parents=True, exist_ok=True)
    wheel = out / f"recoil-{version()}-{tag}.whl"
    beside = wheel.with_suffix(".part")
    with zipfile.ZipFile(beside, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            entry = zipfile.ZipInfo(name, MANY_YEARS_AGO)
            entry.external_attr = 0o644 << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, content)
    return beside.replace(wheel)


if __name__ == "__main__":
    print(make_wheel(Path(sys.argv[1]), Path(sys.argv[2])))
