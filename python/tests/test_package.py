"""docs/python.md is right: building the wheel, installing it, and using it in an empty folder."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from importlib.util import find_spec
from pathlib import Path

from support import SOURCE


def section():
    """Returns the page's section on installing."""
    text = (SOURCE / "docs" / "python.md").read_text(encoding="utf-8")
    return re.search(r"^## Installing\n(.*?)^## ", text, re.DOTALL | re.MULTILINE)[1]


MISSING = [name for name in ("pip", "setuptools", "wheel", "ensurepip") if not find_spec(name)]


@unittest.skipIf("LD_PRELOAD" in os.environ, "a sanitizer has nothing to gain")
@unittest.skipIf(MISSING, f"SKIPPED: without {', '.join(MISSING)} no wheel is made (scripts/prepare --python)")
class Package(unittest.TestCase):
    def test_installs_and_runs_as_the_page_says(self):
        commands = re.findall(r"^    (.*)$", section(), re.MULTILINE)
        code = re.search(r"```python\n(.*?)```", section(), re.DOTALL)[1]
        with tempfile.TemporaryDirectory() as name:
            project, empty = Path(name) / "project", Path(name) / "empty"
            empty.mkdir()
            shutil.copytree(SOURCE / "python", project / "python", ignore=shutil.ignore_patterns("build", "*.egg-info"))
            for name in ("include", "LICENSE", "packaging"):
                (project / name).symlink_to(SOURCE / name)
            environment = {
                "PATH": f"{Path(sys.executable).parent}:/usr/bin:/bin",
                "HOME": name,
                "RELIEVO_BUILD": str(Path(os.environ["PYTHONPATH"].split(":")[0]).resolve().parent),
            }
            for command in commands:
                if command.startswith("scripts/prepare"):
                    continue
                done = subprocess.run(command, shell=True, cwd=project, env=environment, capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout}{done.stderr}")
            (wheel,) = (project / "dist").glob("relievo-*.whl")
            self.assertLess(wheel.stat().st_size, 5e6)
            done = subprocess.run([project / "env" / "bin" / "python", "-c", code], cwd=empty, env=environment, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            for output in re.findall(r'"([\w-]+\.(?:ply|stl|png|json|tif))"', code):
                self.assertGreater((empty / output).stat().st_size, 0, output)
            print(f"wheel: {wheel.name}, {wheel.stat().st_size / 1e6:.2f} MB")
