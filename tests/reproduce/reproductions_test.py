"""docs/reproductions.md is what `portrait reproduce --markdown` writes, to the digits shown, and leaves nothing unexplained."""

import json
import pathlib
import re
import subprocess
import sys
import unittest

PROGRAM, SOURCES = sys.argv[1], pathlib.Path(sys.argv[2])
NUMBER = re.compile(r"-?\d+\.?\d*(?:e[-+]?\d+)?")


def run(*arguments):
    return subprocess.run([PROGRAM, "reproduce", *arguments], text=True, capture_output=True, check=True).stdout


def same(a, b):
    """Texts that differ at most by a unit in the last digit of a number: another machine's library may round otherwise."""
    if NUMBER.sub("#", a) != NUMBER.sub("#", b):
        return False
    for x, y in zip(NUMBER.findall(a), NUMBER.findall(b)):
        mantissa = x.split("e")[0]
        digits = len(mantissa.split(".")[1]) if "." in mantissa else 0
        unit = 10.0 ** (int(x.split("e")[1]) - digits if "e" in x else -digits)
        if abs(float(x) - float(y)) > 1.5 * unit:
            return False
    return True


class Reproductions(unittest.TestCase):
    def test_the_page_is_current(self):
        ours = run("--markdown").splitlines()
        page = (SOURCES / "docs" / "reproductions.md").read_text().splitlines()
        self.assertEqual(len(ours), len(page), "run: portrait reproduce --markdown > docs/reproductions.md")
        for number, (a, b) in enumerate(zip(ours, page), 1):
            self.assertTrue(same(a, b), f"docs/reproductions.md:{number}:\n{b}\nis now\n{a}")

    def test_everything_that_does_not_agree_has_its_reason(self):
        self.assertNotIn("NO REASON GIVEN", (SOURCES / "docs" / "reproductions.md").read_text())

    def test_json_says_the_same(self):
        table = json.loads(run("huba2022/table3", "--json"))[0]
        self.assertEqual((table["agree"], table["corrected"], table["differ"]), (24, 0, 4))
        worst = max(table["numbers"], key=lambda number: abs(number["difference"]))
        self.assertEqual((worst["row"], worst["column"], worst["published"]), ("m = 3", "tau_i", "13.063"))
        self.assertAlmostEqual(worst["ours"], 12.17973268, places=7)

    def test_comparison_sees_a_changed_number(self):
        self.assertFalse(same("| 0.125 / 0.12549 |", "| 0.125 / 0.12552 |"))
        self.assertTrue(same("| 0.125 / 0.12549 |", "| 0.125 / 0.12550 |"))
        self.assertFalse(same("agrees 1", "differs 1"))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v"])
