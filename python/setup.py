"""Builds the wheel. Its native module and its stub file come from CMake, as built by `cmake --build build/python
--target relievo_python_package`.

The environment variable RELIEVO_BUILD may name another build folder. If the folder has no build yet, one is configured.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

PROJECT = Path(__file__).resolve().parent.parent


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        folder = Path(os.environ.get("RELIEVO_BUILD", PROJECT / "build" / "python"))
        if not (folder / "CMakeCache.txt").exists():
            subprocess.run(
                ["cmake", "-S", PROJECT, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release"]
                + ["-DRELIEVO_PYTHON=ON", "-DRELIEVO_TESTS=OFF", "-DRELIEVO_BENCH=OFF"]
                + [f"-DPython_EXECUTABLE={sys.executable}"],
                check=True,
            )
        subprocess.run(["cmake", "--build", folder, "--target", "relievo_python_package"], check=True)
        module = Path(self.get_ext_fullpath(ext.name))
        for name in (module.name, "__init__.pyi"):
            self.copy_file(folder / "python" / "relievo" / name, module.parent / name)
        for licence in (PROJECT / "LICENSE", PROJECT / "packaging" / "copyright"):
            self.copy_file(licence, module.parent / licence.name)


def version():
    header = PROJECT / "include" / "relievo" / "core" / "version.h"
    return re.search(r'version\[\] = "([^"]+)"', header.read_text(encoding="utf-8"))[1]


setup(version=version(), ext_modules=[Extension("relievo._native", [])], cmdclass={"build_ext": CMakeBuild})
