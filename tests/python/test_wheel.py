"""The wheel holds the package and nothing else, and works where it is unpacked."""

import base64
import hashlib
import os
import runpy
import subprocess
import sys
import zipfile
from pathlib import Path

import recoil
from conftest import SOURCE

PACKAGE = Path(recoil.__file__).parent


def test_the_wheel_works_where_it_is_unpacked(tmp_path):
    make_wheel = runpy.run_path(str(SOURCE / "packaging_wheel.py"))["make_wheel"]
    wheel = make_wheel(PACKAGE, tmp_path / "out")
    again = make_wheel(PACKAGE, tmp_path / "again")
    assert wheel.read_bytes() == again.read_bytes()
    assert wheel.name.startswith(f"recoil-{recoil.__version__}-cp3")
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path / "there")
        names = set(archive.namelist())
    info = f"recoil-{recoil.__version__}.dist-info"
    listed = {}
    for line in (tmp_path / "there" / info / "RECORD").read_text().splitlines():
        name, digest, size = line.rsplit(",", 2)
        listed[name] = (digest, size)
    assert set(listed) == names
    for name, (digest, size) in listed.items():
        if name.endswith("RECORD"):
            continue
        content = (tmp_path / "there" / name).read_bytes()
        wanted = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        assert digest == f"sha256={wanted}" and int(size) == len(content), name
    assert {"recoil/py.typed", "recoil/_recoil.pyi", "recoil/schemas/fit.schema.json"} <= names
    code = "import recoil; print(recoil.__version__, recoil.__file__)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True,
                          cwd=tmp_path, env={**os.environ, "PYTHONPATH": str(tmp_path / "there")})
    assert done.stdout == f"{recoil.__version__} {tmp_path}/there/recoil/__init__.py\n"
