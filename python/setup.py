"""Builds the programs with make DISPATCH=1 into pmpipe/libexec of the wheel; the rest is in pyproject.toml.

The sources are the tree beside this directory; an sdist has them in tree/. PMPIPE_WORDS=0 builds a wheel of Python alone;
PMPIPE_PROGRAMS=DIR takes programs that are built already; PMPIPE_MAKE=PORTABLE=1 builds for one level of instructions only.
SPDX-License-Identifier: GPL-3.0-or-later
"""
import os
import re
import shutil
import subprocess

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py
from setuptools.command.sdist import sdist

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:  # before setuptools 70
    from wheel.bdist_wheel import bdist_wheel

HERE = os.path.dirname(os.path.abspath(__file__))
PARTS = ("Makefile", "COPYING", "lib", "tools", "data", "packaging")  # what make needs


def tree():
    """The directory with the Makefile."""
    for path in (os.path.join(HERE, ".."), os.path.join(HERE, "tree")):
        if os.path.exists(os.path.join(path, "lib", "base", "base.h")):
            return os.path.abspath(path)
    raise SystemExit("pmpipe: neither .. nor tree/ holds the sources of the programs (build in the tree of pmpipe, or set PMPIPE_WORDS=0)")


def words():
    """Does the wheel hold the programs?"""
    return os.environ.get("PMPIPE_WORDS") != "0"


def version():
    """The version of the package, which a test compares with that of the programs."""
    with open(os.path.join(HERE, "pmpipe", "stage.py"), encoding="utf-8") as file:
        return re.search(r'^VERSION = "(.*)"', file.read(), re.M).group(1)


class Build(build_py):
    """make, and its programs into libexec."""

    def run(self):
        super().run()
        target = os.path.join(os.path.abspath(self.build_lib), "pmpipe", "libexec")
        shutil.rmtree(target, ignore_errors=True)
        if not words():
            return
        if os.environ.get("PMPIPE_PROGRAMS"):  # built already
            return self.take(os.environ["PMPIPE_PROGRAMS"], target)
        build = os.path.abspath(os.path.join(self.build_lib, "..", "words"))
        command = ["make", "-s", "-C", tree(), "-j%d" % (os.cpu_count() or 1), os.environ.get("PMPIPE_MAKE", "DISPATCH=1"), "B=" + build, "words"]
        if subprocess.call(command):
            raise SystemExit("pmpipe: the programs do not build (apt install gcc make libfftw3-dev libgsl-dev libjansson-dev libpng-dev libhdf5-dev "
                             "pkg-config, or set PMPIPE_WORDS=0 for a package without them)")
        self.take(os.path.join(build, "bin"), target)

    def take(self, source, target):
        """The programs without what debuggers need, nine tenths of them."""
        shutil.copytree(source, target)
        for name in os.listdir(target):
            with open(os.path.join(target, name), "rb") as file:
                elf = file.read(4) == b"\x7fELF"
            if elf and shutil.which("strip"):
                subprocess.call(["strip", os.path.join(target, name)])


class Wheel(bdist_wheel):
    """Programs are of one platform, but of no version of Python."""

    def finalize_options(self):
        super().finalize_options()
        self.root_is_pure = not words()

    def get_tag(self):
        python, abi, platform = super().get_tag()
        return ("py3", "none", platform if words() else "any")


class Source(sdist):
    """The package, with the sources of the programs in tree/."""

    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, files)
        for part in PARTS:
            source, target = os.path.join(tree(), part), os.path.join(base_dir, "tree", part)
            if os.path.isdir(source):
                shutil.copytree(source, target, dirs_exist_ok=True)
            else:
                os.makedirs(os.path.dirname(target), exist_ok=True)
                shutil.copy(source, target)


class Binary(Distribution):
    """So that the wheel is laid out for a platform."""

    def has_ext_modules(self):
        return words()


setup(version=version(), distclass=Binary, cmdclass={"build_py": Build, "bdist_wheel": Wheel, "sdist": Source})
