#!/usr/bin/env python3
"""Runs a fuzz target of a build with libFuzzer, from the kept corpus on.

    tests/fuzz/run.py build/fuzz expression                       a short run, as the tests do
    tests/fuzz/run.py build/fuzz expression --runs 10000000 --keep   a long one; the corpus gets what reaches new code

Prints libFuzzer's last lines: executions, coverage. Ends with its exit code: not 0 for a crash, a leak or a failed check,
and then the input stands at the end of what it says.
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
import corpus  # noqa: E402

HERE = Path(__file__).resolve().parent


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("target", choices=["expression", "options", "grid_file", "loops", "record", "request", "http", "portrait_file"])
    parser.add_argument("--runs", type=int, default=20000)
    parser.add_argument("--max-len", type=int, default=256, help="bytes of an input")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", action="store_true", help="write the smallest corpus with the same coverage back")
    a = parser.parse_args()
    kept, program = HERE / "corpus" / f"{a.target}.txt", a.build.resolve() / "tests" / "fuzz" / f"{a.target}_fuzz"
    with tempfile.TemporaryDirectory() as scratch:
        grown, least = Path(scratch) / "grown", Path(scratch) / "least"
        grown.mkdir(), least.mkdir()
        corpus.unpack(kept, grown)
        options = [f"-runs={a.runs}", f"-seed={a.seed}", f"-max_len={a.max_len}", "-timeout=10", "-print_final_stats=1",
                   f"-artifact_prefix={scratch}/"]
        words = HERE / "corpus" / f"{a.target}.dict"
        if words.exists():
            options.append(f"-dict={words}")
        ran = subprocess.run([program, *options, grown], stderr=subprocess.PIPE, text=True, errors="replace")
        told = ran.stderr.splitlines()
        print("\n".join([line for line in told if " cov: " in line][-1:] + told[-25:]))
        if ran.returncode == 0 and a.keep:
            subprocess.run([program, "-merge=1", least, grown], check=True, stderr=subprocess.DEVNULL)
            corpus.pack(least, kept)
    return ran.returncode


if __name__ == "__main__":
    sys.exit(main())
