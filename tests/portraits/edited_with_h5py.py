"""A portrait edited with another program is found out, by name; what the format allows is read.

HDF5 itself finds nothing wrong with these files: every change is made through it.

usage: edited_with_h5py.py SAMPLE_PORTRAIT    (the helper program that writes sample portraits)
"""

import ctypes
import os
import shutil
import subprocess
import sys
import tempfile

import h5py
import numpy


def change_one_value(file):
    file["Ms"][2, 1] += 1e-9


def change_two_columns(file):
    file["status"][0, 0] = 2
    file["TV2_uw"][1, 0] = 0


def change_an_axis(file):
    file["tau_i"][0] = 5.5


def change_a_fixed_parameter(file):
    file["b"][()] = 0.6


def change_the_grid_file(file):
    text = bytearray(file.attrs["grid_toml"])
    text[0] ^= 1
    file.attrs.modify("grid_toml", numpy.bytes_(bytes(text)))


def exchange_columns(file):
    file.move("IAE_w", "other")
    file.move("Ms", "IAE_w")
    file.move("other", "Ms")


def drop_a_column(file):
    del file["TV2_uw"]


def drop_tile_digests(file):
    del file["tile_digests/Ms"]


def drop_tile_numbers(file):
    """The last thing that verify looks at."""
    del file["tile_digests/tile"]


def digest_of(values):
    xxhash = ctypes.CDLL("libxxhash.so.0")
    xxhash.XXH3_64bits.restype = ctypes.c_uint64
    return f"{xxhash.XXH3_64bits(values, ctypes.c_size_t(len(values))):016x}"


def drop_summaries(file):
    del file["tile_summaries/Ms"]


def drop_all_summaries(file):  # a file of format 1.1
    del file["tile_summaries"]


def change_a_summary(file):
    file["tile_summaries/Ms"][0, 1] -= 1e-9


def change_a_summary_and_its_digest(file):
    summaries = file["tile_summaries/status"]
    summaries[0, 1] += 1
    summaries.attrs.modify("xxh3_64", numpy.bytes_(digest_of(summaries[()].tobytes())))


def drop_an_attribute(file):
    del file.attrs["plant"]


def number_for_text(file):
    file.attrs["plant"] = 3


def text_for_number(file):
    file.attrs["n"] = "one"


def row_for_number(file):
    file.attrs["settings"] = [12, 12]


def other_count(file):
    file.attrs.modify("settings", 13)


def unknown_plant(file):
    file.attrs["plant"] = "thirdorder"


def unknown_measure(file):
    file.attrs["measures"] = "IAE_w TV2_uw Ms novel"


def repeated_measure(file):
    file.attrs["measures"] = "IAE_w Ms Ms"


def nan_on_an_axis(file):
    replace(file, "kappa", numpy.array([0.2, numpy.nan, 0.3]), digest="14474b3843cf43ef")


def shorter_axis(file):
    replace(file, "kappa", numpy.array([0.2, 0.24]))


def falling_axis(file):
    replace(file, "kappa", numpy.array([0.3, 0.24, 0.2]), digest="38a8aa80f2504cd0")


def integers_for_reals(file):
    replace(file, "Ms", numpy.zeros((3, 4), dtype="i4"))


def other_shape(file):
    replace(file, "Ms", numpy.zeros((4, 3)))


def enormous_axis(file):
    """Claims 8 TB without holding any."""
    digest = file["kappa"].attrs["xxh3_64"]
    del file["kappa"]
    file.create_dataset("kappa", shape=(10**12,), dtype="f8", chunks=None).attrs["xxh3_64"] = digest


def replace(file, name, values, digest=None):
    attributes = dict(file[name].attrs)
    del file[name]
    file[name] = values
    file[name].attrs["xxh3_64"] = digest or attributes["xxh3_64"]


def newer_major(file):
    file.attrs["schema_version"] = "3.0.0"


def newer_minor(file):
    file.attrs["schema_version"] = "2.7.0"
    file.attrs["something_new"] = 1.0
    file["new_column"] = numpy.zeros(3)


DIFFERS = "holds other values than were written (its digest differs)"
TILE_DIFFERS = "holds other values than were written (the digest of tile 0 differs)"

CASES = [
    (change_one_value, 4, ["Ms " + TILE_DIFFERS]),
    (change_two_columns, 4, ["TV2_uw " + TILE_DIFFERS, "status " + TILE_DIFFERS]),
    (change_an_axis, 4, ["tau_i " + DIFFERS]),
    (change_a_fixed_parameter, 4, ["b " + DIFFERS]),
    (change_the_grid_file, 4, ["attribute grid_toml is not what was written (its digest differs)"]),
    (exchange_columns, 4, ["IAE_w " + TILE_DIFFERS, "Ms " + TILE_DIFFERS]),
    (drop_a_column, 4, ["TV2_uw is missing"]),
    (drop_tile_digests, 4, ["tile_digests/Ms is missing"]),
    (drop_tile_numbers, 4, ["tile_digests/tile is missing"]),
    (drop_summaries, 4, ["tile_summaries/Ms is missing"]),
    (drop_all_summaries, 0, []),
    (change_a_summary, 4, ["tile_summaries/Ms " + DIFFERS]),
    (change_a_summary_and_its_digest, 4, ["tile_summaries/status does not fit the values of tile 0"]),
    (drop_an_attribute, 4, ["attribute plant is missing"]),
    (number_for_text, 4, ["attribute plant is not a text"]),
    (text_for_number, 4, ["attribute n is not a whole number"]),
    (row_for_number, 4, ["attribute settings is not a single value"]),
    (other_count, 4, ["attribute settings is not 12, the product of the axes"]),
    (unknown_plant, 4, ['attribute plant says "thirdorder"']),
    (unknown_measure, 2, ["this portrait has a measure novel, which this program does not know"]),
    (repeated_measure, 4, ["attribute measures does not name each measure once, in their order"]),
    (nan_on_an_axis, 4, ["the values of axis kappa do not increase"]),
    (shorter_axis, 4, ["kappa " + DIFFERS]),
    (falling_axis, 4, ["the values of axis kappa do not increase"]),
    (integers_for_reals, 4, ["Ms has values of an unknown type"]),
    (other_shape, 4, ["Ms has another type or shape than the grid asks for"]),
    (enormous_axis, 4, ["kappa is larger than the file"]),
    (newer_major, 2, ["this portrait has format 3.0.0; this program reads format 2.x: use a newer program"]),
    (newer_minor, 0, []),
]


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        whole, path = os.path.join(folder, "whole.h5"), os.path.join(folder, "edited.h5")
        subprocess.run([program, "write", "small", whole], check=True)
        for edit, code, sentences in CASES:
            shutil.copy(whole, path)
            with h5py.File(path, "r+") as file:
                edit(file)
            run = subprocess.run([program, "verify", path], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            expected = "".join(f"{path}: {sentence}\n" for sentence in sentences)
            assert (run.returncode, run.stderr) == (code, expected), (edit.__name__, run)


if __name__ == "__main__":
    main()
