"""The declared types are those of the package, and its docstrings are the comments of the library."""

import inspect
import os
import subprocess
import sys
import tempfile
import unittest
from importlib.util import find_spec
from pathlib import Path

import relievo
from support import SOURCE

PYTHON = SOURCE / "python"


@unittest.skipIf("LD_PRELOAD" in os.environ, "a sanitizer has nothing to gain")
class Types(unittest.TestCase):
    def run_module(self, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            environment = {**os.environ, "MYPYPATH": os.environ["PYTHONPATH"], "MYPY_CACHE_DIR": folder}
            done = subprocess.run([sys.executable, *arguments], capture_output=True, text=True, env=environment, cwd=folder)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    @unittest.skipUnless(find_spec("mypy"), "SKIPPED: mypy is not installed (python3-mypy)")
    def test_pass_stubtest(self):
        # Leaves out the private modules, because stubtest would even check the names that they import. Their sources
        # are checked instead.
        with tempfile.NamedTemporaryFile("w", suffix=".txt") as private:
            private.write("relievo\\._.*\n")
            private.flush()
            allowed = ("--allowlist", private.name, "--ignore-unused-allowlist")
            self.run_module("-m", "mypy.stubtest", "relievo", "--ignore-missing-stub", *allowed)

    @unittest.skipUnless(find_spec("mypy"), "SKIPPED: mypy is not installed (python3-mypy)")
    def test_of_examples_are_right(self):
        self.run_module("-m", "mypy", "--strict", *sorted((PYTHON / "examples").glob("*.py")))


class Docstrings(unittest.TestCase):
    def test_are_there_and_those_of_the_headers(self):
        for name in relievo.__all__:
            self.assertTrue(inspect.getdoc(getattr(relievo, name)), name)
        for name, header in [
            ("visible_points", "scan/visible.h"),
            ("mean_curvature", "scan/curvature.h"),
            ("estimate_normals", "scan/normals.h"),
            ("triangulate", "geometry/triangulation.h"),
            ("HeightSystem", "relief/heights.h"),
            ("sample", "samples/sample.h"),
        ]:
            comment = getattr(relievo, name).__doc__.split("\n\nIn Python: ")[0]
            lines = [f"// {line}".rstrip() for line in comment.splitlines()]
            text = (SOURCE / "include" / "relievo" / header).read_text(encoding="utf-8")
            self.assertIn("\n".join(lines), text, name)

    def test_name_every_option(self):
        keywords = list(inspect.signature(relievo.make).parameters)
        self.assertIn("rim_height_mm", keywords)
        for keyword in keywords[5:]:
            self.assertIn(f"    {keyword}: ", relievo.make.__doc__)
