# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""Builds the engine of the Python package with CMake, as pip asks for it; pyproject.toml has the rest.

HOOKE_PIP_BUILD in the environment names a build folder to use again; HOOKE_PIP_JOBS, how many compilers run at once.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    """Builds hooke/_hooke.so and, beside it, the module that draws."""

    def build_extension(self, extension):
        build = pathlib.Path(os.environ.get("HOOKE_PIP_BUILD") or self.build_temp).resolve()
        jobs = os.environ.get("HOOKE_PIP_JOBS") or str(os.cpu_count())
        options = ["-DCMAKE_BUILD_TYPE=Release", f"-DPython_EXECUTABLE={sys.executable}", "-DHOOKE_BUILD_PYTHON=ON",
                   "-DHOOKE_BUILD_APPS=OFF", "-DHOOKE_BUILD_TESTS=OFF", "-DHOOKE_BUILD_BENCH=OFF"]
        for tool in ("cmake", "ninja"):
            if shutil.which(tool) is None:
                sys.exit(f"hooke: {tool} is needed to build it (Debian: cmake, ninja-build)")
        subprocess.run(["cmake", "-G", "Ninja", "-S", ROOT, "-B", build, *options], check=True)
        targets = subprocess.run(["cmake", "--build", build, "--target", "help"], check=True, capture_output=True, text=True)
        if "hooke_python:" not in targets.stdout:
            sys.exit(f"hooke: pybind11 2.10 or newer, or the headers of Python, are not found for {sys.executable} "
                     "(Debian: pybind11-dev, python3-dev)")
        subprocess.run(["cmake", "--build", build, "--target", "hooke_python", "-j", jobs], check=True)
        target = pathlib.Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        suffix = sysconfig.get_config_var("EXT_SUFFIX")  # a folder used again may hold modules of other versions
        shutil.copy2(build / "python" / "hooke" / f"_hooke{suffix}", target)
        for module in ("hooke-gl.so", "hooke-cuda.so"):
            if (build / module).exists():  # else the package has no pictures, or takes no GPU
                shutil.copy2(build / module, target.parent)


version = re.search(r"project\(hooke VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")).group(1)
setup(version=version, ext_modules=[Extension("hooke._hooke", sources=[])], cmdclass={"build_ext": CMakeBuild})
