"""A sweep in its run folder, as a user meets it: running, stopped, damaged, resumed, merged; by info, verify, sweep and merge."""

import os
import shlex
import signal
import subprocess
import time

import program
from program import ProgramTest, SMALL_GRID

# Seven tiles: a shard of two has four and three, each in one batch.
GRID = SMALL_GRID.replace("step = 0.08", "count = 3000")


class Run(ProgramTest):
    def shard(self, text, name="g.h5", grid="g.toml"):
        self.assertEqual(self.run_program("sweep", grid, "-o", name, "--quiet", "--shard", text).code, 0)

    def digests_of_a_single_run(self):
        self.assertEqual(self.run_program("sweep", "g.toml", "-o", "whole.h5", "--quiet").code, 0)
        digests = self.run_program("verify", "whole.h5").out.replace("whole.h5", "g.h5")
        (self.folder / "whole.h5").unlink()
        return digests

    def flip(self, name, at):
        path = self.folder / "g.h5.run" / name
        data = bytearray(path.read_bytes())
        data[at] ^= 8
        path.write_bytes(data)

    def setUp(self):
        super().setUp()
        self.write("g.toml", GRID)


class Seen(Run):
    def test_a_stopped_run(self):
        self.shard("1/2")
        state = self.run_program("info", "g.h5", "--json").json
        self.assertEqual((state["state"], state["settings"], state["tiles"], state["tiles_stored"]), ("stopped", 27000, 7, 4))
        self.assertEqual(state["shards"], [{"shard": "1/2", "tiles_stored": 4, "batches": 1, "writer": None, "damaged": [], "set_aside": 0}])
        self.assertEqual(state["command_line"], "portrait sweep g.toml -o g.h5 --quiet --shard 1/2")
        text = self.run_program("info", "g.h5.run").out
        self.assertRegex(text, r"^a sweep that is stopped: 4 of 7 tiles stored, 57\.1 %, of 27,000 settings\nbegun     .*, portrait sweep g\.toml "
                               r"-o g\.h5 --quiet --shard 1/2\nmade by   portrait .*, method kernel, \w+\nshard 1/2      4 tiles in 1 batches\n$")
        result = self.run_program("verify", "g.h5")
        self.assertEqual((result.code, result.out), (0, "  1-of-2.000001.batch        4 tiles  ok\n"
                                                        "g.h5.run: whole so far, every tile is as it was written\n"))
        self.assert_fails(self.run_program("verify", "g.h5", "--sample", "3"), 2,
                          "g.h5 is a sweep that was stopped: --sample is for its portrait")
        self.shard("2/2")
        state = self.run_program("info", "g.h5", "--json").json
        self.assertEqual((state["state"], state["tiles_stored"], len(state["shards"])), ("all tiles stored, not merged", 7, 2))

    def test_a_running_one_and_a_second_writer(self):
        self.write("g.toml", GRID.replace("count = 3000", "count = 300000"))
        sweep = subprocess.Popen([program.PROGRAM, "sweep", "g.toml", "-o", "g.h5", "--quiet", "--threads", "1"], cwd=self.folder,
                                 stderr=subprocess.DEVNULL)
        try:
            while not (self.folder / "g.h5.run" / "1-of-1.data").exists():
                self.assertIsNone(sweep.poll(), "the sweep is too short for this test")
                time.sleep(0.01)
            state = self.run_program("info", "g.h5", "--json").json
            self.assertEqual(state["state"], "running")
            self.assertRegex(state["shards"][0]["writer"], rf"^process {sweep.pid} on \S+, since \d{{4}}-.*Z$")
            self.assertIn(f"written by process {sweep.pid} on ", self.run_program("info", "g.h5").out)
            for options in (("--resume",), ("--force",)):
                result = self.run_program("sweep", "g.toml", "-o", "g.h5", *options)
                self.assertEqual(result.code, 2)
                self.assertRegex(result.err, rf"^portrait: g\.h5\.run/1-of-1\.lock is being written by process {sweep.pid} on ")
        finally:
            sweep.send_signal(signal.SIGTERM)
            sweep.wait(60)
        self.assertEqual(sweep.returncode, 5)

    def test_damage_of_tiles_and_of_a_batch(self):
        whole = self.digests_of_a_single_run()
        self.shard("1/2")
        self.shard("2/2")
        self.flip("1-of-2.data", 4096 + 99)
        self.flip("2-of-2.000001.batch", 50)
        state = self.run_program("info", "g.h5", "--json").json
        self.assertEqual(state["tiles_stored"], 4, "info looks at batches, not at tiles")
        self.assertEqual(state["shards"][1]["damaged"], [{"file": "g.h5.run/2-of-2.000001.batch", "problem": "its digest differs"}])
        self.assertIn("  damaged: g.h5.run/2-of-2.000001.batch: its digest differs\n", self.run_program("info", "g.h5").out)
        result = self.run_program("verify", "g.h5")
        self.assertEqual((result.code, result.out),
                         (4, "  1-of-2.000001.batch        4 tiles  g.h5.run/1-of-2.data: tile 0 is not what was written\n"
                             "  2-of-2.000001.batch        0 tiles  its digest differs\ng.h5.run: BROKEN\n"))
        self.assert_fails(self.run_program("merge", "g.h5.run", "-o", "g.h5"), 4,
                          "g.h5.run/2-of-2.000001.batch: its digest differs: run shard 2/2 again with --resume")
        self.assertFalse((self.folder / "g.h5").exists())
        result = self.run_program("sweep", "g.toml", "-o", "g.h5", "--shard", "2/2", "--resume")
        self.assertTrue(result.err.startswith("portrait: damaged, set aside and computed again: g.h5.run/1-of-2.000001.batch: "
                                              "g.h5.run/1-of-2.data: tile 0 is not what was written\nportrait: damaged, set aside and computed "
                                              "again: g.h5.run/2-of-2.000001.batch: its digest differs\n"), result.err)
        state = self.run_program("info", "g.h5", "--json").json
        self.assertEqual([shard["set_aside"] for shard in state["shards"]], [1, 1])
        self.assertEqual([shard["tiles_stored"] for shard in state["shards"]], [0, 3])
        self.assertIn("  1 batches were damaged and set aside\n", self.run_program("info", "g.h5").out)
        self.assert_fails(self.run_program("merge", "g.h5.run", "-o", "g.h5"), 2, "4 of 7 tiles are missing: run shard 1/2 again with --resume")
        self.shard("1/2")
        self.assertEqual(self.run_program("merge", "g.h5.run", "-o", "g.h5", "--quiet").code, 0)
        self.assertEqual(self.run_program("verify", "g.h5").out, whole)

    def test_damaged_tiles_are_not_merged(self):
        self.shard("1/2")
        self.shard("2/2")
        self.flip("2-of-2.data", 4096 + 99)
        self.assert_fails(self.run_program("merge", "g.h5.run", "-o", "g.h5"), 4, "g.h5.run/2-of-2.data: tile 1 is not what was written")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["g.h5.run", "g.toml"])


class Resumed(Run):
    def test_the_command_that_is_printed_goes_on_to_the_same_portrait(self):
        self.write("g.toml", GRID.replace("count = 3000", "count = 30000"))
        whole = self.digests_of_a_single_run()
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGUSR1):
            sweep = subprocess.Popen([program.PROGRAM, "sweep", "g.toml", "-o", "g.h5"], cwd=self.folder, text=True, stderr=subprocess.PIPE)
            while not (self.folder / "g.h5.run" / "1-of-1.data").exists():
                self.assertIsNone(sweep.poll(), "the sweep is too short for this test")
            time.sleep(0.05)
            sweep.send_signal(number)
            error = sweep.communicate(timeout=60)[1]
            self.assertEqual(sweep.returncode, 5)
            command = shlex.split(error.splitlines()[-1])
            self.assertEqual(command[0], "portrait")
            self.assertEqual(self.run_program(*command[1:], "--quiet").code, 0)
            self.assertEqual(self.run_program("verify", "g.h5").out, whole)
            self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["g.h5", "g.toml"])
            (self.folder / "g.h5").unlink()

    def test_another_grid_or_method_is_refused(self):
        self.shard("1/2")
        self.write("g.toml", GRID.replace("0.55", "0.56"))
        result = self.run_program("sweep", "g.toml", "-o", "g.h5", "--resume")
        self.assert_fails(result, 2, "g.h5.run is of another run (--force throws it away):\n  the grid: line 8: "
                                     '"delta = [0.4, 0.55, 0.7]", now "delta = [0.4, 0.56, 0.7]"')
        self.write("g.toml", GRID)
        result = self.run_program("sweep", "g.toml", "-o", "g.h5", "--resume", env={**os.environ, "PORTRAIT_ISA": "base"})
        self.assertEqual(result.code, 2)
        self.assertRegex(result.err, r"another run .*:\n  the method: kernel, \w+, now kernel, base \(PORTRAIT_ISA chooses the instruction set\)\n")
        self.assertEqual(self.run_program("info", "g.h5", "--json").json["tiles_stored"], 4)

    def test_a_manifest_that_was_changed_is_refused(self):
        self.shard("1/2")
        path = self.folder / "g.h5.run" / "manifest.json"
        manifest = path.read_text()
        path.write_text(manifest.replace('"program": "portrait ', '"program": "portrait 99 '))
        result = self.run_program("sweep", "g.toml", "-o", "g.h5", "--resume")
        self.assert_fails(result, 4, "g.h5.run/manifest.json: it is not what was written (its fingerprint differs)")


class Merged(Run):
    def test_shards_of_another_run_are_refused(self):
        self.shard("1/2")
        self.write("h.toml", GRID.replace("0.55", "0.56"))
        self.shard("2/2", "h.h5", "h.toml")
        self.assert_fails(self.run_program("merge", "g.h5.run", "h.h5.run", "-o", "m.h5"), 2,
                          'h.h5.run is of another run:\n  the grid: line 8: "delta = [0.4, 0.55, 0.7]", now "delta = [0.4, 0.56, 0.7]"')
        self.assert_fails(self.run_program("merge", "g.h5.run", "none", "-o", "m.h5"), 2, "none.run: this is no run folder of a sweep")

    def test_shards_without_a_shared_disk_some_twice(self):
        whole = self.digests_of_a_single_run()
        self.shard("1/2")
        self.shard("2/2", "h.h5")
        self.shard("2/3", "k.h5")  # tiles 1 and 4: one of each of the others
        folders = ("g.h5", "h.h5.run", "k.h5.run")
        merged = self.run_program("merge", *folders, "-o", "m.h5", "--json").json
        self.assertEqual((merged["shards"], merged["tiles"], merged["duplicates"]), (3, 7, 2))
        self.assertEqual(self.run_program("verify", "m.h5").out.replace("m.h5", "g.h5"), whole)
        self.assert_fails(self.run_program("merge", *folders, "-o", "m.h5"), 2, "m.h5 exists already (--force replaces it)")
        self.assertEqual(self.run_program("merge", *folders, "-o", "m.h5", "--force", "--quiet").code, 0)


if __name__ == "__main__":
    program.main()
