"""portrait simulate."""

import csv
import math

import program
from program import ProgramTest

PPM47 = ("--plant", "dipdt", "--kappa", "0.24", "--delta", "0.7", "--tau-i", "8")


class Simulate(ProgramTest):
    def test_json_has_settings_measures_status(self):
        result = self.run_program("simulate", *PPM47, "--horizon", "80", "--json")
        self.assertEqual((result.code, result.err), (0, ""))
        answer = result.json
        self.assertEqual(answer["status"], "settled")
        self.assertEqual(answer["settings"]["tau_i"], 8)
        self.assertAlmostEqual(answer["measures"]["IAE_w"], 8.000016929649, places=9)
        self.assertAlmostEqual(answer["measures"]["IAE_d"], 33.33339839493, places=8)

    def test_tau_d_is_delta_over_kappa(self):
        by_delta = self.run_program("simulate", *PPM47, "--json").json
        by_tau_d = self.run_program("simulate", "--plant", "dipdt", "--kappa", "0.24", "--tau-i", "8", "--tau-d",
                                    str(0.7 / 0.24), "--json").json
        self.assertAlmostEqual(by_delta["measures"]["IAE_d"], by_tau_d["measures"]["IAE_d"], places=9)

    def test_infinite_numbers_and_missing_measures_in_json(self):
        answer = self.run_program("simulate", "--plant", "dipdt", "--kappa", "0.08", "--delta", "0.46", "--json").json
        self.assertEqual(answer["settings"]["tau_i"], "inf")
        self.assertIsNone(answer["measures"]["IAE_d"])

    def test_what_only_a_sweep_measures_is_not_listed(self):
        for loop in (PPM47, ("--plant", "tf:34/13.5,54.25,55,1", "--pid", "standard:Kc=0.783428,Ti=5.345232")):
            self.assertNotIn("noisy", self.run_program("simulate", *loop).out)
            measures = self.run_program("simulate", *loop, "--json").json["measures"]
            self.assertEqual([name for name in measures if "noisy" in name or "sigma" in name], [])
            self.assertIn("TV8_uo", measures)

    def test_margins(self):
        measures = self.run_program("simulate", "--plant", "ipdt", "--kappa", "0.5", "--json").json["measures"]
        self.assertAlmostEqual(measures["GM"], math.pi, places=12)
        self.assertEqual(measures["GM_low"], 0)
        self.assertAlmostEqual(measures["PM"], 90 - 0.5 * 180 / math.pi, places=11)
        self.assertAlmostEqual(measures["DM"], math.pi - 1, places=12)

    def test_noise_gain_needs_a_sampling_time(self):
        loop = ("--plant", "ipdt", "--kappa", "0.5")
        self.assertIsNone(self.run_program("simulate", *loop, "--json").json["measures"]["noise_gain"])
        noisy = self.run_program("simulate", *loop, "--sampling", "0.01", "--json").json["measures"]["noise_gain"]
        self.assertAlmostEqual(noisy, 0.5, places=2)
        ideal = self.run_program("simulate", *PPM47, "--sampling", "0.01", "--json").json["measures"]["noise_gain"]
        self.assertEqual(ideal, "inf")
        for wrong in ("0", "inf", "often"):
            self.assert_fails(self.run_program("simulate", *loop, "--sampling", wrong), 2,
                              f'--sampling: "{wrong}" is not a number of dead times above 0 and at most 10000')

    def test_unstable_is_an_answer(self):
        result = self.run_program("simulate", "--plant", "ipdt", "--kappa", "1.6", "--json")
        self.assertEqual((result.code, result.json["status"]), (0, "unstable"))
        self.assertTrue(all(value is None for value in result.json["measures"].values()))

    def test_a_filter_constant_alone_asks_for_a_first_order_filter_and_the_full_prefilter(self):
        result = self.run_program("simulate", *PPM47, "--tau-f", "0.1")
        self.assertIn("filter of order 1, prefilter full", result.out)

    def test_trace(self):
        result = self.run_program("simulate", *PPM47, "--horizon", "30", "--trace", "r.csv")
        self.assertEqual(result.err, "portrait: responses over 30 dead times written to r.csv\n")
        with open(self.folder / "r.csv") as file:
            rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
        times = [row["t"] for row in rows]
        self.assertEqual((times[0], times[-1]), (0, 30))
        self.assertEqual(times, sorted(times))
        at_one = [row for row in rows if row["t"] == 1.5]
        self.assertAlmostEqual(at_one[0]["y_d"], 0.5 ** 2 / 2, places=9)  # a disturbance of 1 through the double integrator

    def test_trace_that_cannot_be_written(self):
        result = self.run_program("simulate", *PPM47, "--trace", "no/such/folder/r.csv")
        self.assertEqual(result.code, 1)
        self.assertEqual(result.err, "portrait: no/such/folder/r.csv.tmp: No such file or directory\n")

    def test_note_on_full_without_filter(self):
        result = self.run_program("simulate", *PPM47, "--n", "0", "--prefilter", "full")
        self.assertEqual(result.err, 'portrait: note: with n = 0 the prefilter "full" does not cancel the zeros of the '
                                     'setpoint response; "pi" does\n')

    def test_wrong_arguments(self):
        base = ("simulate", "--plant", "dipdt", "--tau-i", "8")
        cases = [
            ((*base, "--kappa", "abc"), '--kappa: "abc" is not a number'),
            ((*base, "--kappa", "nan"), '--kappa: "nan" is not a number'),
            ((*base, "--kappa", "0"), "kappa must be finite and above 0 (it is 0)"),
            ((*base, "--kappa", "1", "--delta", "-1"), "delta must be finite and not below 0 (it is -1)"),
            ((*base, "--kappa", "1", "--delta", "1", "--tau-d", "1"), "--delta and --tau-d say the same: give one of the two"),
            ((*base, "--kappa", "1", "--tau-1", "1"), "--tau-1 has no place here: fotd has one, T1/Td"),
            ((*base, "--kappa", "1", "--n", "1"),
             "--tau-f is missing: a filter of order --n 1 or more has one, Tf/Td"),
            ((*base, "--kappa", "1", "--n", "0", "--tau-f", "1"),
             "--tau-f has no place here: a filter of order --n 1 or more has one, Tf/Td"),
            ((*base, "--kappa", "1", "--n", "17", "--tau-f", "1"), "n must be 0 .. 16 (it is 17)"),
            ((*base, "--kappa", "1", "--tau-f", "0"), "tau_f must be finite and above 0 (it is 0)"),
            ((*base, "--kappa", "1", "--horizon", "0"), '--horizon: "0" is neither a number of dead times above 0 nor auto'),
            ((*base, "--kappa", "1", "--horizon", "1e9"), "--horizon: at most 10000 dead times (it is 1e9)"),
            ((*base, "--kappa", "1", "--prefilter", "ful"), '--prefilter: unknown prefilter "ful" (did you mean "full"?)'),
            ((*base, "--kappa", "1", "--prefilter", "none", "--b", "1"),
             'b and c belong to a prefilter: with prefilter = "none" both must be 0'),
            (("simulate", "--plant", "fodt", "--kappa", "1"), '--plant: unknown plant "fodt" (did you mean "fotd"?)'),
            (("simulate", "--plant", "mass", "--kappa", "1"), '--plant: unknown plant "mass" (known: dipdt, ipdt, fotd, jotd, tf:NUM/DEN)'),
            (("simulate", "--plant", "fotd", "--kappa", "1"), "--tau-1 is missing: fotd has one, T1/Td"),
            (("simulate", "--plant", "ipdt", "--kappa", "2", "--trace", "r.csv"),
             "--trace of an unstable loop needs a fixed --horizon: its responses never settle"),
        ]
        for arguments, message in cases:
            with self.subTest(arguments=arguments):
                self.assert_fails(self.run_program(*arguments), 2, message)


if __name__ == "__main__":
    program.main()
