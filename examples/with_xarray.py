"""The best settled setting of a portrait with Ms <= 2, and a map of its plane, by xarray.

usage: with_xarray.py FILE.h5 [MAP.png]
"""

import sys

import numpy
import xarray

portrait = xarray.open_dataset(sys.argv[1])
settled = portrait.status == 1
objective = (portrait.IAE_w + portrait.IAE_d).where(settled & (portrait.Ms <= 2))
best = objective.isel(objective.argmin(...))  # NaN is passed over
print(f"{float(best):.6g}", *(f"{name}={float(best[name]):g}" for name in objective.dims))

if len(sys.argv) > 2:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    # The plane of the first two axes through the best setting; an axis may end in inf, which no picture has room for.
    x, y = objective.dims[:2]
    plane = objective.sel({name: best[name].item() for name in objective.dims[2:]})
    plane = plane.isel({name: numpy.isfinite(portrait[name].values) for name in (x, y)})
    plane.plot(x=x, y=y)
    plt.plot(best[x].item(), best[y].item(), "r+")
    plt.title(portrait.attrs["title"])
    plt.savefig(sys.argv[2], dpi=120)
