"""portrait sweep --extend: the same portrait as a sweep of the whole grid, from an earlier one that stays as it is."""

import os
import shutil
import signal
import subprocess
import time

import h5py

import program
from program import ProgramTest

GRID = """title = "earlier"
plant = "dipdt"
n = 1
horizon = 30
measures = [{measures}]
precision = "{precision}"
[parameters]
{parameters}
b = 0
"""
SOME = '"IAE_w", "TV2_uw", "Ms", "GM_low"'
MORE = '"IAE_w", "IAE_d", "TV2_uw", "Ms", "GM_low", "PM"'
EARLIER = "kappa = { from = 0.05, to = 0.35, count = 31 }\ndelta = [0.5, 0.6, 0.7, 0.8]\ntau_i = [6, 8, 14, inf]\ntau_f = 0.1\nc = 0"
# Each twice as fine or longer; another order; a parameter that was fixed; 50,410 settings and 13 tiles.
LATER = ("tau_f = [0.05, 0.1]\nkappa = { from = 0.05, to = 0.4, count = 71 }\ndelta = { from = 0.35, to = 1.05, count = 71 }\n"
         "tau_i = [6, 8, 10, 14, inf]\nc = 0")


def grid(parameters, measures=SOME, precision="double"):
    return GRID.format(parameters=parameters, measures=measures, precision=precision)


class Extend(ProgramTest):
    def earlier(self, **choices):
        self.write("old.toml", grid(EARLIER, **choices))
        self.assertEqual(self.run_program("sweep", "old.toml", "-o", "old.h5", "--quiet").code, 0)
        self.before = (self.folder / "old.h5").read_bytes()

    def later(self, parameters=LATER, **choices):
        """The digests of a sweep of the whole grid."""
        self.write("new.toml", grid(parameters, **choices))
        self.assertEqual(self.run_program("sweep", "new.toml", "-o", "whole.h5", "--quiet").code, 0)
        whole = self.run_program("verify", "whole.h5").out.replace("whole.h5", "new.h5")
        (self.folder / "whole.h5").unlink()
        return whole

    def extend(self, *options):
        return self.run_program("sweep", "new.toml", "--extend", "old.h5", "-o", "new.h5", *options)

    def assert_whole(self, digests):
        self.assertEqual(self.run_program("verify", "new.h5").out, digests)
        self.assertEqual((self.folder / "old.h5").read_bytes(), self.before)
        self.assertFalse((self.folder / "new.h5.run").exists())

    def test_the_same_portrait_as_that_of_the_whole_grid(self):
        self.earlier(measures=MORE)
        whole = self.later()
        common = 31 * 4 * 4
        estimate = self.run_program("sweep", "new.toml", "--extend", "old.h5", "--dry-run", "--json").json
        self.assertEqual((estimate["settings"], estimate["settings_reused"]), (2 * 71 * 71 * 5, common))
        answer = self.extend("--json").json
        self.assertEqual((answer["settings"], answer["settings_reused"]), (2 * 71 * 71 * 5, common))
        self.assertEqual(answer["settings_measured"] + common, answer["settings"])
        self.assertEqual(answer["settled"] + answer["not_settled"] + answer["unstable"], answer["settings"])
        self.assert_whole(whole)
        self.assertIn("--extend old.h5", self.run_program("info", "new.h5", "--json").json["history"])

    def test_any_threads_and_shards(self):
        self.earlier()
        whole = self.later()
        self.assertEqual(self.extend("--quiet", "--threads", "7").code, 0)
        self.assert_whole(whole)
        (self.folder / "new.h5").unlink()
        for shard in ("1/2", "2/2"):
            self.assertEqual(self.extend("--quiet", "--shard", shard).code, 0)
        self.assertEqual(self.run_program("merge", "new.h5.run", "-o", "new.h5", "--quiet").code, 0)
        shutil.rmtree(self.folder / "new.h5.run")
        self.assert_whole(whole)

    def test_nothing_left_to_measure(self):
        self.earlier()
        whole = self.later("delta = [0.5, 0.6, 0.7, 0.8]\ntau_f = 0.1\ntau_i = [6, inf]\nkappa = 0.35\nc = 0", measures='"Ms"')
        result = self.extend()
        self.assertIn("portrait: 8 settings taken from old.h5\n", result.err)
        self.assertIn("portrait: 0 settings in ", result.err)
        self.assert_whole(whole)

    def test_single_precision_from_double(self):
        self.earlier()
        whole = self.later(precision="single")
        self.assertEqual(self.extend("--quiet").code, 0)
        self.assert_whole(whole)

    def test_noise_and_automatic_horizon(self):
        self.write("old.toml", grid(EARLIER, measures='"IAE_w", "noise_gain"').replace("horizon = 30", 'horizon = "auto"\nsampling = 0.1'))
        self.assertEqual(self.run_program("sweep", "old.toml", "-o", "old.h5", "--quiet").code, 0)
        self.before = (self.folder / "old.h5").read_bytes()
        text = grid(EARLIER.replace("count = 31", "count = 61"), measures='"IAE_w", "noise_gain"')
        self.write("new.toml", text.replace("horizon = 30", 'horizon = "auto"\nsampling = 0.1'))
        self.assertEqual(self.run_program("sweep", "new.toml", "-o", "whole.h5", "--quiet").code, 0)
        self.assertEqual(self.extend("--json").json["settings_reused"], 31 * 16)
        self.assert_whole(self.run_program("verify", "whole.h5").out.replace("whole.h5", "new.h5"))

    def test_stopped_and_killed_in_the_middle(self):
        self.earlier()
        whole = self.later(LATER.replace("count = 71", "count = 141", 1))
        goes_on = {signal.SIGTERM: 0, signal.SIGKILL: 0}
        for number in goes_on:
            for pause in (0.05, 0.2):
                sweep = subprocess.Popen([program.PROGRAM, "sweep", "new.toml", "--extend", "old.h5", "-o", "new.h5", "--quiet"],
                                         cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                while not (self.folder / "new.h5.run" / "1-of-1.data").exists() and sweep.poll() is None:
                    time.sleep(0.005)
                time.sleep(pause)
                sweep.send_signal(number)
                sweep.wait(60)
                goes_on[number] += 1 if sweep.returncode in (5, -signal.SIGKILL) else 0
                self.assertEqual(self.extend("--resume", "--quiet").code, 0)
                self.assert_whole(whole)
                (self.folder / "new.h5").unlink()
        self.assertGreater(min(goes_on.values()), 0, "no sweep was stopped before its end")

    def test_what_is_damaged_is_told_and_measured_again(self):
        self.earlier()
        whole = self.later()
        data = bytearray(self.before)
        data[4096 + 777] ^= 1  # in the first chunk of the first column
        (self.folder / "old.h5").write_bytes(data)
        self.before = bytes(data)
        result = self.extend()
        self.assertEqual(result.code, 0)
        self.assertRegex(result.err, r"portrait: old.h5: IAE_w is damaged: the chunk of tile 0 has another checksum\n"
                                     r"portrait: 496 settings were measured again in place of what is damaged\n")
        self.assert_whole(whole)

    def test_another_loop_is_refused(self):
        self.earlier()
        self.write("new.toml", grid(LATER, measures='"IAE_w", "ISE_w", "DM"').replace("n = 1", "n = 2").replace("horizon = 30", "horizon = 40"))
        self.assert_fails(self.extend(), 2,
                          "old.h5 cannot be extended to this grid:\n  n: 1, now 2\n  horizon: 30, now 40\n  measures: it lacks ISE_w, DM "
                          "(to compute one measure of a setting takes as long as all of them: leave them out of the grid, or sweep it anew)")
        self.write("new.toml", grid(LATER).replace("dipdt", "ipdt"))
        self.assertIn("plant: dipdt, now ipdt", self.extend().err)
        self.write("new.toml", grid(LATER))
        other = self.run_program("sweep", "new.toml", "--extend", "old.h5", "-o", "new.h5", env={**os.environ, "PORTRAIT_ISA": "base"})
        self.assertRegex(other.err, r"the method: kernel, \w+, now kernel, base \(PORTRAIT_ISA chooses the instruction set\)")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["new.toml", "old.h5", "old.toml"])

    def test_all_else_that_decides_a_number_is_compared(self):
        text = """plant = "dipdt"
n = 1
horizon = 30
sampling = 0.1
noise = 0.1
seeds = 2
measures = ["IAE_w", "noise_gain", "noisy_TV_uw"]
[parameters]
kappa = [0.1, 0.2]
delta = 0.6
tau_i = 8
tau_f = 0.1
"""
        self.write("old.toml", text)
        self.assertEqual(self.run_program("sweep", "old.toml", "-o", "old.h5", "--quiet").code, 0)
        refused = "old.h5 cannot be extended to this grid:\n  "
        noise = "uniform of 0.1 held over 0.1, 2 seeds from 1"
        for was, now, message in (("n = 1", 'n = 1\nprefilter = "pi"', "prefilter: full, now pi"),
                                  ("sampling = 0.1", "sampling = 0.2",
                                   f"sampling: 0.1, now 0.2\n  noise: {noise}, now {noise.replace('held over 0.1', 'held over 0.2')}"),
                                  ("noise = 0.1", "noise = 0.2", f"noise: {noise}, now {noise.replace('of 0.1', 'of 0.2')}"),
                                  ("seeds = 2", "seeds = 3", f"noise: {noise}, now {noise.replace('2 seeds', '3 seeds')}"),
                                  ("noise = 0.1", 'noise = 0.1\nnoise_kind = "gaussian"', f"noise: {noise}, now {noise.replace('uniform', 'gaussian')}")):
            self.write("new.toml", text.replace(was, now))
            self.assert_fails(self.extend(), 2, refused + message)
        self.write("new.toml", text.replace('"noise_gain", "noisy_TV_uw"', '"IAE_w"').replace('["IAE_w", "IAE_w"]', '["IAE_w"]')
                   .replace("noise = 0.1\nseeds = 2\n", "").replace("sampling = 0.1", "sampling = 0.2"))
        self.assertEqual(self.extend("--quiet").code, 0, "neither matters to a measure without noise")
        with h5py.File(self.folder / "old.h5", "r+") as file:
            now = file.attrs["program"]
            file.attrs["program"] = "portrait 0.0.1"
        self.write("new.toml", text.replace("[0.1, 0.2]", "[0.1, 0.15, 0.2]"))
        now = now.decode() if isinstance(now, bytes) else now
        self.assert_fails(self.extend("--force"), 2, refused + f"the program: portrait 0.0.1, now {now}")

    def test_what_is_damaged_is_measured_again_with_its_noise(self):
        text = grid(EARLIER, measures='"IAE_w", "noise_gain"').replace("horizon = 30", "horizon = 30\nsampling = 0.1")
        self.write("old.toml", text)
        self.assertEqual(self.run_program("sweep", "old.toml", "-o", "old.h5", "--quiet").code, 0)
        whole = self.run_program("verify", "old.h5").out.replace("old.h5", "new.h5")
        data = bytearray((self.folder / "old.h5").read_bytes())
        data[4096 + 77] ^= 1
        (self.folder / "old.h5").write_bytes(data)
        self.before = bytes(data)
        self.write("new.toml", text)
        self.assertIn("496 settings were measured again", self.extend().err)
        self.assert_whole(whole)

    def test_a_coarser_precision_is_refused(self):
        self.earlier(precision="single")
        self.write("new.toml", grid(LATER))
        self.assert_fails(self.extend(), 2, "old.h5 cannot be extended to this grid:\n  precision: single, now double")

    def test_nothing_in_common_is_refused(self):
        self.earlier()
        self.write("new.toml", grid(LATER.replace("tau_f = [0.05, 0.1]", "tau_f = [0.05, 0.2]")))
        self.assert_fails(self.extend(), 2, "old.h5 has no setting of this grid: no value of tau_f is in both")

    def test_the_earlier_portrait_stays(self):
        self.earlier()
        self.write("new.toml", grid(LATER))
        self.assert_fails(self.run_program("sweep", "new.toml", "--extend", "old.h5", "-o", "./old.h5", "--force"), 2,
                          "old.h5 stays as it is: give the larger portrait another name with -o")
        self.assert_fails(self.run_program("sweep", "new.toml", "--extend", "none.h5", "-o", "new.h5"), 2,
                          "none.h5: there is no such file")
        self.assertEqual((self.folder / "old.h5").read_bytes(), self.before)


if __name__ == "__main__":
    program.main()
