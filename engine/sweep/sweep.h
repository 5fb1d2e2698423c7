/// The parallel sweep: tiles of settings in, tiles of measures out. The only place that knows of threads.
///
/// Knows nothing of grids or files: the caller says how many tiles there are, which settings a tile holds,
/// and what to do with its measures.
/// result    the same bits for any number of threads
/// cost      memory: some tiles (TileQueue), however slow storing is
/// errors    the first failure in a worker stops the sweep and is rethrown, with the command that reproduces
///           the setting
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "engine/loop/horizon.h"
#include "engine/loop/loop.h"
#include "engine/measures/columns.h"
#include "engine/sweep/method.h"
#include "engine/sweep/tile_queue.h"

namespace portrait {

struct SweepJob {
  LoopFamily family;
  Horizon horizon;
  std::optional<double> sampling;  ///< dead times over which noise is held, for noise_gain
  std::optional<NoiseTrials> noise =
      std::nullopt;  ///< for the noisy measures; then the horizon is fixed and every controller proper
  Method method = Method::kernel;
  std::vector<Measure> measures;  ///< kept ones, in catalogue order
  std::uint64_t tile_count = 0;
  /// The settings of a tile. Called once a tile, by many threads at once.
  std::function<std::vector<Setting>(std::uint64_t tile)> settings_of;
  /// Prepares a measured tile for storing, and gives back the step that stores it. Called by the worker that
  /// measured the last of the tile, many at once: here belongs what takes long. The steps are called by one thread
  /// at a time, in order of tiles; the columns live until then.
  std::function<StoreStep(std::uint64_t tile, const MeasureColumns& columns)> prepare;
  /// Called often, by one thread at a time; may be empty.
  std::function<void(std::uint64_t settings_measured)> progress;
  const std::atomic<bool>* stop = nullptr;  ///< when it becomes true, no tile is begun any more
  int threads = 0;                          ///< 0: usual_threads()
};

struct SweepOutcome {
  std::uint64_t settings_measured = 0;
  std::uint64_t settings_by_reference = 0;  ///< that the kernel's finest panels did not resolve
  std::uint64_t tiles_stored = 0;
  bool complete = false;  ///< every tile was stored
  int threads = 0;
  double seconds = 0;
};

/// REQUIRES: every setting is valid for the family; sampling is given when noise_gain is kept.
SweepOutcome sweep(const SweepJob& job);

/// As many threads as OpenMP offers on this machine; OMP_NUM_THREADS sets it.
int usual_threads();

}  // namespace portrait
