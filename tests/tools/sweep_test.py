"""portrait sweep: the summary, the dry run, wrong grids, interruption, the same bits for any number of threads."""

import os
import resource
import shutil
import signal
import subprocess
import time

import program
from program import ProgramTest, SMALL_GRID

LONG_GRID = SMALL_GRID.replace("step = 0.08", "count = 4000").replace("[0.4, 0.55, 0.7]", "{ from = 0.4, to = 0.7, count = 401 }")


class Sweep(ProgramTest):
    def test_json_summary(self):
        self.write("g.toml", SMALL_GRID)
        result = self.run_program("sweep", "g.toml", "-o", "g.h5", "--json")
        answer = result.json
        self.assertEqual((result.code, answer["settings"], answer["file"]), (0, 27, "g.h5"))
        self.assertEqual(answer["settled"] + answer["not_settled"] + answer["unstable"], 27)
        self.assertGreater(answer["settings_per_second"], 0)
        self.assertGreater(answer["seconds"], 0)

    def test_summary_goes_to_stderr_and_quiet_says_nothing(self):
        self.write("g.toml", SMALL_GRID)
        result = self.run_program("sweep", "g.toml", "-o", "g.h5")
        self.assertEqual(result.out, "")
        self.assertRegex(result.err, r"portrait: 27 settings in .* on \d+ threads, [\d,]+ settings/s\n")
        result = self.run_program("sweep", "g.toml", "-o", "g.h5", "--force", "--quiet")
        self.assertEqual((result.code, result.out, result.err), (0, "", ""))

    def test_an_existing_file_is_kept(self):
        self.small_portrait()
        before = (self.folder / "small.h5").read_bytes()
        self.assert_fails(self.run_program("sweep", "small.toml", "-o", "small.h5"), 2,
                          "small.h5 exists already (--force replaces it)")
        self.assertEqual((self.folder / "small.h5").read_bytes(), before)

    def test_dry_run_writes_nothing(self):
        self.write("g.toml", LONG_GRID)
        result = self.run_program("sweep", "g.toml", "-o", "g.h5", "--dry-run", "--threads", "2")
        self.assertEqual(result.code, 0)
        self.assertRegex(result.out, r"^4,812,000 settings in [\d,]+ tiles, 36 measures each\nabout .* on 2 threads, at most .* on disk\n$")
        self.assertFalse((self.folder / "g.h5").exists())
        answer = self.run_program("sweep", "g.toml", "--dry-run", "--json").json
        self.assertEqual(answer["settings"], 4812000)

    def test_dry_run_of_a_grid_that_no_memory_holds(self):
        self.write("g.toml", LONG_GRID.replace("count = 4000", "count = 4000000000").replace("count = 401 ", "count = 40000000 "))
        result = self.run_program("sweep", "g.toml", "--dry-run", "--json")
        self.assertEqual(result.json["settings"], 4000000000 * 40000000 * 3)

    def test_wrong_grid(self):
        self.write("g.toml", SMALL_GRID.replace("kappa", "kapa"))
        self.assert_fails(self.run_program("sweep", "g.toml", "-o", "g.h5"), 2,
                          'g.toml:7:1: unknown key "kapa" (did you mean "kappa"?)')
        self.assert_fails(self.run_program("sweep", "none.toml", "-o", "g.h5"), 2,
                          "none.toml: cannot be read: No such file or directory")
        self.assertEqual([path.name for path in self.folder.iterdir()], ["g.toml"])

    def test_output_is_needed(self):
        self.write("g.toml", SMALL_GRID)
        self.assert_fails(self.run_program("sweep", "g.toml"), 2, "-o FILE.h5 is missing: where shall the portrait go?")
        self.assert_fails(self.run_program("sweep", "g.toml", "-o", "no/folder/g.h5"), 2,
                          "no/folder/g.h5: there is no directory no/folder")

    def test_same_values_for_any_number_of_threads(self):
        self.write("g.toml", SMALL_GRID.replace("step = 0.08", "count = 50"))
        digests = set()
        for threads in (1, 2, 5):
            self.run_program("sweep", "g.toml", "-o", "g.h5", "--quiet", "--force", "--threads", threads)
            digests.add(self.run_program("verify", "g.h5").out)
        self.assertEqual(len(digests), 1)
        self.assertIn("IAE_w", digests.pop())

    def start_long_sweep(self):
        self.write("g.toml", LONG_GRID)
        sweep = subprocess.Popen([program.PROGRAM, "sweep", "g.toml", "-o", "g.h5"], cwd=self.folder, text=True,
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        while not (self.folder / "g.h5.run" / "1-of-1.data").exists():
            self.assertIsNone(sweep.poll(), "the sweep is too short for this test")
            time.sleep(0.01)
        time.sleep(0.2)
        return sweep

    def test_ctrl_c_ends_cleanly(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGUSR1):
            sweep = self.start_long_sweep()
            sweep.send_signal(number)
            out, err = sweep.communicate(timeout=60)
            self.assertEqual(sweep.returncode, 5)
            self.assertRegex(err, r"portrait: stopped with [\d,]+ of [\d,]+ tiles stored in g.h5.run; go on with:\n"
                                  r"  portrait sweep g.toml -o g.h5 --resume\n$")
            self.assertFalse((self.folder / "g.h5").exists())
            state = self.run_program("info", "g.h5", "--json").json
            self.assertEqual(state["state"], "stopped")
            self.assertGreater(state["tiles_stored"], 0)
            self.assertEqual(self.run_program("verify", "g.h5").code, 0)
            self.assertEqual(self.run_program("sweep", "g.toml", "-o", "g.h5").code, 2)
            shutil.rmtree(self.folder / "g.h5.run")

    def test_second_ctrl_c_leaves_at_once_and_is_in_nobodys_way(self):
        sweep = self.start_long_sweep()
        sweep.send_signal(signal.SIGSTOP)
        sweep.send_signal(signal.SIGINT)
        sweep.send_signal(signal.SIGTERM)  # two pending signals, so that the second comes before the first is acted on
        sweep.send_signal(signal.SIGCONT)
        sweep.communicate(timeout=60)
        self.assertEqual(sweep.returncode, 130)
        self.assertFalse((self.folder / "g.h5").exists())
        self.write("g.toml", SMALL_GRID)  # another grid: the first left no batch
        self.assertEqual(self.run_program("sweep", "g.toml", "-o", "g.h5", "--quiet").code, 0)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["g.h5", "g.toml"])

    def test_a_file_that_may_not_grow_is_reported_and_leaves_nothing(self):
        self.write("g.toml", LONG_GRID.replace("count = 4000", "count = 20").replace("count = 401 ", "count = 40 "))

        def limit_file_size():
            resource.setrlimit(resource.RLIMIT_FSIZE, (65536, 65536))

        result = self.run_program("sweep", "g.toml", "-o", "g.h5", "--quiet", preexec_fn=limit_file_size)
        self.assertEqual(result.code, 1)
        self.assertRegex(result.err, r"^portrait: g\.h5.*File too large\n$")
        self.assertEqual([path.name for path in self.folder.iterdir()], ["g.toml"])

    def test_shards_merge_into_the_portrait_of_the_whole(self):
        self.write("g.toml", SMALL_GRID.replace("step = 0.08", "count = 3000"))
        self.assertEqual(self.run_program("sweep", "g.toml", "-o", "whole.h5", "--quiet").code, 0)
        environments = [{"OMPI_COMM_WORLD_RANK": "0", "OMPI_COMM_WORLD_SIZE": "3"},
                        {"SLURM_ARRAY_TASK_ID": "7", "SLURM_ARRAY_TASK_MIN": "3", "SLURM_ARRAY_TASK_STEP": "2",
                         "SLURM_ARRAY_TASK_COUNT": "3"}]
        for environment in environments:
            self.assertEqual(self.run_program("sweep", "g.toml", "-o", "g.h5", "--quiet",
                                              env={**os.environ, **environment}).code, 0)
        self.assert_fails(self.run_program("merge", "g.h5.run", "-o", "g.h5"), 2,
                          "2 of 7 tiles are missing: run shard 2/3 again with --resume")
        answer = self.run_program("sweep", "g.toml", "-o", "g.h5", "--json", "--shard", "2/3").json
        self.assertEqual((answer["shard"], answer["file"]), ("2/3", "g.h5.run"))
        merged = self.run_program("merge", "g.h5.run", "-o", "g.h5", "--json").json
        self.assertEqual((merged["settings"], merged["shards"], merged["tiles"]), (27000, 3, 7))
        whole = self.run_program("verify", "whole.h5").out.replace("whole.h5", "g.h5")
        self.assertEqual(self.run_program("verify", "g.h5").out, whole)

    def test_shards_from_the_environment(self):
        self.write("g.toml", SMALL_GRID)
        clean = {name: value for name, value in os.environ.items() if not name.startswith(("SLURM_", "PMI_", "OMPI_"))}
        array = {"SLURM_ARRAY_TASK_ID": "1", "SLURM_ARRAY_TASK_MIN": "0", "SLURM_ARRAY_TASK_COUNT": "2"}
        srun = {"SLURM_PROCID": "2", "SLURM_STEP_NUM_TASKS": "4"}
        pmi = {"PMI_RANK": "0", "PMI_SIZE": "2"}
        openmpi = {"OMPI_COMM_WORLD_RANK": "1", "OMPI_COMM_WORLD_SIZE": "3"}
        batch = {"SLURM_PROCID": "0", "SLURM_NTASKS": "8"}  # of sbatch, in no step: one process for all

        def sweep(environment, *options):
            return self.run_program("sweep", "g.toml", "-o", "g.h5", "--force", *options, env={**clean, **environment})

        for environment, shard in ((srun, "3/4"), ({**srun, **array}, "7/8"), (pmi, "1/2"), ({**pmi, **array}, "3/4"),
                                   ({**openmpi, **srun, **pmi}, "2/3"), ({**pmi, "SLURM_PROCID": "0", "SLURM_STEP_NUM_TASKS": "1"}, "1/2"),
                                   (batch, None), ({"PMI_RANK": "3"}, None)):
            self.assertEqual(sweep(environment, "--json").json.get("shard"), shard, environment)
        self.assertEqual(sweep(srun, "--json", "--shard", "2/5").json["shard"], "2/5")
        for environment, message in (
                ({"PMI_RANK": "2", "PMI_SIZE": "2"}, "the rank in the environment must be I/N with 1 <= I <= N <= 1000000"),
                ({"PMI_RANK": "one", "PMI_SIZE": "2"}, "the environment says no number in PMI_RANK: give --shard I/N"),
                ({"SLURM_PROCID": "1", "SLURM_STEP_NUM_TASKS": "0"}, "the rank in the environment must be I/N with 1 <= I <= N <= 1000000"),
                ({**array, "SLURM_ARRAY_TASK_ID": "7"}, "the tasks of this array are not evenly numbered: give --shard I/N")):
            self.assert_fails(sweep(environment), 2, message)

    def test_wrong_shards(self):
        self.write("g.toml", SMALL_GRID)
        for text in ("0/3", "4/3", "1", "a/b", "1/0"):
            self.assert_fails(self.run_program("sweep", "g.toml", "-o", "g.h5", "--shard", text), 2,
                              f"--shard {text} must be I/N with 1 <= I <= N <= 1000000")

    def test_resume_of_what_is_complete(self):
        self.small_portrait()
        result = self.run_program("sweep", "small.toml", "-o", "small.h5", "--resume")
        self.assertEqual((result.code, result.err), (0, "portrait: small.h5 is complete already\n"))
        self.write("small.toml", SMALL_GRID.replace("0.55", "0.56"))
        result = self.run_program("sweep", "small.toml", "-o", "small.h5", "--resume")
        self.assertEqual(result.code, 2)
        self.assertIn("small.h5 is there, of another run (--force replaces it):\n  the grid: line 8", result.err)


if __name__ == "__main__":
    program.main()
