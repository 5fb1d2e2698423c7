"""The headers' comments give an API documentation without a warning; a header with a mistake does not.

usage: doxygen_test.py SOURCES      (exit code 77: doxygen is not there)
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile


def documented(sources):
    """Exit code and what doxygen says; what it makes goes to a folder that does not stay."""
    with tempfile.TemporaryDirectory() as folder:
        settings = (sources / "docs/Doxyfile").read_text() + f"OUTPUT_DIRECTORY = {folder}\n"
        done = subprocess.run(["doxygen", "-"], cwd=sources, input=settings, capture_output=True, text=True, check=False)
        pages = len(list(pathlib.Path(folder).rglob("*.html")))
        return done.returncode, pages, done.stdout + done.stderr


def main():
    sources = pathlib.Path(sys.argv[1]).resolve()
    if shutil.which("doxygen") is None:
        print("skipped: doxygen is not there")
        return 77
    code, pages, said = documented(sources)
    if code != 0 or pages < 100:
        print(f"{said}exit code {code}, {pages} pages")
        return 1
    with tempfile.TemporaryDirectory() as folder:
        wrong = pathlib.Path(folder)
        for name in ("docs", "engine", "grids", "portraits"):
            (wrong / name).mkdir()
        shutil.copy(sources / "docs/Doxyfile", wrong / "docs/Doxyfile")
        (wrong / "engine/a.h").write_text("/// Gives \\ref nothing_of_this_name.\nint f();\n")
        if documented(wrong)[0] == 0:
            print("a reference to nothing was let pass")
            return 1
    print(f"{pages} pages")
    return 0


if __name__ == "__main__":
    sys.exit(main())
