"""A sweep killed at any moment leaves either no output file or a whole one, and goes on when resumed."""

import random
import subprocess
import time

import program
from program import ProgramTest, SMALL_GRID


class Killed(ProgramTest):
    def test_kill_at_random_moments(self):
        self.write("g.toml", SMALL_GRID.replace("step = 0.08", "count = 60"))
        begin = time.monotonic()
        self.run_program("sweep", "g.toml", "-o", "g.h5", "--quiet")
        whole_run = time.monotonic() - begin
        whole = self.run_program("verify", "g.h5").out
        (self.folder / "g.h5").unlink()
        chance = random.Random(1)
        left = 0
        for _ in range(30):
            sweep = subprocess.Popen([program.PROGRAM, "sweep", "g.toml", "-o", "g.h5", "--quiet"], cwd=self.folder,
                                     stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(chance.uniform(0, 1.2 * whole_run))
            sweep.kill()
            sweep.wait()
            if (self.folder / "g.h5").exists():
                left += 1
            self.assertEqual(self.run_program("sweep", "g.toml", "-o", "g.h5", "--quiet", "--resume").code, 0)
            self.assertEqual(self.run_program("verify", "g.h5").out, whole)
            self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["g.h5", "g.toml"])
            (self.folder / "g.h5").unlink()
        self.assertLess(left, 30, "no run was killed before its end")


if __name__ == "__main__":
    program.main()
