"""What README.md shows of the program is what the program says: every line of its sessions, in their order."""

import re
import shlex

import program
from program import ProgramTest


def sessions():
    """(command, lines) of every `$ portrait ...` in a fenced block."""
    found = []
    for block in re.findall(r"^```\n(.*?)^```", (program.SOURCES / "README.md").read_text(), re.MULTILINE | re.DOTALL):
        for part in re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]:
            command, _, shown = part.partition("\n")
            found.append((shlex.split(command, comments=True), [line for line in shown.split("\n") if line.strip()]))
    return [(command, shown) for command, shown in found if command[0] == "portrait"]


class Readme(ProgramTest):
    def test_sessions(self):
        grid = program.SOURCES / "grids" / "catalog" / "huba2022-43.toml"
        (self.folder / "demo").mkdir()
        self.assertEqual(self.run_program("sweep", grid, "-o", "demo/huba2022-43.h5", "--quiet").code, 0)
        self.assertGreaterEqual(len(sessions()), 4)
        for command, shown in sessions():
            said = self.run_program(*command[1:])
            self.assertEqual(said.code, 0, command)
            self.assertGreater(len(shown), 1)
            lines = iter(said.out.split("\n"))
            for line in shown:
                self.assertTrue(any(other.rstrip() == line.rstrip() for other in lines), f"not said, or not in this order: {line}")


if __name__ == "__main__":
    program.main()
