#!/usr/bin/env python3
"""Every path that the prose names must exist.

    paths_in_prose.py           checks the *.md files of the repository that this file lies in
    paths_in_prose.py ROOT      checks another tree
    paths_in_prose.py --self-test

A path is what stands in backticks, contains a slash and starts with one of the top folders. `grids/catalog/*.toml`
must match something, `portraits/h5.{h,cpp}` means both, `grids/grid.h:12` and `docs/x.md#part` mean the file. Fenced
blocks are left alone. Prints "file:line: `path` does not exist" and ends with 1, or prints nothing and ends with 0.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

TOP_FOLDERS = {"bench", "cmake", "docs", "engine", "grids", "portraits", "scripts", "tests", "tools", "web"}

FENCE = re.compile(r"^\s*(```|~~~)")
IN_BACKTICKS = re.compile(r"(`+)(.+?)\1")
BRACES = re.compile(r"^(.*?)\{([^{}]*)\}(.*)$")


def prose_files(root):
    """The tracked *.md files; all of them in a tree without git."""
    if not (root / ".git").exists():
        return sorted(root.rglob("*.md"))
    listed = subprocess.run(["git", "-C", str(root), "ls-files", "-z", "--", "*.md"], capture_output=True, text=True,
                            check=True)
    return sorted(root / name for name in listed.stdout.split("\0") if name)


def expanded(path):
    """a.{h,cpp} is a.h and a.cpp."""
    braces = BRACES.match(path)
    if not braces:
        return [path]
    head, choices, tail = braces.groups()
    return [one for choice in choices.split(",") for one in expanded(head + choice + tail)]


def paths_in(text):
    """The repository paths among the words of one pair of backticks."""
    for word in text.split():
        path = re.sub(r"(#.*|:\d+(:\d+)?)$", "", word.strip("\"'(),;")).rstrip(".:")
        if "<" in path or "..." in path or "$" in path or "/" not in path:
            continue
        if path.split("/")[0] in TOP_FOLDERS:
            yield from expanded(path)


def exists(root, path):
    if any(letter in path for letter in "*?["):
        return any(True for _ in root.glob(path.rstrip("/")))
    return (root / path).exists()


def findings_in(root, prose):
    fenced = False
    for number, line in enumerate(prose.read_text(encoding="utf-8").split("\n"), 1):
        if FENCE.match(line):
            fenced = not fenced
            continue
        if fenced:
            continue
        for _, text in IN_BACKTICKS.findall(line):
            for path in paths_in(text):
                if not exists(root, path):
                    yield f"{prose.relative_to(root).as_posix()}:{number}: `{path}` does not exist"


def check(root):
    return [finding for prose in prose_files(root) if prose.exists() for finding in findings_in(root, prose)]


FILES = {"engine/loop/loop.h": "", "portraits/h5.h": "", "portraits/h5.cpp": "", "grids/catalog/a.toml": ""}

# A line of prose, and the paths in it that must be reported.
CASES = [
    ("`engine/loop/loop.h` and `engine/loop/` and `engine/loop`", []),
    ("`engine/loop/gone.h`", ["engine/loop/gone.h"]),
    ("both `engine/loop/loop.h` and `engine/lop/loop.h`.", ["engine/lop/loop.h"]),
    ("``engine/gone.h``", ["engine/gone.h"]),
    ("`grids/catalog/*.toml`", []),
    ("`grids/catalog/*.h5`", ["grids/catalog/*.h5"]),
    ("`portraits/h5.{h,cpp}`", []),
    ("`portraits/h5.{h,cc}`", ["portraits/h5.cc"]),
    ("`engine/loop/loop.h:12`, `engine/loop/loop.h:12:3` and `engine/loop/loop.h#part`", []),
    ("`scripts/demo --fast grids/catalog/a.toml`", ["scripts/demo"]),
    ("`tests/<same path>`, `engine/loop/...`, `build/dev/tools/portrait`, `engine`, `and/or`, `1/s`", []),
    ("engine/gone.h without backticks", []),
    ("```\n`engine/gone.h`\n```", []),
    ("```\n```\n`engine/gone.h`", ["engine/gone.h"]),
]


def reported(text):
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for name, content in {**FILES, "docs/prose.md": text}.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(content, encoding="utf-8")
        return check(root)


def self_test():
    wrong = 0
    for text, paths in CASES:
        last = text.count("\n") + 1
        expected = [f"docs/prose.md:{last}: `{path}` does not exist" for path in paths]
        found = reported(text)
        if found != expected:
            wrong += 1
            print(f"{text!r}: expected {expected}, found {found}")
    return wrong


def main(arguments):
    if arguments == ["--self-test"]:
        return 1 if self_test() else 0
    root = Path(arguments[0]) if arguments else Path(__file__).resolve().parents[2]
    findings = check(root)
    for finding in findings:
        print(finding)
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
