#!/usr/bin/env python3
"""Merging, verifying and exporting ten times as many settings takes hardly more memory: memory_test.py MERGE_RATE"""

import re
import subprocess
import sys
import tempfile

STEPS = ["merge", "verify", "export, NPY", "export, CSV", "export of half, NPY", "export of half, CSV"]


def megabytes(settings):
    """Of each step, at most at once."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([sys.argv[1], str(settings), folder], capture_output=True, text=True, check=True)
    found = {match[1].strip(): int(match[2]) for match in re.finditer(r"(?m)^(.{22}).* (\d+) MB of memory$", done.stdout)}
    print(done.stdout)
    return found


few, many = megabytes(100_000), megabytes(1_000_000)
for step in STEPS:
    # Records of 220 more tiles, some 2 KB each (portraits/merge.h), and what HDF5 keeps of its index; the values are 300 MB.
    if many[step] > few[step] + 20:
        sys.exit(f"failed: {step}: {few[step]} MB for 100,000 settings, {many[step]} MB for 1,000,000")
