"""A writer killed at any moment leaves its target as it was, or complete: never half a file.

Kills the writer at writes spread over the whole run, and at every call that syncs or renames, once with no file of the
target's name and once while replacing a complete portrait; and with a file system that cannot rename without replacing.

usage: kill_writer.py SAMPLE_PORTRAIT    (the helper program that writes sample portraits)
"""

import os
import shutil
import signal
import subprocess

import traced
from traced import SIZES

OLD_SIZES = "3,4"
RUNS = 30
CALLS = "pwrite64,ftruncate,fsync,rename,renameat2,link,unlink"


def strace(*options):
    return ["strace", "-f", "-qq", *options]


def calls_of(command, log):
    """How often a whole run makes each of the calls."""
    subprocess.run(strace("-o", log, "-e", f"trace={CALLS}") + command, check=True)
    counts = dict.fromkeys(CALLS.split(","), 0)
    with open(log, encoding="utf-8", errors="replace") as lines:
        for line in lines:
            name = line.split("(")[0].split()[-1]
            if name in counts:
                counts[name] += 1
    os.remove(log)
    return counts


def run_killed(command, call, number):
    kill = strace("-o", "/dev/null", "-e", f"trace={call}", "-e", f"inject={call}:signal=SIGKILL:when={number}")
    run = subprocess.run(kill + command, stderr=subprocess.PIPE, text=True, timeout=60)
    assert run.returncode == -signal.SIGKILL, (call, number, run)


def check_linking(program, folder):
    """Where the file system cannot rename without replacing, the name is a second link first."""
    path = os.path.join(folder, "link.h5")
    command = [program, "write", OLD_SIZES, path]
    no_rename = strace("-o", "/dev/null", "-e", "trace=renameat2,link,unlink", "-e", "inject=renameat2:error=EINVAL")
    subprocess.run(no_rename + command, check=True)
    verified(program, path)
    assert subprocess.run(no_rename + command, stderr=subprocess.DEVNULL).returncode == 2, "refused the second time"
    os.remove(path)
    for call, there in {"link": False, "unlink": True}.items():
        killed = subprocess.run(no_rename + ["-e", f"inject={call}:signal=SIGKILL:when=1"] + command)
        assert killed.returncode == -signal.SIGKILL
        assert os.path.exists(path) == there, call
    verified(program, path)


def moments(counts):
    for call, count in counts.items():
        runs = min(count, RUNS)
        for i in range(runs):
            yield call, 1 + count * i // runs


def verified(program, path):
    run = subprocess.run([program, "verify", path], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert run.returncode == 0, run.stdout
    return run.stdout


def check_new(program, folder):
    """No file of that name at first: afterwards none, or the whole portrait."""
    path = os.path.join(folder, "new.h5")
    command = [program, "write", SIZES, path]
    counts = calls_of(command, path + ".log")
    whole = verified(program, path)
    finished = 0
    for call, number in moments(counts):
        if os.path.exists(path):
            os.remove(path)
        run_killed(command, call, number)
        if os.path.exists(path):
            finished += 1
            assert verified(program, path) == whole, (call, number)
    assert finished > 0, "the kill after renaming leaves the whole portrait"


def check_replacing(program, folder):
    """A portrait of that name at first: afterwards the same, or the whole new one."""
    path, spare = os.path.join(folder, "old.h5"), os.path.join(folder, "spare.h5")
    subprocess.run([program, "write", OLD_SIZES, spare], check=True)
    old = verified(program, spare)
    shutil.copy(spare, path)
    command = [program, "replace", SIZES, path]
    counts = calls_of(command, path + ".log")
    whole = verified(program, path)
    for call, number in moments(counts):
        shutil.copy(spare, path)
        run_killed(command, call, number)
        assert verified(program, path) in (old, whole), (call, number)


def check(program, folder):
    check_new(program, folder)
    check_replacing(program, folder)
    check_linking(program, folder)
    for name in os.listdir(folder):
        assert name in ("new.h5", "old.h5", "spare.h5", "link.h5") or ".h5.tmp-" in name, name


if __name__ == "__main__":
    traced.run(check)
