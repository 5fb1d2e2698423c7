/// The sweep of a whole grid: its family, horizon and measures, tile by tile.
#pragma once

#include "engine/sweep/sweep.h"
#include "grids/grid.h"
#include "grids/tiling.h"

namespace portrait {

/// What the grid's measures need.
inline Extras extras_for(const Grid& grid) {
  return extras_for(grid.measures, grid.sampling, grid.noise, grid.horizon);
}

/// Without `prepare`, which says what becomes of the tiles. REQUIRES: grid and tiling outlive the job.
inline SweepJob sweep_job(const Grid& grid, const Tiling& tiling, int threads) {
  SweepJob job;
  job.family = grid.family;
  job.horizon = grid.horizon;
  job.sampling = grid.sampling;
  job.noise = grid.noise;
  job.measures = grid.measures;
  job.tile_count = tiling.tile_count();
  job.threads = threads;
  job.settings_of = [&](std::uint64_t tile) { return settings_in(grid, tiling.box(tile)); };
  return job;
}

}  // namespace portrait
