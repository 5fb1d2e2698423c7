"""The command line: help, unknown words, exit code 2."""

import program
from program import ProgramTest


class Usage(ProgramTest):
    def test_no_verb_shows_the_help_on_stderr(self):
        result = self.run_program()
        self.assertEqual((result.code, result.out), (2, ""))
        for verb in ("sweep", "info", "verify", "query", "simulate", "characteristic"):
            self.assertIn(f"\n  {verb} ", result.err)

    def test_every_verb_has_help_that_leads_with_an_example(self):
        for verb in ("sweep", "info", "verify", "query", "simulate"):
            result = self.run_program(verb, "--help")
            self.assertEqual(result.code, 0)
            self.assertTrue(result.out.startswith(f"Example:\n  portrait {verb} "), result.out[:60])

    def test_version_names_the_commit(self):
        result = self.run_program("--version")
        self.assertEqual(result.code, 0)
        self.assertRegex(result.out, r"^portrait \d+\.\d+\.\d+ \([0-9a-f]{12}(-modified)?\)\n$|^portrait .* \(unknown\)\n$")

    def test_unknown_verb(self):
        self.assert_fails(self.run_program("qurey"), 2, 'unknown verb "qurey" (did you mean "query"?)')

    def test_unknown_option(self):
        self.assert_fails(self.run_program("simulate", "--plant", "dipdt", "--kapa", "1"), 2,
                          'unknown option "--kapa" (did you mean "--kappa"?)')

    def test_missing_option(self):
        self.assert_fails(self.run_program("simulate", "--plant", "dipdt"), 2, "--kappa is required")


if __name__ == "__main__":
    program.main()
