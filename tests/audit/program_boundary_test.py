"""Corners that only the program has: no horizon, axes of one point, a single setting, no dead time; and the audit's own command.

usage: program_boundary_test.py PORTRAIT PORTRAIT_AUDIT
"""

import json
import pathlib
import shlex
import subprocess
import sys
import tempfile
import unittest

PORTRAIT = AUDIT = None
ONE_POINT = 'plant = "dipdt"\nn = 0\nhorizon = 40\n\n[parameters]\nkappa = [0.24]\ndelta = [0.7]\ntau_i = [8]\n'
SINGLE = ONE_POINT.replace("[0.24]", "0.24").replace("[0.7]", "0.7").replace("[8]", "8")


def run(*words, code=0, program=None, **options):
    done = subprocess.run([program or PORTRAIT, *map(str, words)], text=True, capture_output=True, timeout=300, check=False, **options)
    if done.returncode != code:
        raise AssertionError(f"{words}: {done.returncode}\n{done.stdout}{done.stderr}")
    return done


def measures(*words):
    return json.loads(run("simulate", *words, "--json").stdout)["measures"]


class Boundaries(unittest.TestCase):
    def test_no_horizon_is_refused(self):
        for horizon in ("0", "-1", "nan", "inf"):
            said = run("simulate", "--plant", "ipdt", "--kappa", "0.3", "--horizon", horizon, code=2)
            self.assertEqual(said.stdout, "")
            self.assertIn("horizon", said.stderr)

    def test_axes_of_one_point_and_a_single_setting(self):
        optima = []
        for name, text, axes in (("one_point", ONE_POINT, 3), ("single", SINGLE, 0)):
            with tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder) / "g.toml"
                path.write_text(text)
                run("sweep", path, "-o", "p.h5", "--quiet", cwd=folder)
                run("verify", "p.h5", "--sample", "1", cwd=folder)
                info = json.loads(run("info", "p.h5", "--json", cwd=folder).stdout)
                self.assertEqual((info["settings"], len(info["axes"])), (1, axes), name)
                answer = json.loads(run("query", "p.h5", "--minimize", "IAE_w + IAE_d", "--json", cwd=folder).stdout)
                self.assertEqual((answer["admissible"], answer["total"]), (1, 1))
                optima.append(answer["optimum"]["measures"])
        self.assertEqual(optima[0], optima[1])

    def test_a_dead_time_that_vanishes_is_none(self):
        """K/(s + 1) and Kc (1 + 1/(Ti s)): y reaches the setpoint without overshoot, so IAE_w = Ti/(K Kc) = 0.5."""
        words = ["--plant", "tf:1/1,1", "--controller", "tf:2,2/1,0"]
        none = measures(*words, "--Td", "0", "--horizon", "40")
        self.assertAlmostEqual(none["IAE_w"], 0.5, delta=1e-9)
        self.assertAlmostEqual(none["y_max_w"], 1, delta=1e-9)
        for Td in (1e-2, 1e-3):
            tiny = measures(*words, "--Td", Td, "--horizon", "40")
            for name in ("IAE_w", "TV_uw", "y_max_w", "Ms"):
                self.assertAlmostEqual(tiny[name], none[name], delta=20 * Td, msg=f"{name}, Td = {Td}")


class Audit(unittest.TestCase):
    def test_a_loop_has_its_own_seed_and_its_command_says_the_same(self):
        many = json.loads(run("--loops", "12", "--seed", "3", "--json", program=AUDIT).stdout)
        self.assertEqual((many["loops"], many["findings"]), (12, 0))
        row = next(row for row in many["rows"] if row["method"] == "kernel" and row["measures"] == "integrals")
        alone = json.loads(run("--loops", "1", "--seed", "3", "--first", row["loop"], "--json", program=AUDIT).stdout)
        again = next(r for r in alone["rows"] if r["method"] == "kernel" and r["measures"] == "integrals")
        self.assertEqual((again["worst"], again["command"]), (row["worst"], row["command"]))
        self.assertIn(row["measure"], json.loads(run(*shlex.split(row["command"])[1:], "--json").stdout)["measures"])

    def test_threads_do_not_matter(self):
        tables = [json.loads(run("--loops", "12", "--seed", "4", "--threads", threads, "--json", program=AUDIT).stdout)["rows"]
                  for threads in (1, 3)]
        self.assertEqual(*tables)


if __name__ == "__main__":
    PORTRAIT, AUDIT = (str(pathlib.Path(word).resolve()) for word in sys.argv[1:3])
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[3:]])
