"""docs/gallery.md and its pictures are what scripts/gallery draws with this program."""

import pathlib
import re
import subprocess
import xml.etree.ElementTree as xml

import program
from program import ProgramTest

MOST_BYTES = 250_000


class Gallery(ProgramTest):
    def setUp(self):
        super().setUp()
        self.docs = program.SOURCES / "docs"
        self.drawn = self.folder / "docs"
        done = subprocess.run([program.SOURCES / "scripts" / "gallery", program.PROGRAM, self.drawn], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_the_page_and_its_pictures_are_up_to_date(self):
        self.assertEqual((self.docs / "gallery.md").read_text(), (self.drawn / "gallery.md").read_text(),
                         "run scripts/gallery and look at what it draws")
        kept = sorted(p.name for p in (self.docs / "gallery").iterdir())
        self.assertEqual(kept, sorted(p.name for p in (self.drawn / "gallery").iterdir()))
        for name in kept:
            self.assertEqual(self.content(self.docs / "gallery" / name), self.content(self.drawn / "gallery" / name), name)

    @staticmethod
    def content(path):
        """All texts, and how many lines, areas and points: another gnuplot may round otherwise, and the version differs."""
        root = xml.parse(path).getroot()
        tags = [element.tag.split("}")[1] for element in root.iter()]
        texts = ["".join(t.itertext()).strip() for t in root.iter("{http://www.w3.org/2000/svg}text")]
        return texts, {tag: tags.count(tag) for tag in ("polygon", "path", "use", "text")}

    def test_pictures_are_small_and_each_is_shown_once(self):
        page = (self.docs / "gallery.md").read_text()
        shown = re.findall(r"\(gallery/([^)]*\.svg)\)", page)
        self.assertEqual(len(set(shown)), len(shown))
        self.assertEqual(sorted(shown), sorted(p.name for p in (self.docs / "gallery").iterdir()))
        for name in shown:
            self.assertLess((self.docs / "gallery" / name).stat().st_size, MOST_BYTES, name)
        for kind in ("map", "responses", "nyquist", "bars", "front", "characteristic", "stability"):
            self.assertIn(f"portrait plot {kind} ", page)


if __name__ == "__main__":
    program.main()
