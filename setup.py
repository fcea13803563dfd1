"""`pip install --no-build-isolation .`: has CMake build the module, in build/python or the folder that TYNDALL_BUILD names."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent


def version() -> str:
    """CMakeLists.txt has the one version."""
    return re.search(r"project\(Tyndall VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)


class CMakeBuild(build_ext):
    """The module comes from the target `python`."""

    def build_extension(self, ext: Extension) -> None:
        folder = Path(os.environ.get("TYNDALL_BUILD", ROOT / "build" / "python"))
        if not (folder / "CMakeCache.txt").exists():
            subprocess.run(["cmake", "-S", str(ROOT), "-B", str(folder), "-DCMAKE_BUILD_TYPE=Release", "-DTYNDALL_PYTHON=ON",
                            "-DTYNDALL_TESTS=OFF", f"-DPython_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", str(folder), "--target", "python", "--parallel", str(os.cpu_count() or 1)],
                       check=True)
        target = Path(self.get_ext_fullpath(ext.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(folder / "python" / "tyndall" / target.name, target)


setup(version=version(), ext_modules=[Extension("tyndall._core", sources=[])], cmdclass={"build_ext": CMakeBuild})
