#include "engine/sweep/sweep.h"

#include <algorithm>
#include <chrono>
#include <exception>

#include <omp.h>

#include "engine/base/check.h"

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

bool keeps(const std::vector<Measure>& measures, Measure measure) {
  return std::find(measures.begin(), measures.end(), measure) != measures.end();
}

class Worker {
 public:
  Worker(const SweepJob& job, TileQueue& queue, FirstFailure& failure, std::mutex& progress,
         std::atomic<std::uint64_t>& left_over, const Extras& extras)
      : job_(job), queue_(queue), failure_(failure), progress_(progress), left_over_(left_over), extras_(extras) {}

  /// An exception must not leave a parallel region.
  void run() {
    try {
      std::optional<std::uint64_t> own;
      while (!failure_.happened()) {
        if (job_.stop && job_.stop->load()) queue_.begin_no_more();
        const auto slice = queue_.next(own);
        if (!slice) return;
        own = slice->tile->number;
        measure(*slice);
        queue_.finish(*slice);
        report();
      }
    } catch (...) {
      failure_.keep(std::current_exception());
      queue_.close();
    }
  }

 private:
  void measure(const Slice& slice) {
    const auto settings = std::span(slice.tile->settings).subspan(slice.first, slice.count);
    measured_.resize(slice.count);
    measure_settings(job_.method, job_.family, job_.horizon, extras_, settings, measured_);
    slice.tile->columns.set_all(slice.first, std::span<const SettingMeasured>(measured_));
    for (const SettingMeasured& m : measured_)
      if (method_of(m) != job_.method) ++left_over_;
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
  std::atomic<std::uint64_t>& left_over_;
  const Extras& extras_;
  std::vector<SettingMeasured> measured_;  ///< of the slice in hand
};

}  // namespace

int usual_threads() { return omp_get_max_threads(); }

SweepOutcome sweep(const SweepJob& job) {
  PORTRAIT_CHECK(!why_not_measured(job.method, job.measures));
  PORTRAIT_CHECK(job.sampling || !keeps(job.measures, Measure::noise_gain));
  PORTRAIT_CHECK(job.noise || std::none_of(job.measures.begin(), job.measures.end(), is_noisy));
  const auto begin = std::chrono::steady_clock::now();
  const int threads = job.threads > 0 ? job.threads : usual_threads();
  TileQueue queue(job.measures, job.tile_count, job.settings_of, job.prepare);
  FirstFailure failure;
  std::mutex progress;
  std::atomic<std::uint64_t> left_over = 0;
  const Extras extras = extras_for(job.measures, job.sampling, job.noise, job.horizon);
#pragma omp parallel num_threads(threads)
  Worker(job, queue, failure, progress, left_over, extras).run();
  failure.rethrow();

  SweepOutcome outcome;
  outcome.settings_measured = queue.settings_measured();
  outcome.settings_by_reference = job.method == Method::reference ? outcome.settings_measured : left_over.load();
  outcome.tiles_stored = queue.tiles_stored();
  outcome.complete = outcome.tiles_stored == job.tile_count;
  outcome.threads = threads;
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return outcome;
}

}  // namespace portrait
