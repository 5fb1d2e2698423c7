"""The start of the programs that watch or disturb a writer with strace."""

import os
import shutil
import sys
import tempfile

SIZES = "5,4,900"  # of the portrait that is written


def run(check):
    """Calls check(program, folder) with the helper program of the command line and an empty folder."""
    program = sys.argv[1]
    if shutil.which("strace") is None:
        sys.exit("this test needs strace: install the package strace")
    os.environ["ASAN_OPTIONS"] = "detect_leaks=0"  # the leak detector is a tracer too, and there can be only one
    with tempfile.TemporaryDirectory() as folder:
        check(program, folder)
