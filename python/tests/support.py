"""Gives the tests scans, the command line, and a folder for files."""

import os
import subprocess
import tempfile
import unittest
from functools import cache
from pathlib import Path

import relievo

SOURCE = Path(os.environ["RELIEVO_SOURCE"])


@cache
def scan():
    """Returns a small generated scan."""
    return relievo.sample("green_man", points=3000)


@cache
def still_life():
    """Returns a small generated scan of several objects."""
    return relievo.sample("still_life", points=3000)


def make(source, **options):
    """Makes a relief of few triangles."""
    return relievo.make(source, **{"resolution_mm": 0.5, **options})


class InFolder(unittest.TestCase):
    """Runs tests in a folder of their own, which contains scan.ply and other.ply."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        scan().save("scan.ply")
        still_life().save("other.ply")

    def command(self, *arguments):
        """Runs the command line, which must succeed."""
        subprocess.run([os.environ["RELIEVO"], *map(str, arguments)], check=True, capture_output=True, text=True)

    def refused(self, kind, function, *arguments, **options):
        """Returns the error that a call raises."""
        with self.assertRaises(relievo.Error) as caught:
            function(*arguments, **options)
        self.assertEqual(caught.exception.kind, kind)
        return caught.exception
