#!/usr/bin/env python3
"""Changes one token of a source at a time, builds a test program and runs it: a mutant that all tests let pass shows what none checks.

    tests/mutation/mutate.py build/dev engine/measures/variation.cpp tests/engine/measures/measures_test measures_test
    tests/mutation/mutate.py build/dev portraits/query/ranking.cpp tests/portraits/query/portraits_query_test portraits_query_test --most 20
    tests/mutation/mutate.py build/dev engine/kernel/gain.inl tests/engine/kernel/kernel_test kernel_test --unit engine/isa/base.cpp --flags=-O1

BUILD, the source, the test program under BUILD, its target; --filter as googletest takes it, --most mutants chosen by --seed, or those
--at places. Prints a line a mutant: killed, survived, or not compiled; ends with 1 when one survived.

The working tree and the build stay as they are: a mutant is a copy, compiled alone with --flags and linked before the libraries. A
file that is included is changed for one --unit only; what includes it otherwise keeps it.
"""

import argparse
import random
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
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


class Program:
    """How a test program is built with one object of its own."""

    def __init__(self, build, program, target, source, unit, flags, tests):
        said = subprocess.run(["ninja", "-C", build, "-t", "commands", target], capture_output=True, text=True, check=True).stdout
        lines = said.splitlines()
        ours = [words for words in map(shlex.split, (line for line in lines if " -c " in line))
                if (build / words[-1]).resolve() == ROOT / unit]
        assert len(ours) == 1, f"{target} does not compile {unit}"
        words = ours[0][1:] if ours[0][0].endswith("ccache") else ours[0]
        self.compile = words[:words.index("-MD")] + flags
        link = shlex.split(lines[-1])
        link = link[link.index("&&") + 1:]
        self.link = link[:link.index("&&")] if "&&" in link else link
        assert self.link[self.link.index("-o") + 1] == program, f"{target} is not {program}"
        self.build, self.source, self.unit, self.tests = build, source, unit, tests

    def outcome(self, text):
        with tempfile.TemporaryDirectory() as folder:
            copy, made, program = Path(folder) / self.source, Path(folder) / "mutant.o", Path(folder) / "program"
            copy.parent.mkdir(parents=True)
            copy.write_text(text)
            unit = copy if self.unit == self.source else ROOT / self.unit
            compiled = [self.compile[0], f"-I{folder}", *self.compile[1:], "-o", made, "-c", unit]
            linked = [program if word == self.link[self.link.index("-o") + 1] else word for word in self.link]
            linked[1:1] = ["-Wl,-s", *(["-fuse-ld=lld"] if shutil.which("ld.lld") else []), made]
            for words in (compiled, linked):
                if subprocess.run(words, cwd=self.build, capture_output=True, check=False).returncode != 0:
                    return "not compiled"
            words = [program, "--gtest_brief=1", "--gtest_fail_fast"] + ([f"--gtest_filter={self.tests}"] if self.tests else [])
            try:
                return "survived" if subprocess.run(words, capture_output=True, timeout=300, check=False).returncode == 0 else "killed"
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
    parser.add_argument("--unit", help="what to compile: the source itself, or what includes it")
    parser.add_argument("--flags", type=str.split, default=["-O0", "-g0"], help="the last of the compiler's")
    parser.add_argument("--jobs", type=int, default=1)
    a = parser.parse_args()
    build = a.build.resolve()
    subprocess.run(["cmake", "--build", build, "--target", a.target], capture_output=True, check=True)
    program = Program(build, a.program, a.target, a.source, a.unit or a.source, a.flags, a.filter)
    source = (ROOT / a.source).read_text()
    all_of_them = mutants(source)
    if a.at:
        all_of_them = [m for m in all_of_them if f"{m[0] + 1}:{m[1] + 1}" in a.at]
    chosen = sorted(random.Random(a.seed).sample(all_of_them, a.most)) if 0 < a.most < len(all_of_them) else all_of_them
    if program.outcome(source) != "survived":
        parser.error("the tests do not pass as it is")
    counts = {"killed": 0, "survived": 0, "not compiled": 0}
    with ThreadPoolExecutor(a.jobs) as pool:
        for mutant, said in zip(chosen, pool.map(lambda m: program.outcome(mutated(source, m)), chosen)):
            counts[said] += 1
            print(f"{a.source}:{mutant[0] + 1}:{mutant[1] + 1}: {mutant[2].strip()} -> {mutant[3].strip() or '(nothing)'}: {said}", flush=True)
    print(f"{a.source}: {len(chosen)} of {len(all_of_them)} mutants, " + ", ".join(f"{n} {what}" for what, n in counts.items()))
    return 1 if counts["survived"] else 0


if __name__ == "__main__":
    sys.exit(main())
