"""portrait tune."""

import json
import math

import program
from program import ProgramTest

PLANT = ("--plant", "dipdt")


class Tune(ProgramTest):
    def tune(self, *arguments):
        result = self.run_program("tune", *arguments, "--json")
        self.assertEqual((result.code, result.err), (0, ""))
        return result.json

    def test_qrdp_in_normalised_numbers(self):
        answer = self.tune("huba2022-qrdp", *PLANT)
        self.assertAlmostEqual(answer["settings"]["kappa"], 0.1247851303, places=9)
        self.assertAlmostEqual(answer["measures"]["IAE_w"], 7.918024, places=5)  # Huba2022 (27)
        self.assertAlmostEqual(answer["measures"]["IAE_d"], 82.7276, places=3)
        self.assertAlmostEqual(answer["found"]["p_o"], -0.415774556783, places=11)
        self.assertEqual(answer["status"], "settled")

    def test_real_units_scale_controller_and_measures(self):
        unit = self.tune("huba2022-qrdp", *PLANT, "--Tf", "0.1")
        real = self.tune("huba2022-qrdp", *PLANT, "--K", "2", "--Td", "0.5", "--Tf", "0.05")
        self.assertAlmostEqual(real["controller"]["standard"]["Kc"], unit["controller"]["standard"]["Kc"] / (2 * 0.25), places=12)
        self.assertAlmostEqual(real["measures"]["IAE_w"], 0.5 * unit["measures"]["IAE_w"], places=9)
        self.assertAlmostEqual(real["measures"]["IAE_d"], 0.5 * 0.5 * unit["measures"]["IAE_d"], places=9)
        self.assertAlmostEqual(real["measures"]["Ms"], unit["measures"]["Ms"], places=9)

    def test_the_simulate_line_gives_the_same_measures(self):
        answer = self.tune("huba2022-mfrp2", *PLANT, "--m", "3", "--Tf", "0.1", "--cancel", "To+mTo")
        again = self.run_program(*answer["simulate"].split()[1:], "--json").json
        for name, value in answer["measures"].items():
            if name != "noise_gain":
                self.assertAlmostEqual(value, again["measures"][name], places=9, msg=name)

    def test_forms_agree(self):
        controller = self.tune("isimc-pid", "--plant", "ipdt", "--K", "0.5", "--Td", "2")["controller"]
        p, s = controller["parallel"], controller["series"]
        self.assertAlmostEqual(p["Kp"], s["Kc"] * (1 + s["TD"] / s["Ti"]))
        self.assertAlmostEqual(p["Kd"], s["Kc"] * s["TD"])
        self.assertEqual(controller["transfer_function"]["numerator"], [p["Kd"], p["Kp"], p["Ki"]])

    def test_a_plant_as_a_transfer_function(self):
        answer = self.tune("dalen2018-prc", "--plant", "tf:34/13.5,54.25,55,1", "--delta", "1.63")
        self.assertAlmostEqual(answer["found"]["k"], 0.59685, places=5)
        self.assertAlmostEqual(answer["found"]["tau"], 0.92310, places=5)
        same = self.tune("ho-pid", "--plant", "tf:1/1,4,6,4,1", "--Td", "0.5", "--m", "1", "--Tf", "0.1")
        jotd = self.tune("ho-pid", "--plant", "jotd", "--j", "4", "--Tj", "1", "--Td", "0.5", "--m", "1", "--Tf", "0.1")
        self.assertAlmostEqual(same["found"]["K_1"], jotd["found"]["K_1"], places=9)

    def test_list(self):
        text = self.run_program("tune", "--list").out
        for rule in ("huba2022-qrdp", "dalen2018-pareto", "huba2021-jrm", "ho-pid", "kos2021-pid-fh", "amigo-pid"):
            self.assertIn(rule, text)
        one = self.run_program("tune", "ho-pid", "--list", "--json").json
        self.assertEqual([rule["name"] for rule in one], ["ho-pid"])
        self.assertIn("KHF", [option["name"] for option in one[0]["options"]])
        everything = self.run_program("tune", "--list", "--json").json
        self.assertEqual(len(everything), len(text.splitlines()))

    def step_record(self, noise=0.0, end=40):
        """Of 2 e^(-0.5 s)/(3 s + 1) after a step of 1.5 at t = 4, level 1."""
        rows = ["t,u,y"]
        for i in range(int(end / 0.05) + 1):
            t = 0.05 * i
            x = t - 4.5
            y = 1 + (3 * (1 - math.exp(-x / 3)) if x > 0 else 0) + noise * ((i * 7919 % 101 - 50) / 50)
            rows.append(f"{t:.2f},{1.5 if t > 3.999 else 0},{y:.12g}")
        return self.write("step.csv", "\n".join(rows) + "\n")

    def test_from_a_record_to_a_controller(self):
        self.step_record()
        answer = self.tune("simc-pi", "--plant", "fotd", "--response", "step.csv")
        known = self.tune("simc-pi", "--plant", "fotd", "--K", "2", "--Td", "0.5", "--T1", "3")
        self.assertAlmostEqual(answer["record"]["T1"], 3, places=4)
        self.assertAlmostEqual(answer["record"]["Td"], 0.5, places=4)
        self.assertAlmostEqual(answer["controller"]["standard"]["Kc"], known["controller"]["standard"]["Kc"], places=3)
        self.assertAlmostEqual(answer["measures"]["IAE_d"], known["measures"]["IAE_d"], places=3)

    def test_areas_of_a_record(self):
        self.step_record(end=60)
        answer = self.tune("ho-pid", "--plant", "self-regulating", "--response", "step.csv", "--m", "0")
        known = self.tune("ho-pid", "--plant", "fotd", "--K", "2", "--Td", "0.5", "--T1", "3", "--m", "0")
        self.assertAlmostEqual(answer["found"]["K_-1"] / known["found"]["K_-1"], 1, places=2)
        self.assertIsNone(answer["measures"])

    def test_a_record_alone_is_shown(self):
        self.step_record(noise=0.02)
        record = self.run_program("tune", "--plant", "fotd", "--response", "step.csv", "--json").json
        self.assertAlmostEqual(record["residual"], 0.02 / math.sqrt(3), places=2)
        self.assertEqual(record["remarks"], [])

    def test_missing_samples_and_noise_are_told(self):
        lines = self.step_record(noise=0.05).read_text().splitlines()
        self.write("gap.csv", "\n".join(lines[:300] + lines[310:]) + "\n")
        record = self.run_program("tune", "--plant", "fotd", "--response", "gap.csv", "--json").json
        self.assertEqual(record["remarks"], ["about 10 samples are missing after t = 14.9: y is taken as a straight line, u as held there"])
        self.assertAlmostEqual(record["T1"], 3, places=1)
        self.assertAlmostEqual(record["residual"], 0.05 / math.sqrt(3), places=2)

    def test_bad_records(self):
        self.step_record(end=9)
        result = self.run_program("tune", "ho-pid", "--plant", "self-regulating", "--response", "step.csv", "--Tf", "1")
        self.assertEqual(result.code, 2)
        self.assertIn("y has not come to rest at the end of the record", result.err)
        self.write("bad.csv", "time,u,y\n0,0,0\n")
        self.assert_fails(self.run_program("tune", "simc-pi", "--plant", "fotd", "--response", "bad.csv"), 2,
                          'bad.csv:1: no column "t": the header must name t, u and y (it has time, u, y)')
        self.assert_fails(self.run_program("tune", "simc-pi", "--plant", "fotd", "--response", "none.csv"), 2,
                          "none.csv: No such file or directory")
        self.assert_fails(self.run_program("tune", "simc-pi", "--plant", "fotd", "--K", "1", "--response", "bad.csv"), 2,
                          "--K, --Td and --T1 have no place here: the plant comes from --response")

    def test_rules_on_a_portrait(self):
        self.small_portrait()
        ask = ("query", "small.h5", "--minimize", "IAE_d", "--where", "Ms <= 4", "--rules", "--json", "--include-not-settled")
        answer = self.run_program(*ask).json
        rules = {rule["rule"]: rule for rule in answer["rules"]}
        qrdp = rules["huba2022-qrdp"]
        self.assertAlmostEqual(qrdp["settings"]["kappa"], 0.1247851303, places=9)
        self.assertEqual(qrdp["admissible"], True)
        self.assertEqual(qrdp["off_axes"], [])
        self.assertAlmostEqual(qrdp["regret"], qrdp["objective"] / answer["optimum"]["objective"], places=12)
        alone = self.run_program("simulate", "--plant", "dipdt", "--kappa", "0.1247851303442644", "--tau-i", "10.32317310326287",
                                 "--delta", "0.504541802196353", "--horizon", "40", "--json").json
        self.assertAlmostEqual(qrdp["objective"], alone["measures"]["IAE_d"], places=6)
        self.assertFalse(rules["ho-pid"]["applicable"])
        strict = self.run_program(*ask, "--where", "Ms <= 1.1").json
        self.assertIn("Ms <= 1.1", {r["rule"]: r for r in strict["rules"]}["huba2022-qrdp"]["violated"])

    def test_every_precondition_is_named(self):
        """What a rule lacks, one case a sentence of engine/rules, as the program says it."""
        lag, no_delay = ("--plant", "fotd", "--T1", "1"), ("--plant", "fotd", "--T1", "1", "--Td", "0")
        oscillating, pure = ("--plant", "tf:1/1,0.1,1"), ("--plant", "ipdt", "--Td", "0")
        cases = [
            (("dalen2018-delta", *pure), "without dead time the margin must be given in time: --dtau"),
            (("dalen2018-delta", *PLANT), 'it needs an ipdt or a fotd plant, and "dipdt" is neither'),
            (("dalen2018-delta-ms", "--plant", "ipdt", "--cbar", "2", "--Ms", "1.0001"),
             "no PI with cbar = 2 has Ms = 1.0001: it is higher for all"),
            (("dalen2018-pade", *pure), "it needs a dead time above 0"),
            (("dalen2018-prc", "--plant", "tf:1,2/1,1", "--Td", "1"),
             "the step response of the plant jumps: it has no steepest tangent"),
            (("dalen2018-prc", *PLANT), "the step response of the plant grows ever steeper"),
            (("dalen2018-prc", *no_delay), "the tangent of the step response has no lag: there is no dead time to tune by"),
            (("dalen2018-pareto", "--plant", "ipdt", "--sr", "1"),
             "on an integrating plant sr = 1 ends in P control: give --sr below 1"),
            (("dalen2018-pareto", *PLANT), 'it needs an ipdt or a fotd plant, and "dipdt" is neither'),
            (("simc-pi", *PLANT), "a PI does not stabilise two integrators: simc-pid does"),
            (("simc-pi", *oscillating), 'it needs a plant of real lags without zeros, and "tf:1/1,0.1,1" is none'),
            (("simc-pi", *no_delay), "without dead time Tc must be given: --Tc"),
            (("isimc-pid", *PLANT), "it needs a plant with at most one integrator: simc-pid takes two"),
            (("imc-pi", *pure), "without dead time Tc must be given: --Tc"),
            (("zn-pi", *oscillating), 'it needs a plant of real lags without zeros or integrators, and "tf:1/1,0.1,1" is none'),
            (("tyreus-luyben-pi", *no_delay), "it needs a dead time above 0"),
            (("amigo-pi", *no_delay), "it needs a dead time above 0"),
            (("kappa-tau-pi", *lag), "it needs a plant with one integrator"),
            (("kappa-tau-pi", "--plant", "tf:1,2,1/1,1,0"), "the plant without its integrator must not jump"),
            (("kappa-tau-pi", *pure), "the plant without its integrator has no steepest tangent"),
            (("taguchi-pi", "--plant", "tf:1/2,3,1,0", "--Td", "1"),
             "besides the integrator it takes no lag, one, or two equal ones"),
            (("ho-pid", *lag, "--m", "0", "--n", "0", "--KHF", "3", "--Ts", "0.1"),
             "a noise gain needs a filter: --n 1 or more"),
            (("ho-pid", *lag, "--m", "1", "--n", "1", "--KHF", "0.001", "--Ts", "0.1"),
             "no filter constant gives this noise gain with gains that are optimal for it"),
            (("ho-pid", *no_delay, "--m", "0"),
             "the controller could cancel the whole plant, and no finite gains are optimal: give a filter, or a lower --m"),
            (("huba2021-jrm", "--plant", "ipdt"), 'it needs a stable plant of real lags without zeros, and "ipdt" is none'),
            (("huba2021-jrm", *lag, "--lags", "2"), "--lags 2: the plant has 1"),
            (("huba2021-jrm", *lag, "--lags", "0"), "--lags 0 is for a plant that is a dead time alone"),
            (("huba2021-jrm", *no_delay), "without dead time Tc must be given: --Tc"),
            (("huba2022-trdp", "--plant", "dipdt", "--Td", "0"), "it needs a dead time above 0"),
            (("kos2021-pi", *lag), 'it needs a plant with one integrator, and "fotd" has 0'),
            (("kos2021-pi", *pure), "the area A_1 is 0: an integrator alone has no optimum"),
            (("kos2021-pi", "--plant", "tf:1/10,0.1,1,0"),
             "A_1^2 + (1 - b^2)(A_0 A_2 - A_1^2) < 0, the gain would be complex: the plant oscillates too much"),
            (("kos2021-pid", "--plant", "ipdt"), "its controller has a filter: give --Tf, or --KHF for Kd/Tf"),
            (("kos2021-pid", "--plant", "ipdt", "--KHF", "1e-9"), "no filter constant gives Kd/Tf = 1e-09"),
            (("kos2021-pid-fh", "--plant", "tf:1,1/1,0.2,1,0", "--Tf", "0.1"),
             "the quartic (5.11) for Ti has no positive root: the plant oscillates too much"),
        ]
        for arguments, message in cases:
            with self.subTest(arguments=arguments):
                self.assert_fails(self.run_program("tune", *arguments), 2, f"{arguments[0]}: {message}")

    def test_wrong_input(self):
        cases = [
            (("huba2022-qrpd", *PLANT), 'unknown rule "huba2022-qrpd" (did you mean "huba2022-qrdp"?)'),
            (("astrology", *PLANT), 'unknown rule "astrology": portrait tune --list shows them all'),
            ((), "which rule? portrait tune --list shows them all"),
            (("zn-pi",), "--plant is missing: dipdt, ipdt, fotd, jotd or tf:NUM/DEN"),
            (("zn-pi", "--plant", "fodt"), '--plant: unknown plant "fodt" (did you mean "fotd"?)'),
            (("zn-pi", "--plant", "fotd"), "--T1 is missing: fotd has one"),
            (("zn-pi", "--plant", "ipdt", "--T1", "2"), "--T1 has no place here: ipdt has none"),
            (("zn-pi", "--plant", "ipdt", "--Td", "-1"), "--Td must be finite and not below 0 (it is -1)"),
            (("zn-pi", "--plant", "ipdt", "--K", "0"), "--K must be finite and not 0 (it is 0)"),
            (("zn-pi", "--plant", "ipdt", "--m", "2"), "--m has no place here: zn-pi has no options"),
            (("ho-pid", "--plant", "tf:1,2,3/1,2", "--Tf", "1"), "--plant: more zeros than poles: the plant is improper"),
            (("ho-pid", "--plant", "tf:1/1,x", "--Tf", "1"), '--plant: "x" is not a number'),
            (("ho-pid", "--plant", "tf:1", "--Tf", "1"), '--plant: "1" is not of the form tf:NUM/DEN, as tf:34/13.5,54.25,55,1'),
            (("ho-pid", "--plant", "tf:1,0/1,1", "--Tf", "1"),
             "--plant: the plant has a zero at s = 0: no controller brings it to a setpoint"),
            (("ho-pid", "--plant", "tf:1/1,2,1", "--m", "1", "--n", "1", "--Tf", "0"), "--Tf must be above 0 (it is 0)"),
            (("huba2022-mfrp1", *PLANT, "--m", "two"), '--m: "two" is not a number'),
            (("huba2022-mfrp1", *PLANT, "--cancel", "all"),
             '--cancel: unknown "all" (known: none, To, mTo, 2To, 2mTo, To+mTo)'),
            (("dalen2018-pareto", "--plant", "ipdt", "--Ms", "0.9"),
             "dalen2018-pareto: Ms is above 1 for every loop (asked for: 0.9)"),
        ]
        for arguments, message in cases:
            with self.subTest(arguments=arguments):
                self.assert_fails(self.run_program("tune", *arguments), 2, message)


if __name__ == "__main__":
    program.main()
