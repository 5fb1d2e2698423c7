"""The query of query_rate in numpy, on the same file: prints seconds, how many are admissible, the best objective."""

import sys
import time

import h5py
import numpy


def ask(path):
    with h5py.File(path, "r") as file:
        keep = file["status"][()] == 1
        for name, bound in (("TV2_uw", 0.02), ("TV0_yw", 0.01), ("Ms", 1.287), ("u_max_w", 0.2)):
            keep &= file[name][()] <= bound
        objective = file["IAE_w"][()] + file["IAE_d"][()]
    return int(keep.sum()), float(numpy.where(keep, objective, numpy.inf).min())


def main():
    path = sys.argv[1]
    times = []
    for _ in range(3):
        begin = time.perf_counter()
        admissible, best = ask(path)
        times.append(time.perf_counter() - begin)
    print(sorted(times)[1], admissible, repr(best))


if __name__ == "__main__":
    main()
