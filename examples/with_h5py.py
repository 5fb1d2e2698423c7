"""The best settled setting of a portrait with Ms <= 2, by h5py and numpy.

usage: with_h5py.py FILE.h5
"""

import sys

import h5py
import numpy

with h5py.File(sys.argv[1]) as portrait:
    axes = portrait.attrs["grid_axes"].decode() if isinstance(portrait.attrs["grid_axes"], bytes) else portrait.attrs["grid_axes"]
    objective = portrait["IAE_w"][()] + portrait["IAE_d"][()]
    admissible = (portrait["status"][()] == 1) & (portrait["Ms"][()] <= 2)
    objective[~admissible] = numpy.nan
    place = numpy.unravel_index(numpy.nanargmin(objective), objective.shape)
    print(f"{objective[place]:.6g}", *(f"{name}={portrait[name][i]:g}" for name, i in zip(axes.split(), place)))
