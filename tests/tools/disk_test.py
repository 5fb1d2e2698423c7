"""A disk that is full, or that tears what it holds: nothing that was stored is lost, and the run goes on."""

import os
import subprocess
import unittest

import program
from program import ProgramTest, SMALL_GRID

GRID = SMALL_GRID.replace("step = 0.08", "count = 2000").replace("[0.4, 0.55, 0.7]", "{ from = 0.4, to = 0.7, count = 5 }")


@unittest.skipIf(os.geteuid() != 0, "mounting a small disk needs root")
class FullDisk(ProgramTest):
    def setUp(self):
        super().setUp()
        self.disk = self.folder / "disk"
        self.disk.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=4m", "tmpfs", str(self.disk)], capture_output=True, text=True)
        if mounted.returncode != 0:
            self.skipTest(f"no disk of its own can be mounted here: {mounted.stderr.strip()}")

    def tearDown(self):
        subprocess.run(["umount", str(self.disk)], check=False, capture_output=True)
        super().tearDown()

    def test_full_and_then_larger(self):
        self.write("g.toml", GRID)
        self.assertEqual(self.run_program("sweep", "g.toml", "-o", "whole.h5", "--quiet").code, 0)
        whole = self.run_program("verify", "whole.h5").out.replace("whole.h5", "disk/g.h5")
        result = self.run_program("sweep", "g.toml", "-o", "disk/g.h5", "--quiet")
        self.assertEqual(result.code, 1)
        self.assertRegex(result.err, r"^portrait: disk/g\.h5.*No space left on device\n$")
        self.assertFalse((self.disk / "g.h5").exists())
        subprocess.run(["mount", "-o", "remount,size=64m", str(self.disk)], check=True)
        result = self.run_program("sweep", "g.toml", "-o", "disk/g.h5", "--quiet", "--resume")
        self.assertEqual((result.code, result.err), (0, ""))
        self.assertEqual(self.run_program("verify", "disk/g.h5").out, whole)
        self.assertEqual([path.name for path in self.disk.iterdir()], ["g.h5"])


if __name__ == "__main__":
    program.main()
