"""What `cmake --install` and cpack leave is enough: a program of somebody else finds it, builds and runs.

usage: install_test.py PORTRAIT SOURCES BUILD
"""

import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PORTRAIT = SOURCES = BUILD = None
GRID = """plant = "dipdt"
n = 0
horizon = 40

[parameters]
kappa = [0.16, 0.24]
delta = [0.55, 0.7]
tau_i = [8, 14]
"""


def run(*words, **options):
    done = subprocess.run([str(word) for word in words], text=True, capture_output=True, check=False, **options)
    if done.returncode != 0:
        raise AssertionError(f"{words}\n{done.stdout}{done.stderr}")
    return done.stdout


def version():
    return re.search(r"project\(portrait VERSION ([0-9.]+)", (SOURCES / "CMakeLists.txt").read_text()).group(1)


def verbs(program):
    listed = subprocess.run([program, "--help"], text=True, capture_output=True, check=True).stdout
    return re.findall(r"^  ([a-z]+)  ", listed, re.MULTILINE)


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls._folder = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls._folder.name)
        cls.prefix = cls.folder / "usr"
        run("cmake", "--install", BUILD, "--prefix", cls.prefix, "--strip")
        cls.program = cls.prefix / "bin" / "portrait"

    @classmethod
    def tearDownClass(cls):
        cls._folder.cleanup()

    def test_the_program_and_its_grids_are_there(self):
        self.assertTrue(run(self.program, "--version").startswith(f"portrait {version()} ("))
        grids = sorted(path.name for path in (self.prefix / "share/portrait/catalog").iterdir())
        self.assertEqual(grids, sorted(path.name for path in (SOURCES / "grids/catalog").iterdir()))

    def test_every_verb_has_its_manual_page(self):
        pages = {path.stem for path in (self.prefix / "share/man/man1").iterdir()}
        expected = {"portrait"} | {f"portrait-{verb}" for verb in verbs(self.program)} - {"portrait-man", "portrait-completion"}
        self.assertGreater(len(expected), 10)
        self.assertEqual(pages, expected)

    def test_a_consumer_finds_builds_and_runs(self):
        (self.folder / "small.toml").write_text(GRID)
        run(PORTRAIT, "sweep", "small.toml", "-o", "small.h5", "--quiet", cwd=self.folder)
        optimum = json.loads(run(PORTRAIT, "query", "small.h5", "--minimize", "IAE_w + IAE_d", "--json", cwd=self.folder))["optimum"]
        loop = json.loads(run(PORTRAIT, "simulate", "--plant", "dipdt", "--n", "0", "--prefilter", "pi", "--kappa", "0.24", "--tau-i",
                              "8", "--delta", "0.7", "--horizon", "40", "--json"))
        consumer = self.folder / "consumer"
        run("cmake", "-S", SOURCES / "tests/package/consumer", "-B", consumer, f"-DCMAKE_PREFIX_PATH={self.prefix}",
            "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Werror")
        run("cmake", "--build", consumer)
        said = dict(line.split(" ", 1) for line in run(consumer / "consumer", self.folder / "small.h5").splitlines())
        self.assertEqual(said["IAE_w"], f"{loop['measures']['IAE_w']:.6f}")
        for name in ("kappa", "tau_i", "delta"):
            self.assertIn(f"{name}={optimum['settings'][name]:g}", said["best"])
        self.assertEqual(int(said["rules"]), len(json.loads(run(PORTRAIT, "tune", "--list", "--json"))))

    def test_nothing_installed_points_into_the_build(self):
        for path in (self.prefix / "lib").rglob("*.cmake"):
            self.assertNotIn(str(SOURCES), path.read_text(), path)

    def test_a_consumer_without_c_or_with_another_version_is_told(self):
        for name, head, sentence in (
                ("c", "project(x LANGUAGES CXX)\nfind_package(Portrait 0.1 REQUIRED)", "say project(... LANGUAGES C CXX)"),
                ("v", "project(x LANGUAGES C CXX)\nfind_package(Portrait 7.0 REQUIRED)", f"version: {version()}")):
            folder = self.folder / name
            folder.mkdir()
            (folder / "CMakeLists.txt").write_text(f"cmake_minimum_required(VERSION 3.25)\n{head}\n")
            done = subprocess.run(["cmake", "-S", folder, "-B", folder / "b", f"-DCMAKE_PREFIX_PATH={self.prefix}"], text=True,
                                  capture_output=True, check=False)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(sentence, " ".join(done.stderr.split()))


@unittest.skipUnless(shutil.which("dpkg-shlibdeps") and shutil.which("file"), "dpkg-dev and file are not there")
class DebianPackage(unittest.TestCase):
    def test_the_programs_package_is_whole(self):
        with tempfile.TemporaryDirectory() as folder:
            run("cpack", "-G", "DEB", "-D", "CPACK_COMPONENTS_ALL=program", "-B", folder, cwd=BUILD)
            made = list(pathlib.Path(folder).glob("portrait_*.deb"))
            self.assertEqual(len(made), 1)
            field = {name: run("dpkg-deb", "-f", made[0], name).strip() for name in ("Package", "Version", "Depends", "Recommends")}
            self.assertEqual((field["Package"], field["Version"]), ("portrait", version()))
            for library in ("libhdf5-103-1", "libgomp1", "libc6"):
                self.assertIn(library, field["Depends"])
            self.assertEqual(field["Recommends"], "gnuplot-nox")
            run("dpkg-deb", "-x", made[0], f"{folder}/unpacked")
            unpacked = pathlib.Path(folder, "unpacked", "usr")
            self.assertTrue(run(unpacked / "bin/portrait", "--version").startswith(f"portrait {version()} ("))
            self.assertEqual((unpacked / "share/doc/portrait/copyright").read_text(), (SOURCES / "LICENSE").read_text())
            page = unpacked / "share/man/man1/portrait-query.1"
            self.assertTrue(page.exists() or page.with_name("portrait-query.1.gz").exists())


if __name__ == "__main__":
    PORTRAIT, SOURCES, BUILD = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[4:]])
