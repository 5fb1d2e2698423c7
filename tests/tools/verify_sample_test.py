"""portrait verify --sample: right numbers pass, wrong ones with right digests do not."""

import subprocess
import sys

import program
from program import ProgramTest

MADE_UP = sys.argv.pop(3)  # writes portraits whose values are made up, with their digests


class VerifySample(ProgramTest):
    def test_a_sweep_is_right(self):
        name = self.small_portrait()
        result = self.run_program("verify", name, "--sample", "10", "--seed", "4")
        self.assertEqual((result.code, result.err), (0, ""))
        self.assertIn("\n10 settings, seed 4, simulated again by the reference method\n", result.out)
        self.assertRegex(result.out, r"\n  IAE_w +\d\.\de-\d+ +1\.0e-08  ok\n")
        self.assertTrue(result.out.endswith("small.h5: whole, every value is as it was written, and 10 settings are right\n"))
        answer = self.run_program("verify", name, "--sample", "1000", "--json").json
        self.assertEqual((answer["whole"], answer["sample"]["settings"], answer["sample"]["failed"]), (True, 27, 0))
        self.assertEqual(set(answer["sample"]["measures"]), set(self.run_program("info", name, "--json").json["measures"]))
        self.assertEqual(self.run_program("verify", name, "--json").json["sample"], None)

    def test_made_up_values_are_wrong(self):
        subprocess.run([MADE_UP, "write", "3,4", "made_up.h5"], cwd=self.folder, check=True)
        self.assertEqual(self.run_program("verify", "made_up.h5").code, 0)
        result = self.run_program("verify", "made_up.h5", "--sample", "5", "--seed", "1")
        self.assertEqual(result.code, 4)
        self.assertRegex(result.out, r"\n  Ms +\S+ +1\.0e-08  WRONG in \d settings\n    setting \d+: stored \S+, now \S+: "
                                     r"portrait simulate --plant dipdt .* --horizon 51 --method reference\n")
        self.assertTrue(result.out.endswith("whole, every value is as it was written, yet 5 of 5 settings are WRONG\n"))
        answer = self.run_program("verify", "made_up.h5", "--sample", "5", "--seed", "1", "--json")
        self.assertEqual((answer.code, answer.json["sample"]["failed"]), (4, 5))

    def test_a_damaged_file_is_not_sampled(self):
        data = bytearray((self.folder / self.small_portrait()).read_bytes())
        data[4096 + 10] ^= 1
        (self.folder / "small.h5").write_bytes(data)
        result = self.run_program("verify", "small.h5", "--sample", "5")
        self.assertEqual(result.code, 4)
        self.assertTrue(result.out.endswith("small.h5: BROKEN\n"))
        self.assertNotIn("simulated again", result.out)

    def test_wrong_use(self):
        name = self.small_portrait()
        self.assertEqual(self.run_program("verify", name, "--sample", "0").code, 2)
        self.assertEqual(self.run_program("verify", name, "--sample", "ten").code, 2)
        self.assertIn('(did you mean "--sample"?)', self.run_program("verify", name, "--sampel", "3").err)


if __name__ == "__main__":
    program.main()
