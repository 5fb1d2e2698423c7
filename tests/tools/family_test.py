"""Measures beyond the usual ones in grids, portraits and queries."""

import unittest

import program

FURTHER_GRID = program.SMALL_GRID.replace("n = 0", 'n = 1\nmeasures = ["IAE_w", "TV3_uw", "TV8_yd", "IAE_o", "TV1_uo", "DC_uw", "Ms"]') + "tau_f = 0.2\n"


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
