"""portrait report: one file, complete, with what query says."""

import base64
import html
import re
import xml.etree.ElementTree as xml

import program
from program import ProgramTest


class Report(ProgramTest):
    QUESTION = ("--minimize", "IAE_w + IAE_d", "--where", "Ms <= 4", "--plant", "K=2,Td=0.5")

    def setUp(self):
        super().setUp()
        self.small_portrait()

    def test_holds_answer_pictures_commands_and_origin_and_needs_nothing_else(self):
        result = self.run_program("report", "small.h5", *self.QUESTION, "-o", "r.html")
        self.assertEqual((result.code, result.out), (0, ""), result.err)
        page = (self.folder / "r.html").read_text()
        best = self.run_program("query", "small.h5", *self.QUESTION, "--json").json
        text = html.unescape(page)
        self.assertIn(f"IAE_w + IAE_d = {best['optimum']['objective']:.6g}", text)
        self.assertIn(f"{best['admissible']} of {best['total']} settings are admissible", text)
        images = re.findall(r'src="data:image/svg\+xml;base64,([^"]*)"', page)
        self.assertEqual(len(images), 4)
        for image in images:
            self.assertTrue(xml.fromstring(base64.b64decode(image)).tag.endswith("svg"))
        self.assertNotRegex(re.sub(r"data:[^\"]*", "", page), r"(src|href)=\"[^\"]|https?://|<script")
        self.assertIn("portrait query small.h5 --minimize 'IAE_w + IAE_d' --where 'Ms <= 4' --plant K=2,Td=0.5", text)
        self.assertIn("history   ", text)

    def test_what_was_typed_cannot_become_markup(self):
        result = self.run_program("report", "small.h5", *self.QUESTION, "--title", "<script>x</script>", "-o", "r.html")
        self.assertEqual(result.code, 0, result.err)
        self.assertNotIn("<script>x", (self.folder / "r.html").read_text())

    def test_nothing_admissible_gives_no_report(self):
        result = self.run_program("report", "small.h5", "--minimize", "IAE_d", "--where", "Ms <= 1", "-o", "r.html")
        self.assertEqual(result.code, 3)
        self.assertFalse((self.folder / "r.html").exists())


if __name__ == "__main__":
    program.main()
