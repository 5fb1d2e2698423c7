"""A disk that fills up while a portrait is written ends in one plain line, and leaves nothing behind.

Each run lets one write, or a sync, fail as a full disk does. Left out are the last two writes, with which HDF5 closes
the file: they rewrite its first 48 bytes, which are on the disk by then, and HDF5 1.10 does not survive their failure.

usage: full_disk.py SAMPLE_PORTRAIT    (the helper program that writes sample portraits)
"""

import os
import shutil
import subprocess
import sys
import tempfile

SIZES = "5,4,300"
RUNS = 40


def run_with_failure(program, path, call, number):
    strace = ["strace", "-f", "-qq", "-o", "/dev/null", "-e", f"trace={call}"]
    failing = ["-e", f"inject={call}:error=ENOSPC:when={number}"]
    return subprocess.run(strace + failing + [program, "write", SIZES, path], stderr=subprocess.PIPE, text=True,
                          timeout=60)


def calls_of(program, path, call):
    """How often a whole run makes the call."""
    log = path + ".log"
    subprocess.run(["strace", "-f", "-qq", "-o", log, "-e", f"trace={call}", program, "write", SIZES, path], check=True)
    with open(log, encoding="utf-8", errors="replace") as lines:
        count = sum(f"{call}(" in line for line in lines)
    os.remove(log)
    os.remove(path)
    return count


def check_failure(folder, run, case):
    assert run.returncode == 1, (case, run)
    lines = run.stderr.splitlines()
    assert len(lines) == 1 and "p.h5" in lines[0], (case, run.stderr)
    assert lines[0].endswith(": No space left on device"), (case, lines)
    assert os.listdir(folder) == [], (case, os.listdir(folder))


def main():
    program = sys.argv[1]
    if shutil.which("strace") is None:
        sys.exit("this test needs strace: install the package strace")
    os.environ["ASAN_OPTIONS"] = "detect_leaks=0"  # the leak detector is a tracer too, and there can be only one
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "p.h5")
        writes = calls_of(program, path, "pwrite64") - 2
        for number in sorted({1 + writes * i // RUNS for i in range(RUNS)} | {writes}):
            check_failure(folder, run_with_failure(program, path, "pwrite64", number), ("pwrite64", number, writes))
        syncs = calls_of(program, path, "fsync") - 1  # the last is that of the folder: the portrait has its name
        assert syncs == 2, syncs
        for number in range(1, syncs + 1):
            check_failure(folder, run_with_failure(program, path, "fsync", number), ("fsync", number, syncs))


if __name__ == "__main__":
    main()
