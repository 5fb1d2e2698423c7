"""Noise in grids: swept by the kernel, equal to simulate's, the same for any number of threads, and refused where it makes no sense."""

import unittest

import program

GRID = """plant = "dipdt"
n = 1
horizon = 30
sampling = 0.1
noise = 0.05
seed = 7
seeds = 3
measures = ["IAE_w", "noise_gain", %s]
[parameters]
kappa = { from = 0.06, to = 0.14, count = 5 }
delta = [0.4, 0.55]
tau_i = [10, 16]
tau_f = 0.2
"""
NAMES = [f"{kind}_{m}_{signal}" for signal in ("yw", "uw", "yd", "ud") for m in ("TV", "TV0", "TV1", "TV2")
         for kind in ("noisy", "spread")] + ["sigma_ratio", "spread_sigma_ratio", "expected_sigma_ratio"]
GRID = GRID % ", ".join(f'"{name}"' for name in NAMES)


class Noise(program.ProgramTest):
    def sweep(self, name, *options, text=GRID):
        self.write("noise.toml", text)
        summary = self.run_program("sweep", "noise.toml", "-o", name, "--json", *options)
        self.assertEqual(summary.code, 0, summary.err)
        return summary.json

    def refused(self, what, text, *arguments):
        self.write("noise.toml", text)
        refused = self.run_program(*(arguments or ("sweep", "noise.toml", "-o", "noise.h5")))
        self.assertEqual((refused.code, refused.out), (2, ""))
        self.assertIn(what, refused.err)

    def test_every_setting_is_what_simulate_says_of_these_seeds(self):
        summary = self.sweep("noise.h5")
        self.assertEqual((summary["settings"], summary["settings_by_reference"]), (20, 0))
        self.assertTrue(summary["method"].startswith("kernel, "))
        for row in self.run_program("query", "noise.h5", "--minimize", "noisy_TV2_uw", "--top", "3", "--json").json["top"]:
            s, m = row["settings"], row["measures"]
            noise = self.run_program("simulate", "--plant", "dipdt", "--kappa", s["kappa"], "--tau-i", s["tau_i"], "--delta", s["delta"],
                                     "--tau-f", "0.2", "--horizon", "30", "--noise", "0.05", "--sampling", "0.1", "--seed", "7",
                                     "--seeds", "3", "--json").json["noise"]
            for step in "wd":
                for signal in "yu":
                    for shape in ("TV", "TV0", "TV1", "TV2"):
                        theirs = noise[step][f"{shape}_{signal}"]
                        self.assertAlmostEqual(m[f"noisy_{shape}_{signal}{step}"], theirs["mean"], places=7)
                        self.assertAlmostEqual(m[f"spread_{shape}_{signal}{step}"], theirs["spread"], places=7)
            self.assertAlmostEqual(m["sigma_ratio"], noise["sigma_ratio"]["simulated"]["mean"], places=9)
            self.assertAlmostEqual(m["spread_sigma_ratio"], noise["sigma_ratio"]["simulated"]["spread"], places=9)
            self.assertAlmostEqual(m["expected_sigma_ratio"], noise["sigma_ratio"]["expected"], places=9)
            self.assertAlmostEqual(m["noise_gain"], noise["noise_gain"], places=7)

    def test_any_number_of_threads_and_the_reference_give_the_same(self):
        tables = []
        for threads in (1, 2, 5):
            self.sweep("noise.h5", "--threads", str(threads), "--force")
            self.run_program("export", "noise.h5", "-o", "noise.csv", "--force")
            tables.append((self.folder / "noise.csv").read_bytes())
        self.assertEqual(tables[0], tables[1])
        self.assertEqual(tables[0], tables[2])
        checked = self.run_program("verify", "noise.h5", "--sample", "20", "--seed", "1")
        self.assertEqual(checked.code, 0, checked.err + checked.out)

    def test_without_a_list_all_measures_of_noise_are_kept_beside_the_usual_ones(self):
        listed = GRID[GRID.index("measures"):GRID.index("[parameters]")]
        self.sweep("noise.h5", text=GRID.replace(listed, ""))
        self.sweep("quiet.h5", text=GRID.replace(listed, "").replace("noise = 0.05\n", "").replace("seed = 7\n", "").replace("seeds = 3\n", ""))
        noisy, quiet = (self.run_program("info", name, "--json").json["measures"] for name in ("noise.h5", "quiet.h5"))
        self.assertEqual(noisy, quiet + NAMES)
        self.assertIn("noise_gain", quiet)

    def test_an_answer_shows_the_signals_under_noise(self):
        self.sweep("noise.h5")
        best = self.run_program("query", "noise.h5", "--minimize", "noisy_TV_uw", "--json").json["optimum"]["measures"]
        lines = self.run_program("query", "noise.h5", "--minimize", "noisy_TV_uw").out.splitlines()
        for title, stem in (("noisy TV of u", "noisy_TV_u"), ("noisy TV2 of y", "noisy_TV2_y")):
            at = next(i for i, line in enumerate(lines) if line.strip().startswith(title + " "))
            self.assertEqual(lines[at].split()[-2:], [f"{best[stem + step]:.6g}" for step in "wd"])
            spread = [f"{best[stem.replace('noisy', 'spread') + step]:.6g}" for step in "wd"]
            self.assertEqual(lines[at + 1].split(), ["its", "spread", *spread])

    def test_the_portrait_knows_its_noise(self):
        self.sweep("noise.h5")
        info = self.run_program("info", "noise.h5", "--json").json
        self.assertEqual(info["noise"], {"kind": "uniform", "amplitude": 0.05, "seed": 7, "seeds": 3})
        self.assertIn("uniform noise of 0.05, 3 seeds from 7; noise held over 0.1 dead times", self.run_program("info", "noise.h5").out)
        self.write("noise.toml", GRID.replace("seed = 7", "seed = 8").replace("0.14, count = 5", "0.16, count = 6"))
        other = self.run_program("sweep", "noise.toml", "-o", "more.h5", "--extend", "noise.h5")
        self.assertEqual(other.code, 2)
        self.assertIn("noise: uniform of 0.05 held over 0.1, 3 seeds from 7, now uniform of 0.05 held over 0.1, 3 seeds from 8", other.err)
        box = self.run_program("query", "noise.h5", "--minimize", "noisy_TV_uw", "--uncertain", "K=0.9..1.1,Td=0.9..1.1")
        self.assertEqual(box.code, 2)
        self.assertIn("noisy_TV_uw: noise is drawn for one plant", box.err)

    def test_families_and_grids_that_noise_cannot_pass_are_refused(self):
        ideal = GRID.replace("n = 1\n", "n = 0\n").replace("tau_f = 0.2\n", "")
        self.refused('noise.toml:5:1: "noise": the ideal derivative of n = 0 makes an impulse of every value', ideal)
        self.refused('noise.toml:5:1: "noise" needs the key "sampling"', GRID.replace("sampling = 0.1", ""))
        self.refused('noise.toml:5:1: "noise" needs a fixed horizon', GRID.replace("horizon = 30", 'horizon = "auto"'))
        self.refused('noise.toml:5:9: "noise" must be finite and above 0 (it is 0)', GRID.replace("noise = 0.05", "noise = 0"))
        self.refused('"seeds" must be 1 .. 10000 (it is 0)', GRID.replace("seeds = 3", "seeds = 0"))
        self.refused('"seed" must be 0 .. ', GRID.replace("seed = 7", "seed = -7"))
        self.refused('unknown noise_kind "gausian" (did you mean "gaussian"?)', GRID.replace("seed = 7", 'noise_kind = "gausian"'))
        self.refused('"seed" needs the key "noise"', GRID.replace("noise = 0.05\n", ""))
        self.refused('"sampled": a sweep\'s controllers are continuous', GRID.replace("seed = 7", "sampled = true"))
        self.refused("a sweep takes at most 131072", GRID.replace("sampling = 0.1", "sampling = 0.0001"))
        self.refused("a sweep draws at most 4000000 values", GRID.replace("seeds = 3", "seeds = 10000").replace("horizon = 30", "horizon = 300"))
        self.refused('measure "noisy_TV_yw" needs the key "noise"',
                     GRID.replace("noise = 0.05\n", "").replace("seed = 7\n", "").replace("seeds = 3\n", ""))


if __name__ == "__main__":
    program.main()
