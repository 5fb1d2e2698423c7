"""Every script in examples/ says what `portrait query` says.

usage: examples_test.py PORTRAIT SOURCES
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PORTRAIT = SOURCES = None
PYTHON = "/usr/bin/python3"  # Debian's, which has the packages
GRID = """title = "an example"
plant = "dipdt"
n = 0
horizon = 60

[parameters]
kappa = { from = 0.08, to = 0.24, step = 0.04 }
delta = [0.4, 0.55, 0.7]
tau_i = [8, 10, 14, inf]
"""


def missing_in_octave():
    if shutil.which("octave-cli") is None:
        return "octave is not there"
    done = subprocess.run(["octave-cli", "--eval", "pkg load netcdf"], capture_output=True, check=False)
    return None if done.returncode == 0 else "octave has no package netcdf"


def has_module(name):
    return subprocess.run([PYTHON, "-c", f"import {name}"], capture_output=True, check=False).returncode == 0


class Examples(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls._folder = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls._folder.name)
        (cls.folder / "g.toml").write_text(GRID)
        subprocess.run([PORTRAIT, "sweep", "g.toml", "-o", "p.h5", "--quiet"], cwd=cls.folder, check=True)
        answer = json.loads(subprocess.run([PORTRAIT, "query", "p.h5", "--minimize", "IAE_w + IAE_d", "--where", "Ms <= 2", "--json"],
                                           cwd=cls.folder, check=True, capture_output=True, text=True).stdout)
        optimum = answer["optimum"]
        best = optimum["measures"]["IAE_w"] + optimum["measures"]["IAE_d"]
        cls.expected = f"{best:.6g} " + " ".join(f"{name}={optimum['settings'][name]:g}" for name in ("kappa", "delta", "tau_i"))
        cls.few = answer["admissible"] < answer["total"]

    @classmethod
    def tearDownClass(cls):
        cls._folder.cleanup()

    def said(self, *words):
        done = subprocess.run([str(word) for word in words], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.strip()

    def test_the_question_is_one(self):
        self.assertTrue(self.few)
        self.assertNotIn("kappa=0.24 ", self.expected)  # the best without the bound

    def test_xarray(self):
        self.assertEqual(self.said(PYTHON, SOURCES / "examples/with_xarray.py", "p.h5"), self.expected)

    def test_xarray_with_a_picture(self):
        if not has_module("matplotlib"):
            self.skipTest("matplotlib is not there")
        self.said(PYTHON, SOURCES / "examples/with_xarray.py", "p.h5", "map.png")
        self.assertEqual((self.folder / "map.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_h5py(self):
        self.assertEqual(self.said(PYTHON, SOURCES / "examples/with_h5py.py", "p.h5"), self.expected)

    def test_octave(self):
        if (missing := missing_in_octave()) is not None:
            self.skipTest(missing)
        self.assertEqual(self.said("octave-cli", SOURCES / "examples/with_octave.m", "p.h5"), self.expected)


if __name__ == "__main__":
    PORTRAIT, SOURCES = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[3:]])
