"""portrait completion and man, in the shells and the formatter that they are for."""

import os
import pty
import shutil
import subprocess
import unittest

import program
from program import ProgramTest


class Shell(ProgramTest):
    def completed(self, *words):
        """What bash offers for the last word."""
        script = self.run_program("completion", "bash").out
        line = script + f"\nCOMP_WORDS=({' '.join(words)} '')\nCOMP_WORDS[{len(words) - 1}]=\"{words[-1]}\"\nCOMP_CWORD={len(words) - 1}\n"
        line += '_portrait\nprintf "%s\\n" "${COMPREPLY[@]}"\n'
        done = subprocess.run(["bash", "--norc", "-c", line], capture_output=True, text=True, cwd=self.folder)
        self.assertEqual(done.stderr, "")
        return done.stdout.split()

    def test_bash_completes_verbs_kinds_options_and_files(self):
        self.assertEqual(self.completed("portrait", "quer"), ["query"])
        self.assertEqual(self.completed("portrait", "plot", "ny"), ["nyquist"])
        self.assertEqual(self.completed("portrait", "query", "--min"), ["--minimize"])
        self.assertEqual(self.completed("portrait", "plot", "map", "--stab"), ["--stability"])
        self.write("p.h5", "")
        self.assertEqual(self.completed("portrait", "info", "p."), ["p.h5"])

    @unittest.skipUnless(shutil.which("zsh"), "zsh is not there")
    def test_zsh_takes_its_script(self):
        script = self.run_program("completion", "zsh").out
        done = subprocess.run(["zsh", "-f", "-c", "autoload -U compinit; compinit -u -D\n" + script + "\nprint ${_comps[portrait]}"],
                              capture_output=True, text=True, cwd=self.folder)
        self.assertEqual((done.stderr, done.stdout.strip()), ("", "_portrait"))
        self.assertIn("'--minimize:", script)

    def test_man_page_has_the_text_of_help(self):
        page = self.run_program("man", "query").out
        self.assertTrue(page.startswith(".TH portrait\\-query 1"))
        plain = page.replace("\\-", "-").replace("\\e", "\\").replace("\\&", "")
        help_text = self.run_program("query", "--help").out
        for line in help_text.splitlines()[:6]:
            self.assertIn(line, plain)
        self.assertIn("--minimize", plain)
        self.assertIn(".B plot\n", self.run_program("man").out)

    def on_a_terminal(self, **environment):
        """What `portrait nonsense` says there."""
        ours, theirs = pty.openpty()
        env = {k: v for k, v in os.environ.items() if k != "NO_COLOR"} | {"TERM": "xterm"} | environment
        subprocess.run([program.PROGRAM, "nonsense"], stderr=theirs, env=env)
        os.close(theirs)
        text = b""
        try:
            while part := os.read(ours, 4096):
                text += part
        except OSError:
            pass  # all was read
        os.close(ours)
        return text

    def test_colours_only_on_a_terminal_that_wants_them(self):
        self.assertTrue(self.on_a_terminal().startswith(b"\x1b[1mportrait:\x1b[0m unknown verb"))
        for environment in ({"NO_COLOR": "1"}, {"TERM": "dumb"}):
            self.assertTrue(self.on_a_terminal(**environment).startswith(b"portrait: unknown verb"), environment)
        self.assertTrue(self.on_a_terminal(NO_COLOR="").startswith(b"\x1b[1m"))
        self.assertTrue(self.run_program("nonsense").err.startswith("portrait: unknown verb"))

    @unittest.skipUnless(shutil.which("cmake"), "cmake is not there")
    def test_a_page_that_cannot_be_built_says_why(self):
        for npm, why in (("NPM-NOTFOUND", "npm was not found when it was built (Debian: apt-get install npm)"),
                         (shutil.which("false"), "npm could not fetch its packages when it was built")):
            built = self.folder / "built"
            built.mkdir(exist_ok=True)
            done = subprocess.run(["cmake", f"-DNPM={npm}", f"-DSOURCE={program.SOURCES / 'web'}", f"-DBUILT={built}",
                                   f"-DASSETS={built / 'assets.cpp'}", "-P", program.SOURCES / "cmake" / "build_page.cmake"],
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            source = (built / "assets.cpp").read_text()
            self.assertIn(f'why_no_assets() {{ return R"why({why}', source)
            self.assertIn("static const std::vector<Asset> none;", source)

    def test_unknown_shell(self):
        self.assertEqual(self.run_program("completion", "fish").code, 2)


if __name__ == "__main__":
    program.main()
