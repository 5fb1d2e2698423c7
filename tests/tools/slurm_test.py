"""An array job of a real Slurm, one task of it killed and requeued, gives the portrait of a single run; mpirun too.

Starts munge, slurmctld and slurmd on this machine alone, in a folder of their own, and ends them afterwards. Needs root and
the Debian packages munge, slurmctld, slurmd, slurm-client, openmpi-bin: skipped, with the reason, where they are missing.
"""

import os
import pathlib
import shutil
import socket
import subprocess
import time
import unittest

import program
from program import ProgramTest, SMALL_GRID

GRID = SMALL_GRID.replace("step = 0.08", "count = 6000").replace("[0.4, 0.55, 0.7]", "{ from = 0.4, to = 0.7, count = 10 }")

CONFIGURATION = """ClusterName=t
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={port}
SlurmdPort={node_port}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={run}/munge.socket,cred_expire=5
CredType=cred/munge
StateSaveLocation={run}/state
SlurmdSpoolDir={run}/spool
SlurmctldPidFile={run}/ctld.pid
SlurmdPidFile={run}/d.pid
SlurmctldLogFile={run}/ctld.log
SlurmdLogFile={run}/d.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
ReturnToService=2
SchedulerParameters=bf_interval=1,sched_interval=1
KillWait=5
MinJobAge=3600
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} State=UNKNOWN
PartitionName=p Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""

JOB = """#!/bin/bash
#SBATCH --array=1-3 --requeue --open-mode=append --output={folder}/task-%a.log
cd {folder}
"{program}" sweep g.toml -o g.h5 --resume --threads 1 &
sweep=$!
trap 'kill -USR1 $sweep; wait $sweep; exit 5' USR1
wait $sweep
"""


STEPS = """#!/bin/bash
#SBATCH --array=1-2 --ntasks=2 --overcommit --output={folder}/steps-%a.log
cd {folder}
srun --ntasks=2 --overcommit "{program}" sweep g.toml -o steps.h5 --resume --threads 1 --quiet
"""


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


class Cluster:
    """A controller and a node, while this lives."""

    def __init__(self, run):
        self.run = run
        for folder in ("state", "spool"):
            (run / folder).mkdir()
        (run / "slurm.conf").write_text(CONFIGURATION.format(host=socket.gethostname().split(".")[0], run=run, cpus=os.cpu_count(),
                                                             port=free_port(), node_port=free_port()))
        self.environment = {**os.environ, "SLURM_CONF": str(run / "slurm.conf")}
        (run / "munge.key").write_bytes(os.urandom(128))
        os.chmod(run / "munge.key", 0o600)
        os.chmod(run, 0o755)
        self.daemons = []
        self.start("munged", "--foreground", f"--socket={run}/munge.socket", f"--key-file={run}/munge.key",
                   f"--pid-file={run}/munge.pid", f"--log-file={run}/munge.log", f"--seed-file={run}/munge.seed", "--force")
        self.wait_for(lambda: (run / "munge.socket").exists(), "munge")
        self.start("slurmctld", "-D", "-f", str(run / "slurm.conf"))
        self.start("slurmd", "-D", "-f", str(run / "slurm.conf"))
        self.wait_for(lambda: "idle" in self.command("sinfo", "-h", "-o", "%T", check=False), "the node")

    def start(self, *command):
        tool = shutil.which(command[0], path=os.environ["PATH"] + ":/usr/sbin:/sbin")
        with open(self.run / f"{command[0]}.out", "w") as out:
            self.daemons.append(subprocess.Popen([tool, *command[1:]], env=self.environment, stdout=out,
                                                 stderr=subprocess.STDOUT))

    def command(self, *words, check=True):
        return subprocess.run(words, env=self.environment, text=True, capture_output=True, check=check).stdout

    def wait_for(self, condition, what, seconds=90):
        end = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > end:
                logs = "".join(path.read_text(errors="replace")[-1500:] for path in self.run.glob("*.log"))
                raise AssertionError(f"waited {seconds} s for {what}\n{logs}\n{self.command('squeue', check=False)}")
            time.sleep(0.1)

    def close(self):
        for daemon in reversed(self.daemons):
            daemon.terminate()
            try:
                daemon.wait(20)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()


def missing(*tools):
    path = os.environ["PATH"] + ":/usr/sbin:/sbin"
    return [tool for tool in tools if shutil.which(tool, path=path) is None]


class OnACluster(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("g.toml", GRID)
        self.assertEqual(self.run_program("sweep", "g.toml", "-o", "whole.h5", "--quiet", "--shard", "1/1").code, 0)
        self.whole = self.run_program("verify", "whole.h5").out.replace("whole.h5", "g.h5")

    def check_merged(self):
        self.assertEqual(self.run_program("merge", "g.h5.run", "-o", "g.h5", "--quiet").code, 0)
        self.assertEqual(self.run_program("verify", "g.h5").out, self.whole)

    @unittest.skipIf(os.geteuid() != 0, "needs root")
    @unittest.skipIf(missing("slurmctld", "slurmd", "sbatch", "munged"), f"not installed: {missing('slurmctld', 'slurmd', 'sbatch', 'munged')}")
    def test_array_job_with_a_task_killed_and_requeued(self):
        run = pathlib.Path(self.folder) / "slurm"
        run.mkdir()
        cluster = Cluster(run)
        try:
            script = self.write("job.sh", JOB.format(folder=self.folder, program=program.PROGRAM))
            job = cluster.command("sbatch", "--parsable", str(script)).strip()
            data = self.folder / "g.h5.run" / "2-of-3.data"
            cluster.wait_for(data.exists, "task 2")
            cluster.command("scontrol", "requeue", f"{job}_2")
            restarts = lambda: "Restarts=1" in cluster.command("scontrol", "show", "job", f"{job}_2", check=False)
            cluster.wait_for(restarts, "the requeue")
            cluster.wait_for(lambda: not cluster.command("squeue", "-h", "-j", job, check=False).strip(), "the array", 300)
            states = cluster.command("scontrol", "show", "job", job)
            self.assertEqual(states.count("JobState=COMPLETED"), 3, states)
            self.run_steps(cluster)
        finally:
            cluster.close()
        self.check_merged()

    def run_steps(self, cluster):
        """srun within an array: a shard for each task of each step."""
        script = self.write("steps.sh", STEPS.format(folder=self.folder, program=program.PROGRAM))
        job = cluster.command("sbatch", "--parsable", str(script)).strip()
        cluster.wait_for(lambda: not cluster.command("squeue", "-h", "-j", job, check=False).strip(), "the steps", 300)
        logs = "".join(path.read_text(errors="replace") for path in self.folder.glob("steps-*.log"))
        stems = sorted(path.name for path in (self.folder / "steps.h5.run").glob("*.data"))
        self.assertEqual(stems, [f"{number}-of-4.data" for number in (1, 2, 3, 4)], logs)
        self.assertEqual(self.run_program("merge", "steps.h5.run", "-o", "steps.h5", "--quiet").code, 0)
        self.assertEqual(self.run_program("verify", "steps.h5").out.replace("steps.h5", "g.h5"), self.whole)

    @unittest.skipIf(missing("mpirun"), "mpirun is not installed")
    def test_mpirun(self):
        subprocess.run(["mpirun", "-n", "4", "--oversubscribe", *(["--allow-run-as-root"] if os.geteuid() == 0 else []),
                        program.PROGRAM, "sweep", "g.toml", "-o", "g.h5", "--quiet", "--threads", "1"],
                       cwd=self.folder, check=True, timeout=300)
        stems = sorted(path.name for path in (self.folder / "g.h5.run").glob("*.data"))
        self.assertEqual(stems, [f"{rank}-of-4.data" for rank in (1, 2, 3, 4)])
        self.check_merged()


if __name__ == "__main__":
    program.main()
