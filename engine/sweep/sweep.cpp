#include "engine/sweep/sweep.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <stdexcept>

#include <fmt/format.h>
#include <omp.h>

#include "engine/base/check.h"
#include "engine/loop/parameters.h"
#include "engine/reference/measure.h"
#include "engine/sweep/tile_queue.h"

namespace portrait {
namespace {

/// The first exception of any worker.
class FirstFailure {
 public:
  void keep(std::exception_ptr failure) {
    const std::scoped_lock lock(mutex_);
    if (!failure_) failure_ = std::move(failure);
    happened_ = true;
  }
  bool happened() const { return happened_; }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr failure_;
  std::atomic<bool> happened_ = false;
};

bool keeps(const MeasureColumns& columns, Measure measure) {
  return std::find(columns.kept.begin(), columns.kept.end(), measure) != columns.kept.end();
}

void measure_one(const Loop& loop, Horizon horizon, std::optional<double> sampling, std::size_t entry,
                 MeasureColumns& columns) try {
  const reference::Measured measured = reference::measure(loop, horizon, {}, sampling);
  columns.set(entry, measured.status, measured.measures);
} catch (const std::exception& failure) {
  throw std::runtime_error(fmt::format("{}\nreproduce: {}", failure.what(), simulate_command(loop)));
}

class Worker {
 public:
  Worker(const SweepJob& job, TileQueue& queue, FirstFailure& failure, std::mutex& progress)
      : job_(job), queue_(queue), failure_(failure), progress_(progress) {}

  /// An exception must not leave a parallel region.
  void run() {
    try {
      while (!is_stopped()) {
        const auto slice = queue_.next();
        if (!slice) return;
        measure(*slice);
        queue_.finish(*slice);
        report();
      }
    } catch (...) {
      failure_.keep(std::current_exception());
    }
  }

 private:
  bool is_stopped() const { return failure_.happened() || (job_.stop && job_.stop->load()); }

  void measure(const Slice& slice) const {
    const std::span settings(slice.tile->settings);
    measure_settings(job_.family, job_.horizon, job_.sampling, settings.subspan(slice.first, slice.count),
                     slice.first, slice.tile->columns);
  }

  void report() const {
    if (!job_.progress) return;
    const std::unique_lock lock(progress_, std::try_to_lock);
    if (lock) job_.progress(queue_.settings_measured());
  }

  const SweepJob& job_;
  TileQueue& queue_;
  FirstFailure& failure_;
  std::mutex& progress_;
};

}  // namespace

int usual_threads() { return omp_get_max_threads(); }

std::string_view sweep_method() { return "reference"; }

void measure_settings(const LoopFamily& family, Horizon horizon, std::optional<double> sampling,
                      std::span<const Setting> settings, std::size_t first, MeasureColumns& columns) {
  PORTRAIT_CHECK(sampling || !keeps(columns, Measure::noise_gain));
  if (!keeps(columns, Measure::noise_gain)) sampling.reset();
  for (std::size_t i = 0; i < settings.size(); ++i)
    measure_one({family, settings[i]}, horizon, sampling, first + i, columns);
}

SweepOutcome sweep(const SweepJob& job) {
  const auto begin = std::chrono::steady_clock::now();
  const int threads = job.threads > 0 ? job.threads : usual_threads();
  TileQueue queue(job.measures, job.tile_count, job.settings_of, job.store);
  FirstFailure failure;
  std::mutex progress;
#pragma omp parallel num_threads(threads)
  Worker(job, queue, failure, progress).run();
  failure.rethrow();

  SweepOutcome outcome;
  outcome.settings_measured = queue.settings_measured();
  outcome.tiles_stored = queue.tiles_stored();
  outcome.complete = outcome.tiles_stored == job.tile_count;
  outcome.threads = threads;
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return outcome;
}

}  // namespace portrait
