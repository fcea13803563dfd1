"""pip install in a venv; the stubs and the module name the same things."""

import ast
import os
import shutil
import subprocess
import sys

import tyndall
from tyndall import _core


def test_pip_installs_it_in_a_venv(tmp_path, checkout):
    """The build of this suite is taken, so that nothing is compiled again."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    source = tmp_path / "source"
    source.mkdir()
    for name in ("pyproject.toml", "setup.py", "CMakeLists.txt", "LICENSE"):
        shutil.copy(checkout / name, source)
    shutil.copytree(checkout / "python", source / "python")

    def run(*command):
        done = subprocess.run([*map(str, command)], cwd=tmp_path, env=environment, capture_output=True, text=True)
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    run(sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "venv")
    python = tmp_path / "venv" / "bin" / "python"
    run(python, "-m", "pip", "install", "--no-build-isolation", "--no-index", source)
    said = run(python, "-c", "import tyndall; print(tyndall.__file__, tyndall.Scene().resolution, tyndall.__version__)")
    assert said.startswith(str(tmp_path / "venv")) and said.endswith(f"(1280, 720) {tyndall.__version__}\n")
    installed = {p.name for p in (tmp_path / "venv").glob("lib/python*/site-packages/tyndall/*")}
    assert installed >= {"py.typed", "_core.pyi", "scene.py"}


def stub_names(checkout):
    tree = ast.parse((checkout / "python/tyndall/_core.pyi").read_text())
    functions = {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}
    classes = {node.name: {f.name for f in node.body if isinstance(f, ast.FunctionDef)} for node in tree.body
               if isinstance(node, ast.ClassDef)}
    return functions, classes


def test_the_stubs_name_what_there_is(checkout):
    functions, classes = stub_names(checkout)
    assert functions | classes.keys() == {name for name in dir(_core) if not name.startswith("__")}
    for name, methods in classes.items():
        there = {m for m in vars(getattr(_core, name)) if not m.startswith("_")}
        assert {m for m in methods if not m.startswith("_")} == there, name


def test_everything_public_is_documented():
    for name in tyndall.__all__:
        thing = getattr(tyndall, name)
        if thing.__module__ != "tyndall._core":
            assert thing.__doc__, name
