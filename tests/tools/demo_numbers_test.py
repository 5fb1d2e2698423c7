"""The published answers of Huba2022, section 6, from the ready grid: (43), (46), (47), (48), and (49) by (52)."""

import program
from program import ProgramTest

SHAPES = ("--where", "TV2_uw <= 0.1", "--where", "TV2_ud <= 0.1", "--where", "TV0_yw <= 0.01", "--where", "TV1_yd <= 0.01")


class DemoNumbers(ProgramTest):
    def test_published_optima(self):
        grid = program.SOURCES / "grids" / "catalog" / "huba2022-43.toml"
        sweep = self.run_program("sweep", grid, "-o", "p.h5", "--json")
        self.assertEqual((sweep.code, sweep.json["settings"]), (0, 4185))

        fastest = self.run_program("query", "p.h5", "--minimize", "IAE_w + IAE_d", *SHAPES, "--json").json
        best = fastest["optimum"]
        self.assertEqual([best["settings"][name] for name in ("kappa", "delta", "tau_i")], [0.24, 0.7, 8])  # (47)
        self.assertAlmostEqual(best["measures"]["IAE_w"], 8.000, places=3)
        self.assertAlmostEqual(best["measures"]["IAE_d"], 33.333, places=3)

        weak = self.run_program("query", "p.h5", "--minimize", "IAE_w + IAE_d", *SHAPES, "--where", "delta == 0.35", "--json").json
        best = weak["optimum"]
        self.assertEqual([best["settings"][name] for name in ("kappa", "delta", "tau_i")], [0.08, 0.35, 14])  # (48)
        self.assertAlmostEqual(best["measures"]["IAE_w"], 13.998, places=3)
        self.assertAlmostEqual(best["measures"]["IAE_d"], 174.96, places=2)

    def test_count_of_settings_that_had_come_to_rest(self):
        """167 settings meet (46) when y_d, too, must have come within 0.01 of rest at the horizon."""
        grid = program.SOURCES / "grids" / "catalog" / "huba2022-43.toml"
        self.run_program("sweep", grid, "-o", "p.h5", "--quiet")
        answer = self.run_program("query", "p.h5", "--minimize", "IAE_w + IAE_d", *SHAPES, "--include-not-settled", "--where",
                                  "TV0_yd - TV_yd <= 0.01", "--json").json
        self.assertEqual(answer["admissible"], 167)

    def test_ms_of_the_series_settings(self):
        for kappa, delta, tau_i, published in ((0.0354, 0.382, 10.74, 1.59), (0.0505, 0.4737, 9.37, 1.80),
                                               (0.0625, 0.5475, 8.64, 2.00)):
            tau_d = delta / kappa
            answer = self.run_program("simulate", "--plant", "dipdt", "--kappa", kappa * (tau_i + tau_d) / tau_i, "--tau-i",
                                      tau_i + tau_d, "--delta", delta, "--horizon", "80", "--json").json
            self.assertAlmostEqual(answer["measures"]["Ms"], published, delta=0.005)


if __name__ == "__main__":
    program.main()
