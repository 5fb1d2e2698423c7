"""Plants of many lags, controllers given by their gains, and measures beyond the usual ones, in grids, portraits and queries."""

import unittest

import program

FURTHER_GRID = program.SMALL_GRID.replace("n = 0", 'n = 1\nmeasures = ["IAE_w", "TV3_uw", "TV8_yd", "IAE_o", "TV1_uo", "DC_uw", "Ms"]') + "tau_f = 0.2\n"


JOTD_GRID = """plant = "jotd"
j = 4
n = 2
prefilter = "full"
horizon = 40
[parameters]
kappa = { from = 0.5, to = 1.5, count = 3 }
tau_i = [2, 4, inf]
delta = 0.6
tau_j = [0.5, 1]
tau_f = 0.1
"""

GAINS_GRID = """plant = "jotd"
j = 3
n = 3
horizon = 30
[parameters]
K_-1 = { from = 0.2, to = 0.4, count = 3 }
K_0 = { from = 0.6, to = 1.2, count = 4 }
K_1 = [0.4, 0.8]
K_3 = 0.1
tau_j = 0.8
tau_f = 0.1
"""


class Families(program.ProgramTest):
    def swept(self, grid, *options):
        self.write("family.toml", grid)
        summary = self.run_program("sweep", "family.toml", "-o", "family.h5", "--force", "--json", *options)
        self.assertEqual(summary.code, 0, summary.err)
        return summary.json

    def refused(self, grid, what):
        self.write("family.toml", grid)
        refused = self.run_program("sweep", "family.toml", "-o", "family.h5")
        self.assertEqual((refused.code, refused.out), (2, ""))
        self.assertIn(what, refused.err)

    def test_jotd_is_swept_by_the_kernel_and_equals_simulate(self):
        summary = self.swept(JOTD_GRID)
        self.assertEqual((summary["settings"], summary["settings_by_reference"]), (18, 0))
        self.assertTrue(summary["method"].startswith("kernel, "))
        info = self.run_program("info", "family.h5", "--json").json
        self.assertEqual(info["plant"], "jotd")
        best = self.run_program("query", "family.h5", "--minimize", "IAE_w", "--where", "tau_j == 0.5", "--json").json["optimum"]
        s = best["settings"]
        again = self.run_program("simulate", "--plant", "jotd", "--j", 4, "--tau-j", s["tau_j"], "--kappa", s["kappa"], "--tau-i",
                                 s["tau_i"], "--delta", s["delta"], "--n", 2, "--tau-f", "0.1", "--horizon", "40", "--json").json
        for name, value in best["measures"].items():
            self.assertAlmostEqual(value, again["measures"][name], places=7, msg=name)

    def test_jotd_in_real_units(self):
        self.swept(JOTD_GRID)
        query = ["query", "family.h5", "--minimize", "IAE_w", "--json"]
        plain = self.run_program(*query, "--where", "tau_j == 0.5").json["optimum"]
        real = self.run_program(*query, "--plant", "K=2,Td=3,Tj=1.5").json["optimum"]
        self.assertEqual(real["settings"], plain["settings"])
        self.assertAlmostEqual(real["measures"]["IAE_w"], 3 * plain["measures"]["IAE_w"], places=9)
        self.assertAlmostEqual(real["controller"]["standard"]["Kc"], plain["settings"]["kappa"] / 2, places=12)
        self.assertIn("--plant: Tj must be finite and above 0", self.run_program(*query, "--plant", "K=2,Td=3").err)

    def test_gains_are_axes(self):
        summary = self.swept(GAINS_GRID)
        self.assertEqual((summary["settings"], summary["settings_by_reference"]), (24, 0))
        answer = self.run_program("query", "family.h5", "--minimize", "IAE_d^2*TV1_ud", "--where", "K_-1 >= 0.3", "--where", "K_1 == 0.4",
                                  "--json").json
        best = answer["optimum"]
        s = best["settings"]
        self.assertGreaterEqual(s["K_-1"], 0.3)
        self.assertEqual((s["K_1"], s["K_2"], s["K_3"]), (0.4, 0, 0.1))
        gains = ",".join(str(s[f"K_{k}"]) for k in range(-1, 4))
        again = self.run_program("simulate", "--plant", "jotd", "--j", 3, "--tau-j", "0.8", "--gains", gains, "--n", 3, "--tau-f", "0.1",
                                 "--horizon", "30", "--json").json
        for name, value in best["measures"].items():
            self.assertAlmostEqual(value, again["measures"][name], places=7, msg=name)

    def test_the_same_bits_for_any_number_of_threads(self):
        digests = []
        for threads in (1, 2):
            self.swept(GAINS_GRID, "--threads", threads)
            rows = self.run_program("query", "family.h5", "--minimize", "IAE_w", "--top", "24", "--json").json["top"]
            digests.append([row["measures"] for row in rows])
        self.assertEqual(digests[0], digests[1])

    def test_what_is_refused_says_why(self):
        self.refused(JOTD_GRID.replace("j = 4\n", ""), 'the order of jotd, 1 .. 8')
        self.refused(JOTD_GRID.replace("j = 4", "j = 9"), 'family.toml:2:5: "j" must be 1 .. 8 (it is 9)')
        self.refused(JOTD_GRID.replace("tau_j", "tau_1"), '"tau_1" belongs to plant "fotd", not to "jotd"')
        self.refused(program.SMALL_GRID + "tau_j = 1\n", '"tau_j" belongs to plant "jotd", not to "dipdt"')
        self.refused(GAINS_GRID.replace("\nn = 3\n", "\nn = 2\n"), "gains up to K_3 need a filter of order n >= 3 (n is 2)")
        self.refused(GAINS_GRID.replace("\nn = 3\n", '\nn = 3\nprefilter = "full"\n'), 'beside gains it must be "none"')
        self.refused(GAINS_GRID + "kappa = 1\n", '"kappa" has no place beside gains K_-1, K_0, ...: give one or the other')
        self.refused(GAINS_GRID.replace("from = 0.2", "from = -0.2"), "K_-1 must be not below 0")
        self.refused(GAINS_GRID.replace("K_0 = { from = 0.6, to = 1.2, count = 4 }\n", ""), "the proportional gain")
        self.refused(GAINS_GRID.replace('plant = "jotd"', 'plant = "tf"'), 'unknown plant "tf"')
        self.refused(GAINS_GRID + "K_7 = 1\n", 'unknown key "K_7"')
        self.swept(GAINS_GRID)
        asked = self.run_program("query", "family.h5", "--minimize", "IAE_w", "--plant", "K=2,Td=3,Tj=2.4")
        self.assertEqual(asked.code, 2)
        self.assertIn("a portrait of gains is asked in normalised numbers", asked.err)
        self.assertIn('no parameter "kappa" (it has: ', self.run_program("query", "family.h5", "--minimize", "kappa").err)


    def test_a_box_of_plants_and_rules_know_the_lags_of_jotd(self):
        self.swept(JOTD_GRID.replace("tau_j = [0.5, 1]", "tau_j = 1"))
        ask = ("query", "family.h5", "--minimize", "IAE_d", "--where", "Ms <= 2.5")
        box = self.run_program(*ask, "--uncertain", "K=0.9..1.1,Tj=1.8..2.2", "--plant", "K=1,Td=2,Tj=2", "--json")
        self.assertEqual(box.code, 0, box.err)
        self.assertEqual(box.json["uncertain"]["Tj"], {"from": 1.8, "to": 2.2})
        self.assertIn("Tj in 1.8..2.2", self.run_program(*ask, "--uncertain", "K=0.9..1.1,Tj=1.8..2.2", "--plant", "K=1,Td=2,Tj=2").out)
        for wrong, why in (("T1=1.8..2.2", "T1 belongs to fotd, not to jotd"), ("Tjj=1..2", 'unknown name "Tjj" (did you mean "Tj"?)')):
            refused = self.run_program(*ask, "--uncertain", wrong, "--plant", "K=1,Td=2,Tj=2")
            self.assertEqual(refused.code, 2)
            self.assertIn(why, refused.err)
        rules = self.run_program(*ask, "--rules", "--json")
        self.assertEqual(rules.code, 0, rules.err)
        applied = [r["rule"] for r in rules.json["rules"] if r["applicable"]]
        self.assertGreater(len(applied), 0, rules.out)
        self.swept(GAINS_GRID)
        refused = self.run_program("query", "family.h5", "--minimize", "IAE_w", "--rules")
        self.assertEqual(refused.code, 2)
        self.assertIn("--rules: of portraits with a PID controller; for gains see portrait tune", refused.err)


class FurtherMeasures(program.ProgramTest):
    def test_the_kernel_refuses_them_by_name(self):
        self.write("further.toml", FURTHER_GRID)
        refused = self.run_program("sweep", "further.toml", "-o", "further.h5")
        self.assertEqual((refused.code, refused.out), (2, ""))
        self.assertIn("the kernel does not measure TV3_uw: --method reference does", refused.err)

    def test_swept_by_the_reference_they_are_those_of_simulate(self):
        self.write("further.toml", FURTHER_GRID)
        summary = self.run_program("sweep", "further.toml", "-o", "further.h5", "--method", "reference", "--json").json
        self.assertEqual(summary["method"], "reference")
        answer = self.run_program("query", "further.h5", "--minimize", "IAE_w^2*TV3_uw", "--json").json
        best = answer["optimum"]
        s = best["settings"]
        again = self.run_program("simulate", "--plant", "dipdt", "--kappa", s["kappa"], "--tau-i", s["tau_i"], "--delta", s["delta"],
                                 "--tau-f", "0.2", "--horizon", "40", "--json").json["measures"]
        for name, value in best["measures"].items():
            self.assertAlmostEqual(value, again[name], places=8, msg=name)
        self.assertGreater(best["measures"]["TV3_uw"], 0)
        self.assertGreaterEqual(best["measures"]["DC_uw"], 2)
        # J_k = IAE^k TVm is what was minimised.
        for row in answer["top"]:
            self.assertGreaterEqual(row["measures"]["IAE_w"] ** 2 * row["measures"]["TV3_uw"],
                                    best["measures"]["IAE_w"] ** 2 * best["measures"]["TV3_uw"] * (1 - 1e-12))


if __name__ == "__main__":
    program.main()
