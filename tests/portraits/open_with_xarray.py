"""A portrait opens in xarray without further arguments, with labelled axes.

usage: open_with_xarray.py SAMPLE_PORTRAIT    (the helper program that writes sample portraits)
"""

import math
import os
import subprocess
import sys
import tempfile

import numpy
import xarray


def check_small(path):
    """kappa x tau_i, delta, tau_f, b and c fixed; values as in sample.cpp."""
    with xarray.open_dataset(path) as portrait:
        assert dict(portrait.sizes) == {"kappa": 3, "tau_i": 4}, portrait.sizes
        assert list(portrait.data_vars) == ["IAE_w", "TV2_uw", "Ms", "status"], list(portrait.data_vars)
        assert portrait.IAE_w.dims == ("kappa", "tau_i")
        assert portrait.IAE_w.attrs["units"] == "1" and portrait.kappa.attrs["units"] == "1"
        assert portrait.kappa.attrs["normalisation"] == "Kc K Td^2"
        numpy.testing.assert_array_equal(portrait.kappa, [0.2, 0.24, 0.3])
        numpy.testing.assert_array_equal(portrait.tau_i, [6, 8, 10, math.inf])
        for name, value in {"delta": 0.7, "tau_f": 0.1, "b": 0.5, "c": 0.25}.items():
            assert name in portrait.coords and portrait.IAE_w.coords[name] == value, name
        check_values(portrait)
        check_status(portrait)
        assert portrait.attrs["schema_name"] == "portrait" and portrait.attrs["state"] == "complete"
        assert portrait.attrs["settings"] == 12


def check_values(portrait):
    """Setting 6 is kappa = 0.24, tau_i = 10; IAE_w has the number 1, TV2_uw 10 (sample.cpp)."""
    found = portrait.IAE_w.sel(kappa=0.24, tau_i=10)
    assert abs(found - (1 + 6 + 1 / 9)) < 1e-12, found
    found = portrait.TV2_uw.sel(kappa=0.25, method="nearest").sel(tau_i=math.inf)
    assert abs(found - (10 + 7 + 1 / 10)) < 1e-12, found
    assert numpy.isnan(portrait.Ms.sel(kappa=0.24, tau_i=8)), "setting 5 is unstable"
    assert portrait.IAE_w.dtype == numpy.float64


def check_status(portrait):
    status = portrait.status
    assert status.dtype == numpy.uint8, status.dtype
    meanings = dict(zip(status.attrs["flag_meanings"].split(), status.attrs["flag_values"]))
    assert meanings == {"not_computed": 0, "settled": 1, "not_settled": 2, "unstable": 3}, meanings
    assert status.sel(kappa=0.24, tau_i=8) == meanings["unstable"]


def check_single_setting(path):
    with xarray.open_dataset(path) as portrait:
        assert dict(portrait.sizes) == {}
        assert abs(portrait.IAE_w - (1 + 1 / 3)) < 1e-12 and portrait.IAE_w.coords["kappa"] == 0.24


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        for name, check in {"small": check_small, "none": check_single_setting}.items():
            path = os.path.join(folder, name + ".h5")
            subprocess.run([program, "write", name, path], check=True)
            check(path)
            with xarray.open_dataset(path, engine="h5netcdf") as portrait:
                assert "IAE_w" in portrait
            with xarray.open_dataset(path, group="tile_digests") as digests:
                assert digests.IAE_w.dims == ("tile",) and digests.IAE_w.dtype == numpy.uint64


if __name__ == "__main__":
    main()
