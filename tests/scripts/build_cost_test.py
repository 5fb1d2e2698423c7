"""scripts/build_cost adds up ninja's log: the last run of each step, by target and by source.

usage: build_cost_test.py SOURCES
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCES = None
# begin and end in milliseconds, time stamp, output, hash
LOG = """# ninja log v5
0\t9000\t1\tengine/CMakeFiles/portrait_loop.dir/loop/gain.cpp.o\ta
0\t2000\t1\tengine/CMakeFiles/portrait_loop.dir/loop/margins.cpp.o\tb
2000\t5500\t1\tengine/CMakeFiles/portrait_loop.dir/loop/gain.cpp.o\ta
1000\t2000\t1\ttools/CMakeFiles/portrait.dir/trace.cpp.o\tc
5500\t6500\t1\tengine/libportrait_loop.a\td
"""


class BuildCost(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self._folder.name)
        (self.root / "scripts").mkdir()
        shutil.copy(SOURCES / "scripts/build_cost", self.root / "scripts")

    def tearDown(self):
        self._folder.cleanup()

    def run_script(self, *arguments):
        return subprocess.run([sys.executable, self.root / "scripts/build_cost", *arguments], text=True, capture_output=True, check=False)

    def build(self, preset):
        folder = self.root / "build" / preset
        (folder / "tools").mkdir(parents=True)
        (folder / ".ninja_log").write_text(LOG)
        return folder

    def test_last_run_of_each_step(self):
        self.build("program")
        done = self.run_script()
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = [line.split() for line in done.stdout.splitlines() if line]
        self.assertEqual(done.stdout.splitlines()[0], "preset program: 8 s of work, of which 6 s for 3 sources")  # 3.5 + 2 + 1 (+ 1)
        self.assertEqual(lines[2:4], [["6", "portrait_loop"], ["1", "portrait"]])
        self.assertEqual(lines[5:], [["4", "engine/loop/gain.cpp"], ["2", "engine/loop/margins.cpp"], ["1", "tools/trace.cpp"]])

    def test_size_of_the_program(self):
        shutil.copy("/bin/true", self.build("dev") / "tools" / "portrait")
        done = self.run_script("dev")
        self.assertRegex(done.stdout, r"\ntools/portrait: 0\.\d MB, 0\.\d MB stripped\n$")

    def test_without_a_build(self):
        done = self.run_script("release")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr, "There is no build/release: cmake --preset release && cmake --build --preset release\n")


if __name__ == "__main__":
    SOURCES = pathlib.Path(sys.argv.pop(1))
    unittest.main()
