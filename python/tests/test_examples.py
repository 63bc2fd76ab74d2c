"""The examples, the notebook and the lines of docs/python.md run."""

import json
import os
import re
import subprocess
import sys
import unittest
from importlib.util import find_spec
from pathlib import Path
from unittest.mock import patch

from support import SOURCE, InFolder

EXAMPLES = SOURCE / "python" / "examples"


class Examples(InFolder):
    def test_run(self):
        for example in sorted(EXAMPLES.glob("*.py")):
            with self.subTest(example.name):
                done = subprocess.run([sys.executable, example, "scan.ply"], capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stderr)

    def test_of_the_page_run(self):
        page = (SOURCE / "docs" / "python.md").read_text(encoding="utf-8")
        lines = "\n".join(re.findall(r"```python\n(.*?)```", page, re.DOTALL))
        exec(compile(lines, "docs/python.md", "exec"), {"__name__": "page"})

    def test_of_figure_9_has_fifteen_lines(self):
        lines = (EXAMPLES / "figure_9.py").read_text(encoding="utf-8").splitlines()
        self.assertLessEqual(len([line for line in lines if line.strip() and not line.startswith(("#", '"""'))]), 15)

    @unittest.skipIf("LD_PRELOAD" in os.environ, "a sanitizer has nothing to gain")
    @unittest.skipUnless(find_spec("nbclient") and find_spec("ipykernel"), "SKIPPED: the notebook (python3-nbclient, python3-ipykernel)")
    def test_of_the_notebook_run(self):
        import nbclient
        import nbformat

        notebook = nbformat.read(EXAMPLES / "relief.ipynb", as_version=4)
        for cell in notebook.cells:
            self.assertEqual(cell.get("outputs", []), [], "the notebook is kept without outputs")
        # Registers a kernel that runs this Python, because the machine may have no kernel or a different one.
        kernel = Path("share/jupyter/kernels/this")
        kernel.mkdir(parents=True)
        command = [sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"]
        (kernel / "kernel.json").write_text(json.dumps({"argv": command, "display_name": "this", "language": "python"}))
        own = {"JUPYTER_PATH": "share/jupyter", "JUPYTER_RUNTIME_DIR": "runtime", "IPYTHONDIR": "ipython"}
        with patch.dict(os.environ, {name: str(Path(folder).resolve()) for name, folder in own.items()}):
            nbclient.NotebookClient(notebook, kernel_name="this", timeout=600, startup_timeout=600).execute()
        shown = [output for cell in notebook.cells for output in cell.get("outputs", []) if "image/png" in output.get("data", {})]
        self.assertGreaterEqual(len(shown), 2)
