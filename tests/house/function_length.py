#!/usr/bin/env python3
"""No function of the sources has more than 60 lines, unless a comment above it says why: `// Long: REASON`.

    function_length.py              checks the repository that this file lies in
    function_length.py ROOT         checks another tree
    function_length.py --self-test

A function's lines run from the one with its opening brace to the one with its closing brace; a lambda belongs to the function
around it. Prints "file:line: what is wrong" for every finding and ends with 1, or prints nothing and ends with 0.
"""

import re
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
from include_order import without_comments_and_texts  # noqa: E402

LIMIT = 60
TOP_FOLDERS = ["engine", "grids", "portraits", "reproduce", "tools", "bench", "tests"]
SUFFIXES = {".h", ".cpp", ".inl"}
REASON = re.compile(r"//+ *Long: \S.{9,}")
NO_FUNCTION = re.compile(r"^\s*(namespace|struct|class|enum|union|extern)\b|=\s*$|\b(if|for|while|switch|catch|do|else)\b[^;{}]*$")


def opens_function(head):
    """Whether the text since the last ; { or } is a function's signature."""
    return ")" in head and not NO_FUNCTION.search(head)


def functions(source):
    """(first line, last line) of every function that lies in no other."""
    text = "\n".join(without_comments_and_texts(source))
    text = re.sub(r"^\s*#.*?(?<!\\)$", lambda m: re.sub(r"[^\n]", " ", m.group()), text, flags=re.MULTILINE | re.DOTALL)
    found, stack, head_from, line = [], [], 0, 1
    for i, c in enumerate(text):
        if c == "\n":
            line += 1
        elif c == "{":
            inside = any(is_function for is_function, _ in stack)
            stack.append((not inside and opens_function(text[head_from:i]), line))
        elif c == "}" and stack:
            is_function, first = stack.pop()
            if is_function:
                found.append((first, line))
        if c in ";{}":
            head_from = i + 1
    return found


def has_reason(lines, first):
    """Whether the comment that ends above line `first` (from 1), or above its signature, gives one."""
    for number in range(first - 1, max(0, first - 15), -1):
        text = lines[number - 1].strip()
        if REASON.search(text):
            return True
        if text.endswith((";", "}")) or text == "":
            return False
    return False


def check(root):
    findings, files = [], 0
    for path in sorted(p for top in TOP_FOLDERS for p in (Path(root) / top).rglob("*") if p.suffix in SUFFIXES and p.is_file()):
        files += 1
        source = path.read_text(encoding="latin-1")
        lines = source.split("\n")
        for first, last in functions(source):
            if last - first + 1 > LIMIT and not has_reason(lines, first):
                findings.append(f"{path.relative_to(root).as_posix()}:{first}: a function of {last - first + 1} lines, more than {LIMIT}, "
                                "and no `// Long: REASON` above it")
    return findings, files


def body(lines):
    return "".join(f"  work({i});\n" for i in range(lines - 2))


def self_test():
    cases = {
        "short": (f"void f() {{\n{body(60)}}}\n", []),
        "long": (f"int g;\nvoid f(int a) {{\n{body(61)}}}\n", [2]),
        "long with a reason": (f"// Long: a table of cases, one a line\nvoid f() {{\n{body(80)}}}\n", []),
        "long with a reason too short to be one": (f"// Long: yes\nvoid f() {{\n{body(80)}}}\n", [2]),
        "the reason of another": (f"// Long: a table of cases, one a line\nvoid e() {{\n}}\nvoid f() {{\n{body(80)}}}\n", [4]),
        "a method": (f"struct S {{\n  int m() const {{\n{body(70)}  }}\n}};\n", [2]),
        "a long class is none": ("struct S {\n" + "  int m();\n" * 80 + "};\n", []),
        "a long namespace is none": ("namespace a::b {\n" + "int m();\n" * 80 + "}\n", []),
        "a long table is none": ("const int t[] = {\n" + "  1,\n" * 80 + "};\n", []),
        "a lambda belongs to its function": (f"void f() {{\n  const auto g = [&](int a) {{\n{body(50)}  }};\n{body(14)}}}\n", [1]),
        "with initialisers": (f"S::S(int a)\n    : a_(a) {{\n{body(70)}}}\n", [2]),
        "braces in texts and comments": ('void f() {\n  s = "{{{"; // {{{\n}\n' + "int a;\n" * 80, []),
    }
    wrong = 0
    for name, (source, expected) in cases.items():
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "engine").mkdir()
            (Path(folder) / "engine/x.cpp").write_text(source)
            found = [int(finding.split(":")[1]) for finding in check(folder)[0]]
        if found != expected:
            wrong += 1
            print(f"{name}: expected lines {expected}, found {found}")
    return wrong


def main(arguments):
    if arguments == ["--self-test"]:
        return 1 if self_test() else 0
    findings, files = check(arguments[0] if arguments else Path(__file__).resolve().parents[2])
    if files == 0:
        findings.append("no sources found")
    print("\n".join(findings), end="\n" if findings else "")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
