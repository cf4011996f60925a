"""Builds the extension by the project's own CMake, which also says the version.

    pip install --no-build-isolation ./api/python
"""

import re
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parents[2]
VERSION = re.search(r"VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
# What text() and import(decimate =) need, beside the extension.
MODULES = ["lamina_text", "lamina_decimate"]


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        build = Path(self.build_temp).resolve()
        package = Path(self.get_ext_fullpath(extension.name)).resolve().parent
        for words in [
            ["-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
             "-DBUILD_TESTING=OFF", f"-DPython3_EXECUTABLE={sys.executable}",
             "-DLAMINA_PYTHON_FOLDER=."],
            ["--build", build, "--target", "lamina_python",
             *(f"{module}_module" for module in MODULES)],
            ["--install", build, "--component", "python",
             "--prefix", package.parent],
        ]:
            subprocess.run(["cmake", *map(str, words)], check=True)
        for module in MODULES:
            self.copy_file(str(build / f"{module}.so"), str(package))


setup(
    version=VERSION,
    packages=["lamina"],
    package_data={"lamina": ["py.typed", "*.pyi"]},
    ext_modules=[Extension("lamina._lamina", sources=[])],
    cmdclass={"build_ext": CMakeBuild},
)
