"""portrait plot: what is drawn, read back from the SVG, against what query and simulate say."""

import math
import re
import struct
import subprocess
import zlib

import program
from program import ProgramTest
from svg_figure import Figure

LOOPS = ("--plant", "dipdt", "--setting", "fast: kappa=0.24 tau_i=8 delta=0.7", "--setting",
         "calm: kappa=0.1248, tau_i=10.324, delta=0.5045")


class Plot(ProgramTest):
    def plot(self, *arguments, code=0):
        result = self.run_program("plot", *arguments)
        self.assertEqual((result.code, result.out), (code, ""), result.err)
        return result

    def figure(self, *arguments):
        self.plot(*arguments, "-o", "figure.svg")
        return Figure(self.folder / "figure.svg")

    def near(self, a, b, within):
        self.assertLess(abs(a - b), within, f"{a} against {b}")


class Map(Plot):
    def setUp(self):
        super().setUp()
        self.write("grid.toml", "plant = \"dipdt\"\nn = 0\nhorizon = 60\nmeasures = [\"IAE_w\", \"IAE_d\", \"Ms\", \"TV2_ud\"]\n"
                   "[parameters]\nkappa = { from = 0.05, to = 0.35, count = 16 }\n"
                   "delta = { from = 0.3, to = 1.0, count = 8 }\ntau_i = [8, 14, inf]\n")
        self.assertEqual(self.run_program("sweep", "grid.toml", "-o", "p.h5", "--quiet").code, 0)

    def test_optimum_and_region_lie_where_query_finds_them(self):
        question = ("--minimize", "IAE_w + IAE_d", "--where", "Ms <= 2.5")
        best = self.run_program("query", "p.h5", *question, "--json").json["optimum"]
        figure = self.figure("map", "p.h5", *question)
        x, y = figure.axes()
        star = figure.points(figure.plot(f"optimum, {best['objective']:.6g}"))[0]
        self.near(x.value(star[0]), best["settings"]["kappa"], 1e-3)
        self.near(y.value(star[1]), best["settings"]["delta"], 5e-3)
        held = f"tau_i = {best['settings']['tau_i']:g}"
        self.assertIn(held, figure.text_of("title"))
        # Every admissible setting of the plane has its ring, and no other.
        every = self.run_program("query", "p.h5", *question, "--where", f"tau_i == {best['settings']['tau_i']}", "--top", 1000,
                                 "--json").json["top"]
        rings = figure.points(figure.plot("admissible settings"))[:-1]  # the last one stands in the key
        self.assertEqual(len(rings), len(every))
        drawn = {(round(x.value(px), 2), round(y.value(py), 1)) for px, py in rings}
        self.assertEqual(drawn, {(round(s["settings"]["kappa"], 2), round(s["settings"]["delta"], 1)) for s in every})

    def test_contours_lie_between_the_settings_that_they_part(self):
        figure = self.figure("map", "p.h5", "--colour", "Ms", "--at", "tau_i=8", "--levels", 6, "--log", "x")
        x, y = figure.axes(log_x=True)
        areas = [figure.polygons(group) for group in figure.plots() if figure.polygons(group)]
        self.assertEqual(len(areas), 6)
        def size(polygons):
            total = 0
            for p in polygons:
                total += abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(p, p[1:] + p[:1]))) / 2
            return total
        sizes = [size(p) for p in areas]
        self.assertEqual(sizes, sorted(sizes, reverse=True))
        self.assertGreater(sizes[-1], 0)

    def test_stability_limit_is_that_of_simulate(self):
        figure = self.figure("map", "p.h5", "--colour", "Ms", "--at", "tau_i=8", "--stability")
        x, y = figure.axes()
        limit = max(figure.lines(figure.plot("limit of stability")), key=len)
        for px, py in limit[20:-20:25]:
            kappa, delta = x.value(px), y.value(py)
            status = [self.run_program("simulate", "--plant", "dipdt", "--n", 0, "--kappa", kappa * f, "--tau-i", 8,
                                       "--delta", delta, "--horizon", 20, "--json").json["status"] for f in (0.97, 1.03)]
            self.assertNotEqual(status[0] == "unstable", status[1] == "unstable", (kappa, delta))

    def test_real_units_scale_the_colours(self):
        def top(*plant):
            figure = self.figure("map", "p.h5", "--colour", "IAE_d", "--at", "tau_i=8", *plant)
            right = max(px for _, px, _ in figure.numbers())
            return max(v for v, px, _ in figure.numbers() if abs(px - right) < 1), figure
        normalised, plain = top()
        real, scaled = top("--plant", "K=3,Td=0.5")
        self.near(real / normalised, 3 * 0.5 ** 3, 0.01)
        self.assertTrue(any(t.endswith("[y Td]") for t, _, _ in plain.texts()))
        self.assertTrue(any(t.endswith("[y time]") for t, _, _ in scaled.texts()))

    def test_front_is_not_dominated_and_lies_where_query_finds_its_ends(self):
        figure = self.figure("front", "p.h5", "--x", "Ms", "--y", "IAE_w + IAE_d", "--where", "Ms <= 3", "--setting",
                             "mine: kappa=0.2 delta=0.6 tau_i=8")
        x, y = figure.axes()
        steps = [(x.value(px), y.value(py)) for px, py in max(figure.lines(figure.plot("Pareto front")), key=len)]
        steps = steps[2:] if len(steps) > 2 and steps[0][1] == steps[1][1] and steps[0][0] > steps[1][0] else steps
        self.assertGreater(len(steps), 6)
        for a, b in zip(steps, steps[1:]):
            self.assertLessEqual(a[0], b[0] + 1e-3)
            self.assertGreaterEqual(a[1], b[1] - 0.3)
        fastest = self.run_program("query", "p.h5", "--minimize", "IAE_w + IAE_d", "--where", "Ms <= 3", "--json").json["optimum"]
        calmest = self.run_program("query", "p.h5", "--minimize", "Ms", "--where", "Ms <= 3", "--json").json["optimum"]
        self.near(steps[-1][0], fastest["measures"]["Ms"], 0.02)
        self.near(steps[-1][1], fastest["objective"], 2)
        self.near(steps[0][0], calmest["measures"]["Ms"], 0.02)
        mine = self.run_program("simulate", "--plant", "dipdt", "--n", 0, "--kappa", 0.2, "--delta", 0.6, "--tau-i", 8, "--horizon", 60,
                                "--json").json["measures"]
        px, py = figure.points(figure.plot("mine"))[0]
        self.near(x.value(px), mine["Ms"], 0.02)
        self.near(y.value(py), mine["IAE_w"] + mine["IAE_d"], 2)

    def test_rules_are_numbered_points_with_their_regret(self):
        question = ("--minimize", "IAE_w + IAE_d", "--where", "Ms <= 2.5")
        rules = [r for r in self.run_program("query", "p.h5", *question, "--rules", "--json").json["rules"] if r["applicable"]]
        figure = self.figure("map", "p.h5", *question, "--rules")
        x, y = figure.axes()
        self.assertGreater(len(rules), 4)
        labels = [text for text, _, _ in figure.texts()]
        for k, rule in enumerate(rules, 1):
            at = rule["settings"]
            label = f"{k}  {rule['rule']}" + (f", regret {rule['regret']:.3g}" if rule["regret"] is not None else "")
            title = next(text for text in labels if text.startswith(label))
            self.assertEqual(title == label, rule["admissible"])
            px, py = figure.points(figure.plot(title))[0]
            self.near(x.value(px), at["kappa"], 1e-3)
            self.near(y.value(py), at["delta"], 5e-3)
            self.assertIn(str(k), labels)

    def test_rules_beside_the_front(self):
        arguments = ("front", "p.h5", "--x", "Ms", "--y", "IAE_w + IAE_d", "--where", "Ms <= 3", "--rules")
        rules = self.run_program("query", "p.h5", "--minimize", "IAE_w + IAE_d", "--where", "Ms <= 3", "--rules", "--json").json["rules"]
        qrdp = next(r for r in rules if r["rule"] == "huba2022-qrdp")
        figure = self.figure(*arguments)
        x, y = figure.axes()
        title = next(t for t, _, _ in figure.texts() if t.endswith(f"huba2022-qrdp, regret {qrdp['regret']:.3g}"))
        px, py = figure.points(figure.plot(title))[0]
        self.near(x.value(px), qrdp["measures"]["Ms"], 0.02)
        self.near(y.value(py), qrdp["objective"], 2)
        self.assertIn("huba2022-trdp", self.plot(*arguments, "-o", "again.svg").err)  # no integral action: no IAE_d

    def test_uncertain_plant_draws_the_robust_optimum_and_where_it_goes(self):
        question = ("--minimize", "IAE_w + IAE_d", "--where", "Ms <= 2.5", "--uncertain", "K=0.8..1.2,Td=0.9..1.1")
        best = self.run_program("query", "p.h5", *question, "--json").json["optimum"]
        figure = self.figure("map", "p.h5", *question)
        x, y = figure.axes()
        px, py = figure.points(figure.plot(f"optimum, {best['objective']:.6g}"))[0]
        kappa, delta = best["settings"]["kappa"], best["settings"]["delta"]
        self.near(x.value(px), kappa, 1e-3)
        edge = [(x.value(a), y.value(b)) for line in figure.lines(figure.plot("the optimum, plant uncertain")) for a, b in line]
        drawn = [p for p in edge if 0.05 < p[0] < 0.35]
        # kappa = Kc K Td^2 and delta = Kd K Td at the corners of the box; the middle plant has K = Td = 1.
        for K, Td in ((0.8, 0.9), (1.2, 0.9), (0.8, 1.1), (1.2, 1.1)):
            corner = (kappa * K * Td * Td, delta * K * Td)
            if corner[0] < 0.35 and 0.3 < corner[1] < 1:
                self.assertLess(min(math.hypot((a - corner[0]) / 0.3, (b - corner[1]) / 0.7) for a, b in drawn), 0.01, corner)

    def test_rules_and_boxes_need_a_question(self):
        self.assert_fails(self.run_program("plot", "map", "p.h5", "--colour", "Ms", "--rules", "-o", "a.svg"), 2,
                          "--rules needs --minimize, which the regret is about")
        self.assert_fails(self.run_program("plot", "map", "p.h5", "--colour", "Ms", "--uncertain", "K=1..2", "-o", "a.svg"), 2,
                          "--uncertain needs --minimize: the optimum is the controller whose box is drawn")

    def test_nothing_admissible_is_drawn_and_said(self):
        result = self.plot("map", "p.h5", "--minimize", "IAE_d", "--where", "Ms <= 1", "-o", "none.svg", code=3)
        self.assertIn("no setting is admissible", result.err)
        self.assertTrue((self.folder / "none.svg").exists())

    def test_errors(self):
        self.assert_fails(self.run_program("plot", "map", "p.h5", "--colour", "Mss", "-o", "a.svg"), 2,
                          '--colour:1:1: unknown name "Mss" (did you mean "Ms"?)\n  Mss\n  ^')
        self.assert_fails(self.run_program("plot", "map", "p.h5", "--colour", "Ms", "--at", "tau_i=9", "-o", "a.svg"), 2,
                          "--at: 9 is no value of tau_i (nearest: 8 and 14)")
        self.assert_fails(self.run_program("plot", "map", "p.h5", "--colour", "Ms", "-o", "a.jpg"), 2,
                          "a.jpg: a picture's name ends in .svg, .pdf or .png")
        self.assert_fails(self.run_program("plot", "mpa", "p.h5"), 2, 'unknown kind of plot "mpa" (did you mean "map"?)')
        self.assert_fails(self.run_program("plot", "map", "p.h5", "--colr", "Ms"), 2,
                          'unknown option "--colr" (did you mean "--color"?)')
        self.assertEqual(list(self.folder.glob("a.*")), [])


class Loops(Plot):
    def test_responses_are_those_of_the_trace(self):
        self.run_program("simulate", "--plant", "dipdt", "--kappa", 0.24, "--tau-i", 8, "--delta", 0.7, "--horizon", 40,
                         "--trace", "t.csv")
        rows = [list(map(float, line.split(","))) for line in (self.folder / "t.csv").read_text().splitlines()[1:]]
        figure = self.figure("responses", *LOOPS, "--horizon", 40)
        panels = [figure.lines(group) for group in figure.plots()]
        self.assertEqual(len(panels), 8)
        for panel, column in ((0, 1), (2, 3), (4, 2), (6, 4)):  # y_w, y_d, u_w, u_d of the first setting
            curve = max(panels[panel], key=len)
            width = curve[-1][0] - curve[0][0]
            values = [row[column] for row in rows]
            low, high = min(values), max(values)
            top, bottom = min(p[1] for p in curve), max(p[1] for p in curve)
            for px, py in curve[::97]:
                t = 40 * (px - curve[0][0]) / width
                wanted = min(rows, key=lambda row: abs(row[0] - t))[column]
                self.near((bottom - py) / (bottom - top), (wanted - low) / (high - low), 0.02)

    def test_real_units_scale_time(self):
        figure = self.figure("responses", "--plant", "dipdt,K=2,Td=0.5", *LOOPS[2:], "--horizon", 40)
        self.assertIn(20.0, [v for v, _, _ in figure.numbers()])
        self.assertIn("K = 2, Td = 0.5", figure.text_of("title"))

    def test_nyquist_curve_touches_its_circle(self):
        Ms = self.run_program("simulate", "--plant", "dipdt", "--kappa", 0.24, "--tau-i", 8, "--delta", 0.7, "--json").json[
            "measures"]["Ms"]
        figure = self.figure("nyquist", *LOOPS)
        x, y = figure.axes()
        curve = max(figure.lines(figure.plot(f"fast, Ms = {Ms:.4g}")), key=len)
        distance = min(math.hypot(x.value(px) + 1, y.value(py)) for px, py in curve)
        self.near(distance, 1 / Ms, 5e-3)

    def test_bars_are_the_measures(self):
        values = [self.run_program("simulate", "--plant", "dipdt", "--kappa", k, "--tau-i", t, "--delta", d, "--json").json["measures"]
                  for k, t, d in ((0.24, 8, 0.7), (0.1248, 10.324, 0.5045))]
        figure = self.figure("bars", *LOOPS, "--measures", "IAE_d,Ms")
        heights = []
        for group in figure.plots():
            corners = [p for polygon in figure.polygons(group) for p in polygon]
            heights.append(max(p[1] for p in corners) - min(p[1] for p in corners))
        self.assertEqual(len(heights), 4)
        self.near(heights[1] / heights[0], values[1]["IAE_d"] / values[0]["IAE_d"], 0.01)
        self.near(heights[3] / heights[2], values[1]["Ms"] / values[0]["Ms"], 0.01)

    def test_characteristics_are_those_that_are_printed(self):
        lines = {"one": ("--pid", "standard:Kc={},Ti=1.5", "--vary", "0.25:0.5:4"),
                 "two": ("--pid", "standard:Kc={},Ti=2.5", "--vary", "0.5:1:3")}
        curves = [f"{label}: {' '.join(options)}" for label, options in lines.items()]
        figure = self.figure("characteristic", "--plant", "tf:1/1,4,6,4,1", "--curve", curves[0], "--curve", curves[1])
        printed = {label: self.run_program("characteristic", "--plant", "tf:1/1,4,6,4,1", *options, "--json").json["points"]
                   for label, options in lines.items()}
        panels = [max(figure.lines(group), key=len) for group in figure.plots() if figure.lines(group)]
        self.assertEqual(len(panels), 4)  # effort of both, wobbling of both
        for panel, deviation in ((panels[:2], "TV1_ud"), (panels[2:], "TV1_yd")):
            drawn = [p for curve in panel for p in curve]
            wanted = [(p[deviation], p["IAE_d"]) for label in lines for p in printed[label]]
            self.assertEqual(len(drawn), len(wanted))
            for c, sign in ((0, 1), (1, -1)):
                pixels, values = [p[c] for p in drawn], [w[c] for w in wanted]
                scale = (max(pixels) - min(pixels)) / (max(values) - min(values))
                for pixel, value in zip(pixels, values):
                    shift = pixels[values.index(min(values))]
                    self.near(pixel, shift + sign * scale * (value - min(values)), 0.2)
        texts = [text for text, _, _ in figure.texts()]
        for end in ("0.25", "0.5", "1"):
            self.assertGreaterEqual(texts.count(end), 2, end)
        self.assertIn("TV1_yd [y]", texts)
        self.assertTrue(figure.plot("one") is not None and figure.plot("two") is not None)

    def test_characteristics_of_curves_that_are_none(self):
        line = ("characteristic", "--plant", "ipdt", "--vary", "0.2,0.3", "-o", "a.svg", "--curve")
        for curve, message in (("x: --kapa {}", '--curve "x: --kapa {}": unknown option "--kapa" (did you mean "--kappa"?)'),
                               ("x: --kappa 1", "--vary: there is no {} on the line for it to stand for"),
                               ("x: --kappa {} --speed IAE_w",
                                '--curve "x: --kappa {} --speed IAE_w": --speed, --effort and --wobbling belong on the line')):
            self.assert_fails(self.run_program("plot", *line, curve), 2, message)
        self.assert_fails(self.run_program("plot", "characteristic", "--kappa", "{}", "--vary", "1,2", "-o", "a.svg"), 2,
                          "--plant is missing, on the line or in --curve")
        self.assertEqual(list(self.folder.glob("a.*")), [])

    def test_an_unstable_loop_leaves_a_gap(self):
        figure = self.figure("characteristic", "--plant", "ipdt", "--kappa", "{}", "--tau-i", 8, "--vary", "0.2,0.3,9,0.4,0.5")
        pieces = [line for line in figure.lines(figure.plots()[1]) if len(line) == 2]
        self.assertGreaterEqual(len(pieces), 2)

    def test_stability_of_ipdt_with_p_control_ends_at_pi_half(self):
        figure = self.figure("stability", "--plant", "ipdt", "--x", "kappa=0.1..3", "--y", "tau_i=1000..2000")
        x, _ = figure.axes()
        limit = max(figure.lines(figure.plot("limit of stability")), key=len)
        for px, _ in limit:
            self.near(x.value(px), math.pi / 2, 0.01)

    def test_metadata_holds_the_command(self):
        for name in ("a.svg", "a.png", "a.pdf"):
            self.plot("nyquist", *LOOPS, "-o", name)
        command = f"portrait plot nyquist --plant dipdt --setting '{LOOPS[3]}' --setting '{LOOPS[5]}' -o "
        self.assertEqual(Figure(self.folder / "a.svg").text_of("metadata"), command + "a.svg")
        png = (self.folder / "a.png").read_bytes()
        texts, at = {}, 8
        while at < len(png):
            size, kind = struct.unpack(">I4s", png[at:at + 8])
            body = png[at + 8:at + 8 + size]
            self.assertEqual(struct.unpack(">I", png[at + 8 + size:at + 12 + size])[0], zlib.crc32(kind + body))
            if kind == b"tEXt":
                key, text = body.split(b"\0")
                texts[key.decode()] = text.decode()
            at += 12 + size
        self.assertEqual(texts["Description"], command + "a.png")
        pdf = (self.folder / "a.pdf").read_bytes()
        self.assertIn(b"/Subject (" + (command + "a.pdf").encode() + b")", pdf)
        start = int(re.findall(rb"startxref\s+(\d+)", pdf)[-1])
        self.assertEqual(pdf[start:start + 4], b"xref")
        number, offset = re.match(rb"xref\n(\d+) 1\n(\d{10}) ", pdf[start:]).groups()
        self.assertTrue(pdf[int(offset):].startswith(number + b" 0 obj"))
        self.assertIn(b"/Info " + number + b" 0 R", pdf[start:])

    def test_no_gnuplot_is_said(self):
        result = self.run_program("plot", "nyquist", *LOOPS, "-o", "a.svg", env={"PATH": str(self.folder)})
        self.assertEqual(result.code, 1)
        self.assertIn("apt-get install gnuplot-nox", result.err)

    def test_errors(self):
        self.assert_fails(self.run_program("plot", "responses", "--plant", "dipdt", "-o", "a.svg"), 2,
                          "nothing to draw: give --setting, or a portrait and --minimize")
        self.assert_fails(self.run_program("plot", "responses", "--setting", "kappa=1", "-o", "a.svg"), 2,
                          "--plant is missing: dipdt, ipdt or fotd, unless a portrait says it")
        self.assert_fails(self.run_program("plot", "nyquist", "--plant", "dipdt", "--setting", "kapa=1", "-o", "a.svg"), 2,
                          '--setting: unknown parameter "kapa" (did you mean "kappa"?)')
        self.assert_fails(self.run_program("plot"), 2,
                          "portrait plot needs to know what: map, responses, nyquist, bars, front, characteristic, stability")


if __name__ == "__main__":
    program.main()
