"""portrait completion and man, in the shells and the formatter that they are for."""

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

    def test_unknown_shell(self):
        self.assertEqual(self.run_program("completion", "fish").code, 2)


if __name__ == "__main__":
    program.main()
