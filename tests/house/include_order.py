#!/usr/bin/env python3
"""Keeps the flow of the house: which folder may include which, and which file holds the door to what is outside.

    include_order.py            checks the repository that this file lies in
    include_order.py ROOT       checks another tree
    include_order.py --self-test

Prints "file:line: what is wrong" for every finding and ends with 1, or prints nothing and ends with 0.
"""

import re
import sys
import tempfile
from pathlib import Path

# A file may include its own folder and those before it.
ORDER = ["engine/base", "engine/measures", "engine/loop", "engine/kernel", "engine/isa", "engine/reference", "engine/sweep",
         "engine/records", "engine/rules", "grids", "portraits", "portraits/query", "reproduce", "tools/pictures", "tools/page", "tools",
         "bench"]
# Where sources are looked for; one in a folder without a place in the order is a finding.
TOP_FOLDERS = ["engine", "grids", "portraits", "reproduce", "tools", "bench"]
SUFFIXES = {".h", ".hpp", ".c", ".cc", ".cpp"}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')

PROGRAMS = ("tools/", "bench/")
VECTOR_FOLDERS = ("engine/isa/", "engine/kernel/")
VECTOR_HEADER = re.compile(r"^((x86|[a-z]*mm)intrin\.h|immintrin\.h|arm_neon\.h|arm_sve\.h|experimental/simd|hwy/.*)$")

# Outside headers: what they are called, who may include them, and what to say otherwise.
HEADER_DOORS = [
    (re.compile(r"^(hdf5\.h|hdf5_hl\.h|H5\w*\.h)$"), lambda path: re.match(r"portraits/h5(_\w+)?\.(h|cpp)$", path),
     "HDF5 has one door, portraits/h5*"),
    (re.compile(r"^spawn\.h$"), lambda path: path == "tools/pictures/gnuplot.cpp",
     "other programs have one door, tools/pictures/gnuplot.cpp"),
    (re.compile(r"^omp\.h$"), lambda path: path == "engine/sweep/sweep.cpp",
     "OpenMP has one door, engine/sweep/sweep.cpp"),
    (re.compile(r"^iostream$"), lambda path: path.startswith(PROGRAMS), "only programs print (tools/, bench/)"),
    (VECTOR_HEADER, lambda path: path.startswith(VECTOR_FOLDERS),
     "vector instructions live in engine/isa/ and engine/kernel/"),
]

# The same for words in the code itself, outside comments and texts.
CODE_DOORS = [
    (re.compile(r"\b(popen|system)\s*\("), lambda path: False,
     "a shell reads what a user typed: use tools/pictures/gnuplot.h"),
    (re.compile(r"^\s*#\s*pragma\s+omp\b"), lambda path: path == "engine/sweep/sweep.cpp",
     "OpenMP has one door, engine/sweep/sweep.cpp"),
    (re.compile(r"\b(v?f?printf|puts|fputs|putchar)\s*\(|\bfmt::print\w*\b|\bstd::(cout|cerr|clog)\b"),
     lambda path: path.startswith(PROGRAMS), "only programs print (tools/, bench/)"),
    (re.compile(r"(\bstd::|(?<![\w.>:])|(?<!\w)::)(_?exit|quick_exit|abort)\s*\("),
     lambda path: path.startswith(PROGRAMS), "only programs end the process (tools/, bench/)"),
]

TOML_HEADER = re.compile(r"^toml(\+\+|plusplus)?(/|\.h|$)")


def without_comments_and_texts(source):
    """The source with comments, strings and characters blanked, line by line the same; includes keep theirs."""
    pattern = re.compile(r'//[^\n]*|/\*.*?\*/|R"([^()\s\\]*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'',
                         re.DOTALL)

    def blank(match):
        # A ' between digits parts a number: 10'000.
        before = source[match.start() - 1:match.start()]
        if match.group().startswith("'") and before.isalnum():
            return match.group()
        return re.sub(r"[^\n]", " ", match.group())

    lines = source.split("\n")
    blanked = pattern.sub(blank, source).split("\n")
    return [line if INCLUDE.match(line) and blanked[i].lstrip().startswith("#") else blanked[i]
            for i, line in enumerate(lines)]


class Tree:
    def __init__(self, root):
        self.root = Path(root)
        self.files = sorted(
            path.relative_to(self.root).as_posix()
            for top in TOP_FOLDERS for path in (self.root / top).rglob("*")
            if path.is_file() and path.suffix in SUFFIXES)
        self.findings = []
        self.includes = {}      # file -> [(line, included file of the tree)]
        self.toml_files = []    # [(file, line)]

    def find(self, path, line, text):
        self.findings.append((path, line, text))

    def check(self):
        for path in self.files:
            self.check_file(path)
        self.check_one_toml_file()
        self.check_cycles()
        return [f"{path}:{line}: {text}" for path, line, text in sorted(self.findings)]

    def check_file(self, path):
        raw = (self.root / path).read_bytes()
        self.includes[path] = []
        if folder_of(path) is None:
            self.find(path, 1, "its folder has no place in the order (ORDER in tests/house/include_order.py)")
        for number, line in enumerate(raw.split(b"\n"), 1):
            if any(byte > 126 for byte in line):
                self.find(path, number, "a byte outside ASCII")
        source = raw.decode("latin-1")
        for number, line in enumerate(without_comments_and_texts(source), 1):
            self.check_line(path, number, line)

    def check_line(self, path, number, line):
        include = INCLUDE.match(line)
        if include:
            self.check_include(path, number, include.group(1) == '"', include.group(2))
            return
        for pattern, allowed, text in CODE_DOORS:
            if pattern.search(line) and not allowed(path):
                self.find(path, number, text)

    def check_include(self, path, number, quoted, name):
        for pattern, allowed, text in HEADER_DOORS:
            if pattern.match(name) and not allowed(path):
                self.find(path, number, f"includes {name}: {text}")
        if TOML_HEADER.match(name):
            self.toml_files.append((path, number))
        target = self.resolved(path, name) if quoted else None
        if target is None:
            return
        self.includes[path].append((number, target))
        own, other = folder_of(path), folder_of(target)
        if own is not None and other is not None and ORDER.index(other) > ORDER.index(own):
            self.find(path, number, f"{own} may not include {other} ({target})")

    def resolved(self, path, name):
        """The file of the tree that a quoted include means: from the root, or beside the including file."""
        for candidate in (name, (Path(path).parent / name).as_posix()):
            if candidate in self.files:
                return candidate
        return None

    def check_one_toml_file(self):
        for path, number in self.toml_files:
            if path != self.toml_files[0][0]:
                self.find(path, number, f"toml++ has one door, and {self.toml_files[0][0]} is it")

    def check_cycles(self):
        state = {}

        def visit(path, trail):
            state[path] = "open"
            for number, target in self.includes[path]:
                if state.get(target) == "open":
                    cycle = [*trail[trail.index(target):], target]
                    self.find(path, number, "cycle of includes: " + " -> ".join(cycle))
                elif target not in state:
                    visit(target, [*trail, target])
            state[path] = "done"

        for path in self.files:
            if path not in state:
                visit(path, [path])


def folder_of(path):
    """The innermost folder of the order that the file lies in."""
    return max((folder for folder in ORDER if path.startswith(folder + "/")), key=len, default=None)


GOOD_TREE = {
    "engine/base/a.h": '#pragma once\n#include <string>\n// printf("x") and std::exit(1) in a comment\n',
    "engine/loop/b.cpp": '#include "engine/base/a.h"\nconst char* s = "fmt::print(1) // std::exit(0)";\n'
                         "int n = 10'000; void f() { snprintf_like(); at_exit(1); x.exit(2); }\n",
    "engine/sweep/sweep.cpp": '#include <omp.h>\n#include "engine/loop/c.h"\n#pragma omp parallel\n',
    "engine/loop/c.h": '#include "engine/base/a.h"\n',
    "grids/read.cpp": "#include <toml++/toml.h>\n",
    "portraits/h5.h": "#include <hdf5.h>\n",
    "portraits/h5.cpp": '#include "portraits/h5.h"\n#include <hdf5_hl.h>\n',
    "portraits/h5_call.h": "#include <H5Cpp.h>\n",
    "tools/main.cpp": '#include <iostream>\n#include "portraits/h5.h"\nint main() { fmt::print("x"); std::exit(1); }\n',
    "bench/loop_bench.cpp": '#include "engine/loop/c.h"\nint main() { std::printf("x"); }\n',
}

# Name of the violation -> files added to the good tree, and the findings they must give.
VIOLATIONS = {
    "a folder to the right": ({"engine/base/x.h": '#include "engine/loop/c.h"\n'},
                              ["engine/base/x.h:1: engine/base may not include engine/loop (engine/loop/c.h)"]),
    "a folder to the right, by a relative path": (
        {"engine/base/x.h": '\n#include "y.h"\n', "engine/base/y.h": '#include "tools/z.h"\n', "tools/z.h": ""},
        ["engine/base/y.h:1: engine/base may not include tools (tools/z.h)"]),
    "the program from the engine": ({"engine/sweep/x.cpp": '#  include "tools/z.h"\n', "tools/z.h": ""},
                                    ["engine/sweep/x.cpp:1: engine/sweep may not include tools (tools/z.h)"]),
    "a bench from the program": ({"tools/x.cpp": '#include "bench/z.h"\n', "bench/z.h": ""},
                                 ["tools/x.cpp:1: tools may not include bench (bench/z.h)"]),
    "a folder without a place": (
        {"engine/other/x.h": ""},
        ["engine/other/x.h:1: its folder has no place in the order (ORDER in tests/house/include_order.py)"]),
    "a cycle": ({"grids/p.h": '#include "grids/q.h"\n', "grids/q.h": '\n#include "grids/p.h"\n'},
                ["grids/q.h:2: cycle of includes: grids/p.h -> grids/q.h -> grids/p.h"]),
    "a file that includes itself": ({"grids/p.h": '#include "grids/p.h"\n'},
                                    ["grids/p.h:1: cycle of includes: grids/p.h -> grids/p.h"]),
    "toml++ twice": ({"grids/second.cpp": '#include <toml++/toml.hpp>\n'},
                     ["grids/second.cpp:1: toml++ has one door, and grids/read.cpp is it"]),
    "HDF5 elsewhere": ({"portraits/x.cpp": "#include <H5Cpp.h>\n"},
                       ["portraits/x.cpp:1: includes H5Cpp.h: HDF5 has one door, portraits/h5*"]),
    "HDF5 elsewhere, in quotes": (
        {"tools/x.cpp": '#include "hdf5.h"\n'},
        ["tools/x.cpp:1: includes hdf5.h: HDF5 has one door, portraits/h5*"]),
    "OpenMP elsewhere": ({"engine/sweep/x.cpp": "#include <omp.h>\n"},
                         ["engine/sweep/x.cpp:1: includes omp.h: OpenMP has one door, engine/sweep/sweep.cpp"]),
    "a pragma of OpenMP elsewhere": ({"engine/loop/x.cpp": "\n #pragma omp simd\n"},
                                     ["engine/loop/x.cpp:2: OpenMP has one door, engine/sweep/sweep.cpp"]),
    "iostream in the library": ({"grids/x.cpp": "#include <iostream>\n"},
                                ["grids/x.cpp:1: includes iostream: only programs print (tools/, bench/)"]),
    "printf in the library": ({"grids/x.cpp": 'void f() { std::printf("x"); }\n'},
                              ["grids/x.cpp:1: only programs print (tools/, bench/)"]),
    "fprintf in the library": ({"grids/x.cpp": '/* a\n b */ void f() { fprintf(stderr, "x"); }\n'},
                               ["grids/x.cpp:2: only programs print (tools/, bench/)"]),
    "fmt::print in the library": ({"portraits/x.cpp": 'void f() { fmt::print("x"); }\n'},
                                  ["portraits/x.cpp:1: only programs print (tools/, bench/)"]),
    "std::exit in the library": ({"engine/base/x.cpp": "void f() { std::exit(1); }\n"},
                                 ["engine/base/x.cpp:1: only programs end the process (tools/, bench/)"]),
    "exit in the library": ({"engine/base/x.cpp": "void f() { exit(1); }\n"},
                            ["engine/base/x.cpp:1: only programs end the process (tools/, bench/)"]),
    "another program": ({"tools/x.cpp": "#include <spawn.h>\n"},
                        ["tools/x.cpp:1: includes spawn.h: other programs have one door, tools/pictures/gnuplot.cpp"]),
    "another program through the shell": ({"tools/x.cpp": 'auto p = popen("gnuplot", "w");\n'},
                                          ["tools/x.cpp:1: a shell reads what a user typed: use tools/pictures/gnuplot.h"]),
    "an inner folder to the right": (
        {"portraits/x.h": '#include "portraits/query/z.h"\n', "portraits/query/z.h": ""},
        ["portraits/x.h:1: portraits may not include portraits/query (portraits/query/z.h)"]),
    "vector code": (
        {"engine/loop/x.cpp": "#include <immintrin.h>\n"},
        ["engine/loop/x.cpp:1: includes immintrin.h: vector instructions live in engine/isa/ and engine/kernel/"]),
    "a letter outside ASCII": ({"engine/base/x.h": "// caf\u00e9\n"}, ["engine/base/x.h:1: a byte outside ASCII"]),
}


def findings_of(files):
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = Path(folder) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return Tree(folder).check()


def self_test():
    cases = {"the good tree": ({}, []), **VIOLATIONS}
    wrong = 0
    for name, (files, expected) in cases.items():
        found = findings_of({**GOOD_TREE, **files})
        if found != expected:
            wrong += 1
            print(f"{name}: expected {expected}, found {found}")
    return wrong


def main(arguments):
    if arguments == ["--self-test"]:
        return 1 if self_test() else 0
    root = arguments[0] if arguments else Path(__file__).resolve().parents[2]
    tree = Tree(root)
    if not tree.files:
        print(f"{root}: no sources found")
        return 1
    findings = tree.check()
    for finding in findings:
        print(finding)
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
