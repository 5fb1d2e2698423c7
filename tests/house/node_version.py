#!/usr/bin/env python3
"""Every npm package that is locked must run on the Node.js of Debian 12.

    node_version.py             checks the package-lock.json files of the repository that this file lies in
    node_version.py --self-test

A machine may have a newer Node.js, where nobody would notice. Prints "file: package needs Node.js RANGE" and ends with 1, or prints
nothing and ends with 0.
"""

import json
import re
import sys
from pathlib import Path

DEBIAN_12 = (18, 20)


def admits(wanted, version):
    """Of ranges as npm packages write them: >=18, ^18.17 || >=20, 18.x, *"""
    return any(admits_all(part.split(), version) for part in re.sub(r"([<>=^~]+)\s+", r"\1", wanted).split("||"))


def admits_all(conditions, version):
    return all(admits_one(condition, version) for condition in conditions)


def admits_one(condition, version):
    parts = re.fullmatch(r"([<>=^~]*)v?(\d+|\*|x)(?:\.(\d+|x|\*))?.*", condition)
    if not parts:
        raise ValueError(f"not a range: {condition}")
    relation, major, minor = parts.groups()
    if not major.isdigit():
        return True
    bound = (int(major), int(minor) if minor and minor.isdigit() else 0)
    if relation == ">=":
        return version >= bound
    if relation == ">":
        return version > bound
    if relation == "<":
        return version < bound
    if relation == "<=":
        return version[0] <= bound[0]
    return version[0] == bound[0] and version >= bound  # ^18.17, 18, 18.x


def too_new(lock):
    return [(name, package["engines"]["node"]) for name, package in json.loads(lock)["packages"].items()
            if isinstance(package.get("engines"), dict) and "node" in package["engines"] and not admits(package["engines"]["node"], DEBIAN_12)]


def check(root):
    found = 0
    for folder in ("web", "tests/web"):
        for name, wanted in too_new((root / folder / "package-lock.json").read_text(encoding="utf-8")):
            print(f"{folder}/package-lock.json: {name} needs Node.js {wanted}, Debian 12 has {DEBIAN_12[0]}")
            found += 1
    return 1 if found else 0


def self_test():
    for wanted in (">=18", ">= 18", ">=14.17", "^18.17 || >=20", "18.x", "*", ">=12 <19", "16 || 18"):
        assert admits(wanted, DEBIAN_12), wanted
    for wanted in (">=20", "^20.9", ">=18.99", "^16 || >=20", "19", ">18.20 <19"):
        assert not admits(wanted, DEBIAN_12), wanted
    lock = {"packages": {"": {}, "old": {"engines": {"node": ">=10"}}, "new": {"engines": {"node": ">=20"}}, "list": {"engines": ["node"]}}}
    assert too_new(json.dumps(lock)) == [("new", ">=20")]
    return 0


sys.exit(self_test() if "--self-test" in sys.argv else check(Path(__file__).resolve().parents[2]))
