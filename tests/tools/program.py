"""Runs the program for the tests in this folder: text and exit code, nothing else."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = None
SOURCES = None

SMALL_GRID = """title = "small"
plant = "dipdt"
n = 0
horizon = 40

[parameters]
kappa = { from = 0.08, to = 0.24, step = 0.08 }
delta = [0.4, 0.55, 0.7]
tau_i = [8, 14, inf]
"""


class Result:
    def __init__(self, completed):
        self.code = completed.returncode
        self.out = completed.stdout
        self.err = completed.stderr

    @property
    def json(self):
        return json.loads(self.out)


class ProgramTest(unittest.TestCase):
    """A test with a folder of its own, in which the program runs."""

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self._folder.name)

    def tearDown(self):
        self._folder.cleanup()

    def run_program(self, *arguments, **options):
        return Result(subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, text=True, capture_output=True,
                                     timeout=300, **options))

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def small_portrait(self, name="small.h5"):
        self.write("small.toml", SMALL_GRID)
        result = self.run_program("sweep", "small.toml", "-o", name, "--quiet", "--force")
        self.assertEqual((result.code, result.err), (0, ""))
        return name

    def assert_fails(self, result, code, message):
        """The whole of stderr but for the hint at --help, and nothing on stdout."""
        text = result.err.replace("\nTry portrait --help, or portrait VERB --help.", "")
        self.assertEqual(text, f"portrait: {message}\n")
        self.assertEqual(result.code, code)
        self.assertEqual(result.out, "")


def main():
    global PROGRAM, SOURCES
    PROGRAM, SOURCES = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2])
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[3:]], module="__main__")
