"""portrait query: text, JSON, CSV, real units, nothing admissible."""

import csv
import io

import program
from program import ProgramTest


class Query(ProgramTest):
    def setUp(self):
        super().setUp()
        self.portrait = self.small_portrait()

    def query(self, *arguments):
        return self.run_program("query", self.portrait, *arguments)

    def test_json_form(self):
        result = self.query("--minimize", "IAE_w + IAE_d", "--where", "TV2_ud <= 0.1", "--top", "2", "--json")
        answer = result.json
        self.assertEqual((result.code, result.err), (0, ""))
        self.assertEqual(answer["total"], 27)
        self.assertEqual(answer["optimum"], answer["top"][0])
        self.assertEqual(len(answer["top"]), 2)
        self.assertEqual(set(answer["optimum"]["settings"]), {"kappa", "tau_i", "delta", "tau_d", "b"})
        self.assertLessEqual(answer["optimum"]["measures"]["TV2_ud"], 0.1)
        for active in answer["active"]:
            self.assertLess(active["objective_without"], answer["optimum"]["objective"])

    def test_json_equals_simulate(self):
        grid = program.SMALL_GRID.replace("n = 0", "n = 1\nsampling = 0.1") + "tau_f = 0.2\n"
        self.write("noise.toml", grid)
        self.run_program("sweep", "noise.toml", "-o", "noise.h5", "--quiet")
        best = self.run_program("query", "noise.h5", "--minimize", "IAE_w", "--json").json["optimum"]
        s = best["settings"]
        simulated = self.run_program("simulate", "--plant", "dipdt", "--kappa", s["kappa"], "--tau-i", s["tau_i"], "--delta",
                                     s["delta"], "--tau-f", "0.2", "--horizon", "40", "--sampling", "0.1", "--json").json
        self.assertEqual(best["measures"], {name: simulated["measures"][name] for name in best["measures"]})
        self.assertGreater(best["measures"]["noise_gain"], 0)

    def test_noise_gain_is_not_stored_without_sampling(self):
        self.assertNotIn("noise_gain", self.query("--minimize", "IAE_w", "--json").json["optimum"]["measures"])
        self.assertIsNone(self.run_program("info", self.portrait, "--json").json["sampling"])

    def test_real_units(self):
        K, Td = 3.0, 0.5
        plain = self.query("--minimize", "IAE_d", "--where", "delta == 0.55", "--where", "Ms <= 3", "--json").json["optimum"]
        real = self.query("--minimize", "IAE_d", "--where", "delta == 0.55", "--where", "Ms <= 3", "--plant", f"K={K},Td={Td}",
                          "--json").json
        optimum = real["optimum"]
        self.assertEqual(optimum["settings"], plain["settings"])
        self.assertAlmostEqual(optimum["measures"]["IAE_d"], plain["measures"]["IAE_d"] * K * Td ** 3, places=9)
        self.assertAlmostEqual(optimum["measures"]["TV_uw"], plain["measures"]["TV_uw"] / (K * Td ** 2), places=9)
        standard = optimum["controller"]["standard"]
        self.assertAlmostEqual(standard["Kc"], plain["settings"]["kappa"] / (K * Td ** 2))
        self.assertAlmostEqual(standard["Ti"], plain["settings"]["tau_i"] * Td)
        parallel = optimum["controller"]["parallel"]
        self.assertAlmostEqual(parallel["Kd"], plain["settings"]["delta"] / (K * Td))
        self.assertEqual(real["units"], "real")

    def test_bounds_are_in_real_units(self):
        bound = self.query("--minimize", "IAE_d", "--json").json["optimum"]["measures"]["u_max_w"] * 0.9
        plain = self.query("--minimize", "IAE_d", "--where", f"u_max_w <= {bound}", "--json").json
        real = self.query("--minimize", "IAE_d", "--where", f"u_max_w <= {bound / 4}", "--plant", "K=4,Td=1", "--json").json
        self.assertEqual(plain["optimum"]["settings"], real["optimum"]["settings"])
        self.assertEqual(plain["admissible"], real["admissible"])

    def test_text_names_formulas_and_units(self):
        result = self.query("--minimize", "IAE_d", "--where", "Ms <= 2.5", "--plant", "K=3,Td=0.5")
        self.assertEqual(result.code, 0)
        for part in ("controller for K e^(-Td s)/s^2, K = 3, Td = 0.5", "Kp + Ki/s + Kd s", "Kc (1 + 1/(Ti s) + TD s)",
                     "real units, unit steps"):
            self.assertIn(part, result.out)

    def test_says_which_unit_each_bound_is_in(self):
        arguments = ("--minimize", "IAE_d", "--where", "Kc <= 3", "--where", "u_max_w <= 10", "--where", "tau_i >= 8", "--where",
                     "Ms <= 3", "--plant", "K=3,Td=0.5", "--step", "w=2,d=0.25")
        result = self.query(*arguments)
        for line in ("Kc <= 3         Kc: real, unit of u per unit of y\n",
                     "u_max_w <= 10   u_max_w: real, unit of u, for a step of 2 in the setpoint\n",
                     "tau_i >= 8      tau_i: normalised, Ti/Td\n", "Ms <= 3         Ms: a pure number\n",
                     "real units, steps w = 2, d = 0.25"):
            self.assertIn(line, result.out)
        answer = self.query(*arguments, "--json").json
        self.assertEqual(answer["steps"], {"w": 2, "d": 0.25})
        self.assertEqual(answer["constraints"][0], {"constraint": "Kc <= 3", "units": {"Kc": "real, unit of u per unit of y"}})

    def test_values_of_the_controller_need_a_plant(self):
        self.assert_fails(self.query("--minimize", "IAE_d", "--where", "Kc <= 3"), 2,
                          "--where:1:1: Kc is in the units of a real plant: say which, with --plant K=..,Td=..\n  Kc <= 3\n  ^")
        self.assert_fails(self.query("--minimize", "IAE_d", "--where", "Tf <= 3", "--plant", "K=1,Td=1"), 2,
                          "--where:1:1: this portrait has no filter, so there is no Tf\n  Tf <= 3\n  ^")

    def test_controller_values_are_those_of_the_answer(self):
        for name, form, key in (("Kc", "standard", "Kc"), ("Ti", "standard", "Ti"), ("TD", "standard", "TD"),
                                ("Ki", "parallel", "Ki"), ("Kd", "parallel", "Kd")):
            best = self.query("--minimize", name, "--plant", "K=3,Td=0.5", "--json").json["optimum"]
            self.assertAlmostEqual(best["objective"], best["controller"][form][key], places=12)

    def test_steps_scale_what_is_linear_and_what_is_squared(self):
        plain = self.query("--minimize", "IAE_d", "--json").json["optimum"]["measures"]
        large = self.query("--minimize", "IAE_d", "--step", "w=2,d=3", "--json").json["optimum"]["measures"]
        for name, factor in (("IAE_w", 2), ("ISE_w", 4), ("TV_uw", 2), ("IAE_d", 3), ("ISE_d", 9), ("ITSE_d", 9), ("y_max_d", 3),
                             ("Ms", 1), ("DM", 1)):
            self.assertAlmostEqual(large[name], factor * plain[name], delta=1e-12 * large[name])

    def test_price_of_an_active_constraint(self):
        bound = sorted(float(row["Ms"]) for row in csv.DictReader(io.StringIO(
            self.query("--minimize", "Ms", "--top", "100", "--csv").out)))[3]
        answer = self.query("--minimize", "IAE_d", "--where", f"Ms <= {bound}", "--json").json
        (active,) = answer["active"]
        self.assertGreater(active["loosened"]["value"], bound)
        self.assertAlmostEqual(active["loosened"]["by"], active["loosened"]["value"] / bound - 1)
        again = self.query("--minimize", "IAE_d", "--where", f"Ms <= {active['loosened']['value']}", "--json").json
        self.assertEqual(again["optimum"]["objective"], active["loosened"]["objective"])

    def test_front(self):
        result = self.query("--pareto", "IAE_w,min(IAE_d, 1e9)", "--where", "Ms <= 4")
        self.assertEqual(result.code, 0)
        self.assertRegex(result.out, r"^\d+ of \d+ admissible settings are on the front of +IAE_w +min\(IAE_d, 1e9\)\n")
        self.assertIn("  knee", result.out)
        answer = self.query("--pareto", "IAE_w,IAE_d", "--points", "2", "--json").json
        self.assertEqual(answer["front"], sorted(answer["front"]))
        self.assertEqual([second for _, second in answer["front"]], sorted((b for _, b in answer["front"]), reverse=True))
        self.assertLessEqual(len(answer["subset"]), 2)
        rows = list(csv.DictReader(io.StringIO(self.query("--pareto", "IAE_w,IAE_d", "--csv").out)))
        self.assertEqual(len(rows), len(answer["front"]))

    def test_refine_shows_the_gain_and_warns(self):
        answer = self.query("--minimize", "IAE_w + IAE_d", "--where", "TV2_ud <= 0.1", "--refine", "--json")
        refined = answer.json["refined"]
        self.assertLess(refined["objective"], answer.json["optimum"]["objective"])
        self.assertLessEqual(refined["measures"]["TV2_ud"], 0.1)
        self.assertAlmostEqual(refined["gain"], 1 - refined["objective"] / answer.json["optimum"]["objective"], places=9)
        self.assertEqual(refined["grid_too_coarse"], refined["gain"] > 0.05)
        text = self.query("--minimize", "IAE_w + IAE_d", "--where", "TV2_ud <= 0.1", "--refine", "--coarse", "0.001")
        self.assertIn("better than the grid", text.out)
        self.assertIn("the grid is too coarse here", text.err)

    def test_edge_of_the_grid(self):
        result = self.query("--minimize", "kappa")
        self.assertIn("the optimum lies on the edge of the grid (kappa", result.err)

    def test_why_not(self):
        setting = "kappa=0.2,delta=0.5,tau_i=9"
        result = self.query("--why", setting, "--where", "Ms <= 1.2", "--where", "tau_i <= 9", "--minimize", "IAE_d")
        self.assertEqual(result.code, 0)
        self.assertRegex(result.out, r"  fails  Ms <= 1.2: [\d.]+ against 1.2, [\d.]+ % away\n  holds  tau_i <= 9: 9 against 9, 0 %")
        answer = self.query("--why", setting, "--where", "Ms <= 3", "--json").json
        simulated = self.run_program("simulate", "--plant", "dipdt", "--kappa", "0.2", "--delta", "0.5", "--tau-i", "9",
                                     "--horizon", "40", "--json").json
        self.assertEqual(answer["measures"]["Ms"], simulated["measures"]["Ms"])
        self.assertEqual(answer["constraints"][0]["value"], simulated["measures"]["Ms"])
        self.assert_fails(self.query("--why", "kappa=0.2"), 2, "--why: delta is missing, an axis of the portrait")
        self.assert_fails(self.query("--why", "kapa=0.2"), 2, '--why: unknown parameter "kapa" (did you mean "kappa"?)')

    def test_region(self):
        result = self.query("--region", "--where", "IAE_d <= 1000")
        self.assertRegex(result.out, r"^\d+ of 27 settings are admissible")
        answer = self.query("--region", "--json").json
        self.assertEqual(sum(answer["axes"]["kappa"]["counts"]), answer["admissible"])
        self.assertEqual(sum(piece["settings"] for piece in answer["pieces"]), answer["admissible"])
        self.assertIn("  one piece: ", self.query("--region", "--where", "tau_i == 8", "--where", "kappa >= 0.2").out)
        apart = self.query("--region", "--where", "(kappa - 0.16)^2 >= 1e-6")
        self.assertRegex(apart.out, r"\n  \d separate pieces \(steps along one axis at a time\)\n    \d+ settings: ")

    def test_uncertain_plant(self):
        asked = ("--minimize", "IAE_d", "--where", "Ms <= 4", "--uncertain", "K=1.9..2.1,Td=0.48..0.52")
        result = self.query(*asked)
        self.assertEqual((result.code, result.err), (0, ""))
        self.assertRegex(result.out, r"^IAE_d, worst over K in 1.9..2.1, Td in 0.48..0.52: [\d.]+ at kappa=.* \(nominal .*K = 2, Td = 0.5\)")
        self.assertRegex(result.out, r"\n  Ms <= 4  worst [\d.]+ at K=2.1 Td=0.52: [\d.]+ % to spare, nowhere less than [\d.]+ %\n")
        self.assertRegex(result.out, r"\n  its patch of the portrait: kappa [\d.]+\.\.[\d.]+, ")
        self.assertIn("1000 plants more, spread evenly over the box: none breaks a constraint", result.out)
        self.assertIn("controller for K e^(-Td s)/s^2, K = 2, Td = 0.5", result.out)
        answer = self.query(*asked, "--json").json
        over = answer["optimum"]["over_box"]
        self.assertTrue(over["guaranteed"])
        (constraint,) = over["constraints"]
        self.assertEqual(constraint["plant"], {"family": "dipdt", "K": 2.1, "Td": 0.52})
        self.assertAlmostEqual(constraint["excess"], constraint["value"] / 4 - 1)
        self.assertLessEqual(constraint["excess"], constraint["excess_at_most"])
        self.assertLessEqual(constraint["excess_at_most"], 0)
        self.assertEqual(answer["uncertain"], {"K": {"from": 1.9, "to": 2.1}, "Td": {"from": 0.48, "to": 0.52}})
        # The worst plant's Ms, simulated by itself with the same real controller.
        gains = answer["optimum"]["controller"]["parallel"]
        kappa, tau_i = gains["Kp"] * 2.1 * 0.52 ** 2, gains["Kp"] / gains["Ki"] / 0.52
        simulated = self.run_program("simulate", "--plant", "dipdt", "--kappa", kappa, "--tau-i", tau_i, "--delta",
                                     gains["Kd"] * 2.1 * 0.52, "--horizon", "40", "--json").json
        self.assertAlmostEqual(simulated["measures"]["Ms"], constraint["value"], places=9)

    def test_one_setting_for_an_uncertain_plant(self):
        setting = "kappa=0.2,delta=0.7,tau_i=8"
        result = self.query("--minimize", "IAE_d", "--where", "Ms <= 2.6", "--uncertain", "K=0.8..1.2,Td=0.8..1.2", "--why", setting)
        self.assertEqual(result.code, 0)
        self.assertRegex(result.out, r"^kappa=0.2 .* does not serve every plant with K in 0.8..1.2, Td in 0.8..1.2\n")
        self.assertRegex(result.out, r"\n  Ms <= 2.6  worst .* at K=1.2 Td=1.2: broken, by [\d.]+ %; on [\d.]+ % of the box\n")

    def test_no_setting_for_an_uncertain_plant(self):
        result = self.query("--minimize", "IAE_d", "--where", "Ms <= 2.6", "--uncertain", "K=0.3..3,Td=1")
        self.assertEqual((result.code, result.out), (3, ""))
        self.assertRegex(result.err, r"^portrait: no setting serves every plant with K in 0.3..3\n")
        self.assertIn("least violation at kappa=", result.err)
        answer = self.query("--minimize", "IAE_d", "--where", "Ms <= 2.6", "--uncertain", "K=0.3..3,Td=1", "--json")
        self.assertEqual((answer.code, answer.json["optimum"]), (3, None))
        self.assertEqual(answer.json["least_violation"]["outcome"], "some plant breaks a constraint")

    def test_wrong_boxes(self):
        cases = [
            ("K=0.8..1.2", "--uncertain: Td must be finite and above 0 (it is 0)"),
            ("Td=0.8..x", '--uncertain: "x" is not a number'),
            ("Td=1.2..0.8", "--uncertain: Td=1.2..0.8: the low end comes first"),
            ("K=-1..1,Td=1", "--uncertain: K=-1..1 holds 0: no controller serves a gain that may vanish or change its sign"),
            ("Td=1,T1=2..3", "--uncertain: T1 belongs to fotd, not to dipdt"),
            ("Td=1,k=2..3", '--uncertain: unknown name "k" (did you mean "K"?)'),
        ]
        for box, message in cases:
            with self.subTest(box=box):
                self.assert_fails(self.query("--minimize", "IAE_w", "--uncertain", box), 2, message)
        box = ("--uncertain", "K=0.8..1.2,Td=1")
        self.assert_fails(self.query("--minimize", "IAE_w", *box, "--plant", "K=2,Td=1"), 2,
                          "--uncertain: the nominal K = 2 lies outside 0.8..1.2")
        self.assert_fails(self.query("--minimize", "IAE_w", *box, "--refine"), 2, "--uncertain and --refine: give one of the two")
        self.assert_fails(self.query("--minimize", "IAE_w", *box, "--objective-over", "wors"), 2,
                          '--objective-over: unknown word "wors" (did you mean "worst"?)')
        self.assert_fails(self.query("--minimize", "IAE_w", "--objective-over", "mean"), 2,
                          "--objective-over belongs to --uncertain")

    def test_trade_off_along_a_bound(self):
        points = self.query("--minimize", "IAE_d", "--along", "Ms=1.5..4:6", "--json").json["points"]
        for point in points:
            alone = self.query("--minimize", "IAE_d", "--where", f"Ms <= {point['bound']}", "--json").json["optimum"]
            self.assertEqual(point["objective"], alone["objective"])
        refined = self.query("--minimize", "IAE_d", "--along", "Ms=1.5..4:6", "--refine", "--why",
                             "kappa=0.16,delta=0.7,tau_i=8", "--json").json
        for point, better in zip(points, refined["points"]):
            self.assertLessEqual(better["objective"], point["objective"] * (1 + 1e-9))
            self.assertLessEqual(better["reached"], better["bound"])
        self.assertGreaterEqual(refined["regret"]["regret"], 0)
        self.assert_fails(self.query("--minimize", "IAE_d", "--along", "Ms=2"), 2,
                          '--along: "Ms=2" is not of the form EXPR=FROM..TO:COUNT, as Ms=1.3..2.0:15')

    def test_rules_along_a_bound(self):
        settled = ("--include-not-settled",)
        ask = ("--minimize", "IAE_d", "--along", "Ms=1.5..4:6", "--rules", *settled)
        rules = self.query(*ask, "--json").json["rules"]
        alone = {r["rule"]: r for r in self.query("--minimize", "IAE_d", "--rules", "--json", *settled).json["rules"]}
        self.assertGreater(len(rules), 2)
        compared = 0
        for rule in rules:
            same = alone[rule["rule"]]
            self.assertEqual(rule["objective"], same["objective"])
            self.assertEqual(rule["reached"], same["measures"]["Ms"])
            best = self.query("--minimize", "IAE_d", "--where", f"Ms <= {rule['reached']}", "--json", *settled).json
            if rule["best"] is None:
                self.assertIsNone(best["optimum"])
                continue
            compared += 1
            self.assertEqual(rule["best"], best["optimum"]["objective"])
            self.assertAlmostEqual(rule["regret"], rule["objective"] / rule["best"] - 1, places=12)
        self.assertGreater(compared, 1)
        text = self.query(*ask).out
        for rule in rules:
            self.assertIn(f"\n  {rule['rule']} ", text)
        for other in (("--region",), ("--pareto", "IAE_w,IAE_d"), ("--why", "kappa=0.16,delta=0.7,tau_i=8")):
            self.assert_fails(self.query(*other, "--rules"), 2, "--rules belongs to the best settings, or to --along")

    def test_csv(self):
        result = self.query("--minimize", "IAE_w", "--top", "100", "--csv")
        rows = list(csv.DictReader(io.StringIO(result.out)))
        admissible = self.query("--minimize", "IAE_w", "--json").json["admissible"]
        self.assertEqual(len(rows), admissible)
        objectives = [float(row["objective"]) for row in rows]
        self.assertEqual(objectives, sorted(objectives))

    def test_nothing_admissible(self):
        result = self.query("--minimize", "IAE_w", "--where", "IAE_d <= 1", "--where", "Ms <= 3", "--where", "tau_i <= 20")
        self.assertEqual((result.code, result.out), (3, ""))
        self.assertRegex(result.err, r"^portrait: no admissible setting: 0 of 27 settings are admissible")
        self.assertRegex(result.err, r"\n  IAE_d <= 1 excludes \d+, the most\n")
        self.assertRegex(result.err, r"\nleast violation at kappa=.* tau_i=.* delta=.*:\n  IAE_d <= 1: [\d.]+ against 1\n")
        answer = self.query("--minimize", "IAE_w", "--where", "IAE_d <= 1", "--json")
        self.assertEqual((answer.code, answer.json["optimum"], answer.json["admissible"]), (3, None, 0))
        self.assertEqual(answer.json["least_violation"]["violations"][0]["constraint"], "IAE_d <= 1")

    def test_wrong_questions(self):
        cases = [
            (("--minimize", "IAE_x"), '--minimize:1:1: unknown name "IAE_x" (did you mean "IAE_w"?)\n  IAE_x\n  ^'),
            (("--minimize", "IAE_w", "--json", "--csv"), "--json and --csv: give one of the two"),
            (("--minimize", "IAE_w", "--plant", "K=1"), "--plant: Td must be finite and above 0 (it is 0)"),
            (("--minimize", "IAE_w", "--plant", "K=1,Td=x"), '--plant: "x" is not a number'),
            (("--minimize", "IAE_w", "--plant", "K=1,Tx=1"), '--plant: unknown name "Tx" (did you mean "Td"?)'),
            (("--minimize", "IAE_w", "--plant", "K=1,Td=1,T1=1"), "--plant: T1 belongs to fotd, not to dipdt"),
            (("--minimize", "IAE_w", "--step", "x=1"), '--step: unknown step "x": w is the setpoint, d the input disturbance'),
            (("--minimize", "IAE_w", "--step", "w=0"), "--step: w must be finite and above 0 (it is 0)"),
            (("--minimize", "IAE_w", "--plant", "1"), '--plant: "1" is not of the form NAME=NUMBER'),
        ]
        for arguments, message in cases:
            with self.subTest(arguments=arguments):
                self.assert_fails(self.query(*arguments), 2, message)


if __name__ == "__main__":
    program.main()
