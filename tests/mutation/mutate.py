#!/usr/bin/env python3
"""Changes one token of a source at a time, builds a test program and runs it: a mutant that all tests let pass shows what none checks.

    tests/mutation/mutate.py build/dev engine/measures/variation.cpp tests/engine/measures/measures_test measures_test
    tests/mutation/mutate.py build/dev portraits/query/ranking.cpp tests/portraits/query/query_test query_test --most 20 --seed 3

BUILD, the source, the test program under BUILD, its target; --filter as googletest takes it, --most mutants chosen by --seed, or
those --at places. Prints a
line a mutant: killed, survived, or not compiled; ends with 1 when one survived. The source is put back, whatever happens. A working
tree that differs in that file is refused.
"""

import argparse
import random
import re
import signal
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/house"))
sys.dont_write_bytecode = True
from include_order import without_comments_and_texts  # noqa: E402

# What is looked for, and what stands there instead. Spaces around tell operators from templates, references and signs.
CHANGES = [
    (r" < ", [" <= ", " > "]), (r" <= ", [" < "]), (r" > ", [" >= ", " < "]), (r" >= ", [" > "]),
    (r" == ", [" != "]), (r" != ", [" == "]), (r" && ", [" || "]), (r" \|\| ", [" && "]),
    (r" \+ ", [" - "]), (r" - ", [" + "]), (r" \* ", [" / "]), (r" / ", [" * "]),
    (r" \+= ", [" -= "]), (r" -= ", [" += "]), (r"\+\+", ["--"]),
    (r"\bstd::min\b", ["std::max"]), (r"\bstd::max\b", ["std::min"]), (r"\btrue\b", ["false"]), (r"\bfalse\b", ["true"]),
    (r"(?<=[\s(,])0(?=[;,)\s])", ["1"]), (r"(?<=[\s(,])1(?=[;,)\s])", ["0", "2"]), (r"\bcontinue;", [";"]), (r"(?<=\()!(?=\w)", [""]),
]


def mutants(source):
    """(line, column, old, new) of every change, only in code: comments, texts, includes and assertions are left."""
    found = []
    for number, line in enumerate(without_comments_and_texts(source)):
        if line.lstrip().startswith("#") or re.search(r"PORTRAIT_(CHECK|ASSERT)|^\s*template|static_assert", line):
            continue
        for pattern, others in CHANGES:
            for match in re.finditer(pattern, line):
                found += [(number, match.start(), match.group(), other) for other in others]
    return sorted(found)


def mutated(source, mutant):
    number, column, old, new = mutant
    lines = source.split("\n")
    line = lines[number]
    assert line[column:column + len(old)] == old
    lines[number] = line[:column] + new + line[column + len(old):]
    return "\n".join(lines)


def outcome(build, target, program, tests):
    made = subprocess.run(["cmake", "--build", build, "--target", target], capture_output=True, check=False)
    if made.returncode != 0:
        return "not compiled"
    words = [program, "--gtest_brief=1", "--gtest_fail_fast"] + ([f"--gtest_filter={tests}"] if tests else [])
    try:
        return "survived" if subprocess.run(words, capture_output=True, timeout=120, check=False).returncode == 0 else "killed"
    except subprocess.TimeoutExpired:
        return "killed"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("source")
    parser.add_argument("program")
    parser.add_argument("target")
    parser.add_argument("--filter", default="")
    parser.add_argument("--most", type=int, default=0, help="so many, chosen at random; 0: all")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--at", nargs="*", default=[], metavar="LINE:COLUMN", help="only those that stand there, as they are printed")
    a = parser.parse_args()
    path, build = ROOT / a.source, a.build.resolve()
    if subprocess.run(["git", "-C", ROOT, "diff", "--quiet", "--", a.source], check=False).returncode != 0:
        parser.error(f"{a.source} has changes that are not committed")
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    source = path.read_text()
    all_of_them = mutants(source)
    if a.at:
        all_of_them = [m for m in all_of_them if f"{m[0] + 1}:{m[1] + 1}" in a.at]
    chosen = sorted(random.Random(a.seed).sample(all_of_them, a.most)) if 0 < a.most < len(all_of_them) else all_of_them
    counts = {"killed": 0, "survived": 0, "not compiled": 0}
    try:
        if outcome(build, a.target, build / a.program, a.filter) != "survived":
            parser.error("the tests do not pass as it is")
        for mutant in chosen:
            path.write_text(mutated(source, mutant))
            said = outcome(build, a.target, build / a.program, a.filter)
            counts[said] += 1
            print(f"{a.source}:{mutant[0] + 1}:{mutant[1] + 1}: {mutant[2].strip()} -> {mutant[3].strip() or '(nothing)'}: {said}", flush=True)
    finally:
        path.write_text(source)
        subprocess.run(["cmake", "--build", build, "--target", a.target], capture_output=True, check=False)
    print(f"{a.source}: {len(chosen)} of {len(all_of_them)} mutants, " + ", ".join(f"{n} {what}" for what, n in counts.items()))
    return 1 if counts["survived"] else 0


if __name__ == "__main__":
    sys.exit(main())
