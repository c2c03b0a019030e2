"""The types that are stated: of the compiled part by name, of all by documentation."""

import ast
import inspect
import subprocess
import sys
from pathlib import Path

import recoil
from conftest import SOURCE
from recoil import _recoil

PACKAGE = Path(recoil.__file__).parent


def test_the_package_says_that_it_is_typed():
    assert (PACKAGE / "py.typed").exists()


def test_mypy_finds_nothing_in_its_strict_mode(tmp_path):
    package = SOURCE / "src/python/recoil"
    done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports",
                           "--cache-dir", str(tmp_path), str(package)],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_stub_has_the_names_of_the_module_and_no_other():
    stub = ast.parse((PACKAGE / "_recoil.pyi").read_text())
    stated, members = set(), {}
    for node in stub.body:
        if isinstance(node, ast.ClassDef):
            stated.add(node.name)
            members[node.name] = {f.name for f in node.body if isinstance(f, ast.FunctionDef)}
            members[node.name] |= {f.target.id for f in node.body if isinstance(f, ast.AnnAssign)}
        elif isinstance(node, ast.FunctionDef):
            stated.add(node.name)
    there = {name for name in dir(_recoil) if not name.startswith("_")}
    assert stated == there
    for name, stated_members in members.items():
        own = {m for m in vars(getattr(_recoil, name)) if not m.startswith("_")}
        assert stated_members - {"__init__"} == own, name


def test_arguments_of_the_stub_are_those_of_the_module():
    stub = ast.parse((PACKAGE / "_recoil.pyi").read_text())
    for node in stub.body:
        if isinstance(node, ast.FunctionDef):
            said = getattr(_recoil, node.name).__doc__ or ""
            for argument in node.args.args:
                assert argument.arg in said or "arg0" in said, f"{node.name}: {argument.arg}"


def test_everything_public_is_documented_and_typed():
    for name in recoil.__all__:
        thing = getattr(recoil, name)
        assert inspect.getdoc(thing), name
        functions = [(name, thing)] if inspect.isfunction(thing) else []
        if inspect.isclass(thing):
            for member, value in vars(thing).items():
                if isinstance(value, property):
                    value = value.fget
                if isinstance(value, (classmethod, staticmethod)):
                    value = value.__func__
                if inspect.isfunction(value) and not member.startswith("_"):
                    functions.append((f"{name}.{member}", value))
        for where, function in functions:
            assert inspect.getdoc(function), where
            signature = inspect.signature(function)
            assert signature.return_annotation is not signature.empty, where
            for argument in list(signature.parameters.values()):
                if argument.name not in ("self", "cls"):
                    assert argument.annotation is not argument.empty, f"{where}: {argument.name}"
