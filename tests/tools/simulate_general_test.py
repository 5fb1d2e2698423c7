"""portrait simulate beyond the normalised families, under noise, and portrait characteristic."""

import csv
import io
import math

import program
from program import ProgramTest

COLUMN = ("--plant", "tf:34/13.5,54.25,55,1", "--pid", "standard:Kc=0.783428,Ti=5.345232")
NOISY = ("--plant", "ipdt", "--kappa", "0.4", "--tau-i", "6", "--noise", "0.1", "--sampling", "0.05", "--horizon", "40")


class SimulateGeneral(ProgramTest):
    def measures(self, *arguments):
        result = self.run_program("simulate", *arguments, "--json")
        self.assertEqual((result.code, result.err), (0, ""))
        return result.json["measures"]

    def test_a_rational_plant_without_dead_time(self):
        answer = self.run_program("simulate", *COLUMN, "--json").json
        self.assertEqual(answer["status"], "settled")
        self.assertAlmostEqual(answer["measures"]["IAE_w"], 3.61553, places=4)
        self.assertAlmostEqual(answer["measures"]["IAE_d"], 6.82288, places=4)
        self.assertAlmostEqual(answer["measures"]["PM"], 43.611, places=3)
        self.assertAlmostEqual(answer["units"]["time"], 55, places=9)  # 54 + 0.5 + 0.5
        self.assertEqual(answer["units"]["gain"], 34)
        self.assertEqual(answer["method"], "reference")

    def test_units_do_not_matter(self):
        normalised = self.measures("--plant", "jotd", "--j", "3", "--tau-j", "1.5", "--kappa", "0.8", "--tau-i", "3",
                                   "--prefilter", "none")
        real = self.measures("--plant", "jotd", "--j", "3", "--tau-j", "3", "--Td", "2", "--K", "5",
                             "--pid", "standard:Kc=0.16,Ti=6")
        self.assertAlmostEqual(real["IAE_w"], 2 * normalised["IAE_w"], places=8)
        self.assertAlmostEqual(real["ITAE_d"], 5 * 4 * normalised["ITAE_d"], places=6)
        self.assertAlmostEqual(real["TV_uw"], normalised["TV_uw"] / 5, places=8)
        self.assertAlmostEqual(real["DM"], 2 * normalised["DM"], places=8)
        self.assertAlmostEqual(real["Ms"], normalised["Ms"], places=9)

    def test_the_same_loop_in_other_words(self):
        base = ("--plant", "fotd", "--tau-1", "2", "--n", "1", "--tau-f", "0.2", "--prefilter", "none")
        expected = self.run_program("simulate", *base, "--kappa", "0.9", "--tau-i", "2", "--delta", "0.36", "--method",
                                    "reference", "--json").json["measures"]
        for controller in (("--pid", "standard:Kc=0.9,Ti=2,TD=0.4"), ("--pid", "parallel:Kp=0.9,Ki=0.45,Kd=0.36"),
                           ("--gains", "0.45,0.9,0.36")):
            found = self.measures(*base, *controller)
            for name in ("IAE_w", "IAE_d", "TV_uw", "TV2_ud", "Ms", "GM"):
                self.assertAlmostEqual(found[name], expected[name], places=7, msg=(controller, name))
        found = self.measures("--plant", "tf:1/2,1", "--Td", "1", "--controller", "tf:0.36,0.9,0.45/0.2,1,0")
        self.assertAlmostEqual(found["IAE_d"], expected["IAE_d"], places=7)
        series = self.measures("--plant", "ipdt", "--pid", "series:Kc=0.3,Ti=5,TD=0.5", "--n", "1", "--tau-f", "0.1")
        standard = self.measures("--plant", "ipdt", "--pid", "standard:Kc=0.33,Ti=5.5,TD=0.45454545454545453", "--n", "1",
                                 "--tau-f", "0.1")
        self.assertAlmostEqual(series["IAE_w"], standard["IAE_w"], places=8)

    def test_weights_are_the_prefilter_that_cancels_the_zeros(self):
        pid = ("--plant", "ipdt", "--pid", "standard:Kc=0.5,Ti=6,TD=0.4", "--n", "1", "--tau-f", "0.1")
        weighted = self.measures(*pid, "--weights", "b=0.5,c=0")
        filtered = self.measures(*pid, "--prefilter", "full", "--b", "3")
        for name in ("IAE_w", "TV_uw", "TV2_yw", "IAE_d"):
            self.assertAlmostEqual(weighted[name], filtered[name], places=7, msg=name)

    def test_steps_have_sizes(self):
        one = self.measures(*COLUMN)
        two = self.measures(*COLUMN, "--step", "w=2,d=-3")
        self.assertAlmostEqual(two["IAE_w"], 2 * one["IAE_w"], places=9)
        self.assertAlmostEqual(two["ISE_d"], 9 * one["ISE_d"], places=8)
        self.assertAlmostEqual(two["TV_uw"], 2 * one["TV_uw"], places=9)

    def test_trace_has_the_output_step(self):
        self.run_program("simulate", *COLUMN, "--horizon", "20", "--trace", "r.csv")
        with open(self.folder / "r.csv") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(list(rows[0]), ["t", "y_w", "u_w", "y_d", "u_d", "y_o", "u_o"])
        self.assertEqual((float(rows[0]["y_o"]), float(rows[0]["t"])), (1, 0))
        self.assertAlmostEqual(float(rows[0]["u_o"]), -0.783428, places=9)
        self.assertAlmostEqual(float(rows[-1]["t"]), 20, places=6)

    def test_noise_is_reproducible_and_comes_to_what_is_expected(self):
        first, again = (self.run_program("simulate", *NOISY, "--seeds", "20", "--json").json["noise"] for _ in range(2))
        self.assertEqual(first, again)
        sigma = first["sigma_ratio"]
        self.assertAlmostEqual(sigma["simulated"]["mean"], sigma["expected"], delta=0.05 * sigma["expected"])
        self.assertGreater(first["w"]["TV_u"]["spread"], 0)
        other = self.run_program("simulate", *NOISY, "--seed", "2", "--json").json["noise"]
        self.assertNotEqual(other["w"]["TV_u"]["mean"], first["w"]["TV_u"]["mean"])
        # Neighbouring uniform values in +-0.1 differ by 0.2/3 on average, and u answers to them by its gain of 0.4.
        self.assertAlmostEqual(first["w"]["TV_u"]["mean"], 800 * 0.4 * 0.2 / 3, delta=2)

    def test_a_sampled_controller_under_noise(self):
        noise = self.run_program("simulate", *NOISY, "--noise-kind", "gaussian", "--sampled", "--json").json["noise"]
        self.assertEqual(noise["controller"], "sampled")
        self.assertAlmostEqual(noise["d"]["TV_u"]["mean"], 800 * 0.4 * 0.1 * 2 / math.sqrt(math.pi), delta=3)

    def test_a_sampling_time_that_does_not_divide_the_dead_time_is_said(self):
        says = "the sampling time does not divide the dead time: nothing is rounded"
        base = [*NOISY]
        at = base.index("--sampling") + 1
        odd = base[:at] + ["0.03"] + base[at + 1:]
        for controller in ((), ("--sampled",)):
            self.assertIn(says, self.run_program("simulate", *odd, *controller).out)
            self.assertNotIn(says, self.run_program("simulate", *base, *controller).out)
        near = base[:at] + ["0.05"] + base[at + 1:]
        found = [self.run_program("simulate", *line, "--sampled", "--json").json["noise"] for line in (odd, near)]
        self.assertEqual([n["sampling_divides_dead_time"] for n in found], [False, True])

    def test_wrong_arguments(self):
        tf = ("simulate", "--plant", "tf:1/1,1")
        pid = ("--pid", "standard:Kc=1,Ti=1")
        cases = [
            (("simulate", "--plant", "tf:1,1,1/1,1", *pid),
             "the plant is improper: its numerator has degree 2, its denominator 1"),
            (("simulate", "--plant", "tf:1,2/1,1", *pid),
             "an algebraic loop: without dead time plant and controller both answer at once; give one of them a lag, or "
             "the plant a dead time"),
            ((*tf, "--controller", "tf:1,1,1/1,1"), "--controller: improper, degree 2 over 1"),
            (("simulate", "--plant", "tf:1/1,-1", "--controller", "tf:1,-1/1,1"),
             "a zero of the controller cancels an unstable pole of the plant at s = 1: the loop is unstable inside"),
            (("simulate", "--plant", "tf:1", *pid),
             '--plant: "tf:1" is not of the form tf:NUM/DEN, as tf:34/13.5,54.25,55,1'),
            (("simulate", "--plant", "tf:1/1,x", *pid), '--plant: "x" is not a number'),
            (("simulate", "--plant", "tf:1/0", *pid), "--plant: the denominator is 0"),
            ((*tf, "--gains", "1,2,3"), "--gains up to K_1 need a filter of order --n 1 or more (it is 0)"),
            ((*tf, "--pid", "standrad:Kc=1"), '--pid: unknown form "standrad" (did you mean "standard"?)'),
            ((*tf, "--pid", "standard:Ti=1"), "--pid: Kc is missing"),
            ((*tf, *pid, "--prefilter", "tf:1/1,-1"), "the prefilter has a pole at s = 1: it is not stable"),
            ((*tf, *pid, "--method", "kernel"),
             "--method kernel: here only of dipdt, ipdt and fotd; jotd and gains it sweeps from a grid file; leave --method out"),
            ((*tf,), "the controller is given by one of --kappa (with --tau-i, --delta), --pid, --gains, --controller"),
            (("simulate", "--plant", "jotd", "--j", "9", "--tau-j", "1", "--kappa", "1"),
             "--j: jotd has 1 to 8 equal lags (it is 9)"),
            (("simulate", "--plant", "jotd", "--j", "2", "--kappa", "1"), "--tau-j is missing: jotd has one"),
            ((*tf, *pid, "--noise", "0.1", "--horizon", "5"),
             "--noise needs --sampling: the time over which a value is held"),
            ((*tf, *pid, "--noise", "0.1", "--sampling", "0.1"),
             "--noise needs a fixed --horizon: TV of a noisy signal grows with it"),
            (("simulate", "--plant", "dipdt", "--kappa", "0.1", "--delta", "0.5", "--noise", "1", "--sampling", "0.1",
              "--horizon", "9"),
             "--noise: the ideal derivative makes an impulse of every value; give the controller a filter"),
        ]
        for arguments, message in cases:
            with self.subTest(arguments=arguments):
                self.assert_fails(self.run_program(*arguments), 2, message)


class Characteristic(ProgramTest):
    def test_csv_and_json(self):
        line = ("characteristic", "--plant", "fotd", "--tau-1", "1", "--pid", "standard:Kc={},Ti=1", "--vary", "0.3:0.7:5",
                "--k", "2")
        rows = list(csv.DictReader(io.StringIO(self.run_program(*line).out)))
        self.assertEqual([row["value"] for row in rows], ["0.3", "0.4", "0.5", "0.6", "0.7"])
        # Ti = T1 cancels the plant: without overshoot IAE_d = Ti/Kc.
        self.assertAlmostEqual(float(rows[0]["IAE_d"]), 1 / 0.3, places=6)
        for row in rows:
            self.assertAlmostEqual(float(row["J"]), float(row["IAE_d"]) ** 2 * float(row["TV1_ud"]), places=12)
        efforts = [float(row["TV1_ud"]) for row in rows]
        self.assertEqual(efforts, sorted(efforts))
        points = self.run_program(*line, "--json").json["points"]
        self.assertEqual([p["IAE_d"] for p in points], [float(row["IAE_d"]) for row in rows])

    def test_wrong_arguments(self):
        base = ("characteristic", "--plant", "ipdt", "--tau-i", "8")
        for arguments, message in [
            ((*base, "--kappa", "0.5", "--vary", "1,2"), "--vary: there is no {} on the line for it to stand for"),
            ((*base, "--kappa", "{}", "--vary", "1:2"), '--vary: "1:2" is neither FROM:TO:COUNT nor a list'),
            ((*base, "--kappa", "{}", "--vary", "0.5", "--effort", "TV1_u"),
             '--effort: unknown measure "TV1_u" (did you mean "TV1_ud"?)'),
        ]:
            with self.subTest(arguments=arguments):
                result = self.run_program(*arguments)
                self.assertEqual(result.code, 2)
                self.assertTrue(result.err.startswith("portrait: " + message.split(" (did")[0]), result.err)


if __name__ == "__main__":
    program.main()
