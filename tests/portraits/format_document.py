"""portraits/FORMAT.md shows what a portrait is: its example is ncdump's real output, and it names everything in a file.

usage: format_document.py SAMPLE_PORTRAIT FORMAT.md
"""

import os
import re
import subprocess
import sys
import tempfile

import h5py

# Written by HDF5's dimension scales, and known from its documentation.
DIMENSION_SCALES = {"CLASS", "NAME", "REFERENCE_LIST", "DIMENSION_LIST", "DIMENSION_LABELS"}


def without_versions(text):
    """Lines that name a version of a program say nothing of the format."""
    return re.sub(r'(:(?:program|compiler|hdf5_version) = )".*"', r'\1"..."', text)


def header_of(path):
    run = subprocess.run(["ncdump", "-h", path], stdout=subprocess.PIPE, text=True, check=True)
    return run.stdout


def check_example(document, path):
    examples = re.findall(r"```\n(netcdf sample \{.*?\n\})\n```", document, re.DOTALL)
    assert len(examples) == 1, "the document shows one header"
    header = header_of(path).strip()
    assert without_versions(examples[0]) == without_versions(header), f"ncdump -h says:\n{header}"


def check_dimensions(path):
    header = header_of(path)
    for line in ["kappa = 3 ;", "tau_i = 4 ;", "double IAE_w(kappa, tau_i) ;", "ubyte status(kappa, tau_i) ;"]:
        assert line in header, line
    assert "phony_dim" not in header, "every dimension has a name"


def check_names(document, path):
    described = set(re.findall(r"`([^`\n]+)`", document))
    with h5py.File(path, "r") as file:
        names = set(file.attrs) | set(file)
        for dataset in [*file.values(), *file["tile_digests"].values(), *file["tile_summaries"].values()]:
            names |= set(dataset.attrs)
    missing = names - DIMENSION_SCALES - described
    assert not missing, f"not described: {sorted(missing)}"


def check_texts(path):
    with h5py.File(path, "r") as file:
        for item in [file, *file.values(), *file["tile_digests"].values(), *file["tile_summaries"].values()]:
            for name in set(item.attrs) - DIMENSION_SCALES:
                kind = h5py.check_string_dtype(item.attrs.get_id(name).dtype)
                assert kind is None or (kind.encoding == "utf-8" and kind.length), (item.name, name, kind)


def main():
    program, document_path = sys.argv[1:]
    with open(document_path, encoding="ascii") as file:
        document = file.read()
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "sample.h5")
        subprocess.run([program, "write", "small", path], check=True, env={**os.environ, "SOURCE_DATE_EPOCH": "1700000000"})
        check_dimensions(path)
        check_example(document, path)
        check_names(document, path)
        check_texts(path)


if __name__ == "__main__":
    main()
