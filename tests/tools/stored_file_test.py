"""portrait info and verify: on whole files, damaged ones, and what is no portrait."""

import program
from program import ProgramTest


class StoredFile(ProgramTest):
    def test_info_json(self):
        answer = self.run_program("info", self.small_portrait(), "--json").json
        for key in ("settings", "axes", "measures", "plant", "state", "schema_version", "program"):
            self.assertIn(key, answer)
        self.assertEqual((answer["settings"], answer["plant"], answer["state"]), (27, "dipdt", "complete"))
        self.assertEqual([axis["name"] for axis in answer["axes"]], ["kappa", "delta", "tau_i"])
        self.assertEqual(answer["axes"][2]["values"], [8, 14, "inf"])
        self.assertIn("TV2_ud", answer["measures"])
        self.assertIn("portrait sweep small.toml -o small.h5", answer["history"])

    def test_info_text(self):
        text = self.run_program("info", self.small_portrait()).out
        self.assertIn("27 settings\n  kappa        3 values, 0.08 .. 0.24\n", text)

    def test_info_of_what_a_grid_file_chooses(self):
        self.write("g.toml", """title = "chosen"
plant = "ipdt"
n = 2
prefilter = "pi"
horizon = "auto"
sampling = 0.2
precision = "single"
measures = ["IAE_d", "Ms", "noise_gain"]
[parameters]
kappa = { from = 0.2, to = 0.5, count = 4 }
tau_i = 8
tau_f = 0.1
delta = 0.1
""")
        self.assertEqual(self.run_program("sweep", "g.toml", "-o", "g.h5", "--quiet", "--threads", "2").code, 0)
        answer = self.run_program("info", "g.h5", "--json").json
        found = {key: answer[key] for key in ("title", "plant", "n", "prefilter", "horizon", "sampling", "noise", "precision", "measures", "threads")}
        self.assertEqual(found, {"title": "chosen", "plant": "ipdt", "n": 2, "prefilter": "pi", "horizon": "auto", "sampling": 0.2, "noise": None,
                                 "precision": "single", "measures": ["IAE_d", "Ms", "noise_gain"], "threads": 2})
        self.assertEqual(answer["fixed"], {"delta": 0.1, "tau_i": 8, "tau_f": 0.1, "b": 0})
        self.assertRegex(self.run_program("info", "g.h5").out,
                         r"^chosen\nipdt, n = 2, prefilter pi, horizon auto\nnoise held over 0\.2 dead times\n4 settings\n"
                         r"  kappa        4 values, 0\.2 \.\. 0\.5\n(  \w+ +fixed at [\d.]+\n)+measures  IAE_d, Ms, noise_gain\n"
                         r"made by   portrait .*, method kernel, \w+, .* on 2 threads\nhistory   .*portrait sweep g\.toml -o g\.h5 --quiet "
                         r"--threads 2\nstate     complete, format \d+\.\d+\.\d+\n$")

    def test_verify_whole_and_damaged(self):
        name = self.small_portrait()
        whole = self.run_program("verify", name)
        self.assertEqual(whole.code, 0)
        self.assertTrue(whole.out.endswith("small.h5: whole, every value is as it was written\n"))
        data = bytearray((self.folder / name).read_bytes())
        codes = set()
        for position in range(2048, len(data), max(1, len(data) // 40)):
            damaged = bytearray(data)
            damaged[position] ^= 0xFF
            (self.folder / "damaged.h5").write_bytes(damaged)
            result = self.run_program("verify", "damaged.h5")
            self.assertIn(result.code, (0, 1, 2, 4), result.err)
            codes.add(result.code)
        self.assertIn(4, codes)

    def test_a_file_that_is_no_portrait(self):
        self.write("text.h5", "no portrait")
        for verb in ("info", "verify"):
            result = self.run_program(verb, "text.h5")
            self.assertEqual(result.code, 2)
            self.assertTrue(result.err.startswith("portrait: text.h5"), result.err)
        result = self.run_program("info", "missing.h5")
        self.assertEqual(result.code, 2)
        self.assertIn("missing.h5", result.err)


if __name__ == "__main__":
    program.main()
