#!/usr/bin/env python3
"""Every benchmark runs and says what it should: smoke_test.py PORTRAIT_BENCH"""

import json
import os
import subprocess
import sys
import tempfile

BENCH = sys.argv[1]
CASES = ["dipdt-pid", "dipdt-pid-fast", "ipdt-pi", "ipdt-pid", "fotd-pi"]
CODES = ["engine", "responses", "margins", "batched", "scalar"]
SWEEPS = ["scaling/one", "scaling/all", "store/nowhere", "store/file"]


def run(*arguments, isa=None):
    environment = {**os.environ, "PORTRAIT_ISA": isa or ""}
    return subprocess.run([BENCH, *arguments], capture_output=True, text=True, env=environment, check=False)


def check(condition, what):
    if not condition:
        sys.exit(f"failed: {what}")


def check_everything_runs(folder):
    done = run("--smoke", "--json", "--directory", folder)
    check(done.returncode == 0, done.stderr)
    check(done.stderr == "", done.stderr)
    report = json.loads(done.stdout)
    names = [(rate["case"], rate["code"]) for rate in report["rates"]]
    check(names == [(case, code) for case in CASES for code in CODES], names)
    for rate in report["rates"]:
        check(rate["settings_per_second"] > 0, rate)
        check(abs(rate["ns_per_setting"] * rate["settings_per_second"] - 1e9) < 1, rate)
        check(rate["engine_ratio"] > 0 and 0 < rate["worst_error"] < 5e-3, rate)
    check([kernel["case"] for kernel in report["kernel"]] == CASES, report["kernel"])
    for kernel in report["kernel"]:
        check(kernel["flops_per_setting"] > 1000 and 0 < kernel["share_of_peak"] < 1, kernel)
    check([sweep["sweep"] for sweep in report["sweeps"]] == SWEEPS, report["sweeps"])
    check(report["instruction_set"] == list(report["flops_per_second_at_peak"])[-1], report)
    check(report["repetitions"] == 1, report)
    check(os.listdir(folder) == [], "the sweep's file is left behind")


def check_table_and_filter():
    done = run("--smoke", "--filter", "fotd-pi/(engine|scalar)", isa="base")
    check(done.returncode == 0, done.stderr)
    lines = done.stdout.splitlines()
    check("instruction set base," in lines[0], lines)
    check([line.split()[0] for line in lines[2:]] == ["one", "fotd-pi", "fotd-pi"], lines)


def check_mistakes():
    done = run("--smoke", "--filter", "nothing")
    check((done.returncode, done.stdout, done.stderr.splitlines()[-1])
          == (1, "", 'portrait_bench: --filter: no benchmark is called like "nothing"'), done)
    check(run("--repetitions", "0").returncode == 2, "0 repetitions")
    check(run("--unknown").returncode == 2, "unknown option")
    done = run("--smoke", isa="avx1024")
    check(done.returncode == 1 and "PORTRAIT_ISA: unknown instruction set" in done.stderr, done)


with tempfile.TemporaryDirectory() as temporary:
    check_everything_runs(temporary)
check_table_and_filter()
check_mistakes()
