"""Chunks that Portrait encodes without HDF5 are read by HDF5: plain and deflated ones, at the edges too, in both precisions.

usage: chunks_by_h5py.py SAMPLE_PORTRAIT    (the helper program that writes sample portraits)
"""

import os
import subprocess
import sys
import tempfile

import h5py
import numpy
import xarray

TILE = 4000  # as 19996 settings are cut
DEFLATED, PLAIN = 0b000, 0b011


def value(measure, setting):
    """As in sample.cpp."""
    setting = setting.astype(float)
    values = measure + 1 + setting + 1 / (setting + 3)
    return numpy.where(setting % 7 == 5, numpy.nan, values)


def repeating(measure, count):
    setting = numpy.arange(count)
    tile, place = setting // TILE, setting % TILE
    values = value(measure, 7 * setting)
    values[(tile % 4 == 2) & (place < 2400)] = 0.5
    values[tile % 4 == 1] = measure
    values[tile % 4 == 0] = numpy.nan
    return values


def forms(dataset):
    """The filter mask of every chunk, in the order of the tiles."""
    found = [dataset.id.get_chunk_info(i) for i in range(dataset.id.get_num_chunks())]
    return [info.filter_mask for info in sorted(found, key=lambda info: info.chunk_offset)]


def check(path, shape, dtype, expected_forms):
    with h5py.File(path, "r") as file:
        measures = file.attrs["measures"].decode().split()
        for name in measures:
            assert file[name].dtype == dtype and file[name].shape == shape, file[name]
            assert forms(file[name]) == expected_forms, (name, forms(file[name]))
        number = {"IAE_w": 0, "TV2_uw": 9}
        for name, measure in number.items():
            expected = repeating(measure, int(numpy.prod(shape))).astype(dtype).reshape(shape)
            numpy.testing.assert_array_equal(file[name][...], expected)
        with xarray.open_dataset(path) as portrait:
            numpy.testing.assert_array_equal(portrait["IAE_w"], file["IAE_w"][...])


def check_filters_can_tell(path):
    """HDF5's own check is in force: a flipped bit of a plain chunk is refused."""
    with h5py.File(path, "r") as file:
        place = file["IAE_w"].id.get_chunk_info(3).byte_offset
    with open(path, "r+b") as file:
        file.seek(place + 8)
        byte = file.read(1)[0]
        file.seek(place + 8)
        file.write(bytes([byte ^ 1]))
    with h5py.File(path, "r") as file:
        try:
            file["IAE_w"][...]
        except OSError as error:
            assert "Fletcher32" in str(error), error
        else:
            raise AssertionError("a damaged chunk was read")


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "p.h5")
        for verb, dtype in {"repeat": "f8", "single": "f4"}.items():
            # Tiles of all NaN, constant, half constant, neither; then again, the last one cut short at the edge.
            subprocess.run([program, verb, "19996", path], check=True)
            check(path, (19996,), numpy.dtype(dtype), [DEFLATED, DEFLATED, DEFLATED, PLAIN, DEFLATED])
            check_filters_can_tell(path)
            os.remove(path)


if __name__ == "__main__":
    main()
