"""A disk that fails while a portrait is written ends in one plain line, and leaves nothing behind.

* full: from some write on, every write to the file fails
* hiccup: one write or sync fails
* lossy: one write claims success, yet its first byte is lost

usage: failing_disk.py SAMPLE_PORTRAIT    (the helper program that writes sample portraits)
"""

import os
import subprocess

import traced
from traced import SIZES

RUNS = 25
# The shell's process becomes the program's, so the name of the temporary file is known before it starts.
ON_ITS_FILE = 'exec strace -D -qq -o /dev/null -P "$1.tmp-$$-0" -e trace=$3 -e inject=$3:$4 "$2" write $5 "$1"'


def run_with_fault(program, path, call, fault):
    return subprocess.run(["bash", "-c", ON_ITS_FILE, "bash", path, program, call, fault, SIZES],
                          stderr=subprocess.PIPE, text=True, timeout=60)


def calls_of(program, path, call):
    """How often a whole run makes the call on its file."""
    log = path + ".log"
    counting = ON_ITS_FILE.replace("/dev/null", log).replace("-e inject=$3:$4", "")
    subprocess.run(["bash", "-c", counting, "bash", path, program, call, "", SIZES], check=True)
    with open(log, encoding="utf-8", errors="replace") as lines:
        count = sum(f"{call}(" in line for line in lines)
    os.remove(log)
    os.remove(path)
    return count


def spread(count):
    return sorted({1 + count * i // RUNS for i in range(RUNS)} | {count})


def check_failure(folder, run, words, case):
    assert run.returncode == 1, (case, run)
    lines = run.stderr.splitlines()
    assert len(lines) == 1 and "p.h5" in lines[0] and words in lines[0], (case, run.stderr)
    assert os.listdir(folder) == [], (case, os.listdir(folder))


def check_full(program, folder, path, writes):
    for number in spread(writes):
        for when in (f"{number}", f"{number}+"):
            run = run_with_fault(program, path, "pwrite64", f"error=ENOSPC:when={when}")
            check_failure(folder, run, ": No space left on device", ("pwrite64", when, writes))


def check_other_calls(program, folder, path):
    """Cutting the file to its length, our own syncs and renaming."""
    for call, fault, words in [("ftruncate", "error=ENOSPC", "No space left on device"),
                               ("fsync", "error=EIO", "Input/output error"),
                               ("fdatasync", "error=EIO", "Input/output error"),
                               ("renameat2", "error=EPERM", "Operation not permitted")]:
        count = calls_of(program, path, call)
        assert count > 0, call
        run = run_with_fault(program, path, call, f"{fault}:when=1")
        check_failure(folder, run, words, (call, 1))


def check_close(program, folder, path):
    """What was synced is not lost by a close that fails; HDF5's own, before the last sync, is told of."""
    told = 0
    for number in range(1, calls_of(program, path, "close") + 1):
        run = run_with_fault(program, path, "close", f"error=EIO:when={number}")
        if run.returncode == 0:
            subprocess.run([program, "verify", path], check=True, stdout=subprocess.DEVNULL)
            os.remove(path)
        else:
            assert os.listdir(folder) == [] and len(run.stderr.splitlines()) == 1, (number, run)
            told += "Input/output error" in run.stderr
    assert told > 0


def check_lossy(program, folder, path, writes):
    """A byte that is written again later, or that nobody reads, may be lost."""
    noticed = 0
    for number in spread(writes):
        run = run_with_fault(program, path, "pwrite64", f"retval=1:when={number}")
        if run.returncode == 0:
            subprocess.run([program, "verify", path], check=True, stdout=subprocess.DEVNULL)
            os.remove(path)
        else:
            check_failure(folder, run, "p.h5", ("lossy", number, writes))
            noticed += "does not give back what was written" in run.stderr or "does not read back" in run.stderr
    assert noticed > 0


def check(program, folder):
    path = os.path.join(folder, "p.h5")
    writes = calls_of(program, path, "pwrite64")
    assert writes > 50, writes
    check_full(program, folder, path, writes)
    check_other_calls(program, folder, path)
    check_close(program, folder, path)
    check_lossy(program, folder, path, writes)


if __name__ == "__main__":
    traced.run(check)
