"""What scripts/demo and scripts/test say on a machine that cannot be served, and what cmake says of an old compiler.

usage: messages_test.py SOURCES

The machine is a folder of programs that is all of PATH: some real, some pretending.
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCES = None
REAL = ["bash", "dirname", "env", "cat"]


class Machine(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self._folder.name)
        self.programs = self.folder / "bin"
        self.programs.mkdir()
        for name in REAL:
            (self.programs / name).symlink_to(shutil.which(name))
        self.pretend("dpkg-query", "exit 1")  # nothing is installed
        self.pretend("id", "echo 1000")
        self.pretend("apt-get", 'echo "$*" >>"$CALLS"')

    def tearDown(self):
        self._folder.cleanup()

    def pretend(self, name, script):
        path = self.programs / name
        path.write_text(f"#!/bin/bash\n{script}\n")
        path.chmod(0o755)

    def run_script(self, name):
        self.calls = self.folder / "calls"
        return subprocess.run([SOURCES / "scripts" / name], text=True, capture_output=True, timeout=60, check=False,
                              stdin=subprocess.DEVNULL, env={"PATH": str(self.programs), "CALLS": str(self.calls)})


class Scripts(Machine):
    def test_neither_root_nor_sudo(self):
        for name in ("demo", "test"):
            done = self.run_script(name)
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, "^Portrait needs these packages, and neither root nor sudo is at hand to install them. "
                                          r"Ask for:\n  apt-get install g\+\+ cmake [^\n]*\n$")
            self.assertFalse(self.calls.exists())

    def test_another_system(self):
        (self.programs / "apt-get").unlink()
        (self.programs / "dpkg-query").unlink()
        done = self.run_script("demo")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, "^Portrait needs these Debian packages, and there is no apt-get here. Install what they are "
                                      r"called on this system:\n  g\+\+ cmake [^\n]*\n$")

    def test_no_network(self):
        self.pretend("id", "echo 0")
        self.pretend("apt-get", "echo 'W: cannot resolve the host' >&2; exit 100")
        done = self.run_script("demo")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr, "W: cannot resolve the host\n"
                                      "Installing failed: is the network there, and is this Debian 12 or newer?\n")

    def test_a_user_with_sudo_installs_through_it(self):
        self.pretend("sudo", 'echo "sudo $*" >>"$CALLS"; exec "$@"')
        self.pretend("cmake", "exit 7")  # as far as the build, which is not the matter here
        self.assertEqual(self.run_script("demo").returncode, 7)
        calls = self.calls.read_text().splitlines()
        self.assertEqual([calls[0], calls[1]], ["sudo apt-get update -qq", "update -qq"])
        self.assertTrue(calls[3].startswith("install -y -qq --no-install-recommends g++ cmake "), calls)

    def test_nothing_is_installed_where_all_is_there(self):
        self.pretend("dpkg-query", "echo installed")
        self.pretend("cmake", "exit 7")
        self.assertEqual(self.run_script("demo").returncode, 7)
        self.assertFalse(self.calls.exists())


class Compiler(unittest.TestCase):
    def configured_with(self, version):
        """What cmake says of a g++ that calls itself so."""
        with tempfile.TemporaryDirectory() as folder:
            compiler = pathlib.Path(folder) / "old-g++"
            major = "" if version is None else f"-U__GNUC__ -D__GNUC__={version}"
            compiler.write_text(f'#!/bin/sh\nexec g++ {major} "$@"\n')
            compiler.chmod(0o755)
            (pathlib.Path(folder) / "CMakeLists.txt").write_text(
                "cmake_minimum_required(VERSION 3.25)\nproject(asks LANGUAGES CXX)\n"
                f'include("{SOURCES}/cmake/compiler.cmake")\n')
            done = subprocess.run(["cmake", "-S", folder, "-B", f"{folder}/b", f"-DCMAKE_CXX_COMPILER={compiler}"], text=True,
                                  capture_output=True, timeout=120, check=False)
            return done.returncode, " ".join(done.stderr.split())

    def test_an_old_one_is_refused_in_a_sentence(self):
        code, text = self.configured_with(10)
        self.assertNotEqual(code, 0)
        self.assertIn("Portrait needs g++ 12 or newer, as Debian 12 has it; ", text)
        self.assertIn("is version 10.", text)
        self.assertIn("cmake --preset dev -DCMAKE_CXX_COMPILER=g++-12", text)

    def test_the_present_one_is_taken(self):
        self.assertEqual(self.configured_with(None)[0], 0)

    def test_the_build_asks(self):
        self.assertIn("include(cmake/compiler.cmake)\n", (SOURCES / "CMakeLists.txt").read_text())


if __name__ == "__main__":
    SOURCES = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[1:]])
