#include "portraits/query/column_cache.h"

#include <algorithm>

namespace portrait {
namespace {

template <typename T>
void copy(const std::vector<T>& all, std::uint64_t first, std::size_t count, std::vector<T>& values) {
  const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
  values.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
}

class ThroughCache final : public ColumnSource {
 public:
  explicit ThroughCache(const ColumnCache& cache) : cache_(cache) {}
  const Grid& grid() const override { return cache_.grid(); }
  void read(Measure measure, std::uint64_t first, std::size_t count, std::vector<double>& values) const override {
    cache_.read(measure, first, count, values);
  }
  void read_statuses(std::uint64_t first, std::size_t count, std::vector<Status>& statuses) const override {
    cache_.read_statuses(first, count, statuses);
  }
  std::vector<TileRange> tile_ranges(Measure measure) const override { return cache_.tile_ranges(measure); }
  std::vector<StatusCounts> tile_status_counts() const override { return cache_.tile_status_counts(); }
  std::unique_ptr<ColumnSource> for_another_thread() const override {
    return std::make_unique<ThroughCache>(cache_);
  }

 private:
  const ColumnCache& cache_;
};

}  // namespace

ColumnCache::ColumnCache(const ColumnSource& source, std::size_t limit)
    : source_(source), limit_(limit), settings_(setting_count(source.grid())) {}

std::size_t ColumnCache::held() const {
  const std::lock_guard lock(mutex_);
  return columns_.size() * settings_ * sizeof(double) + (statuses_ ? settings_ * sizeof(Status) : 0);
}

bool ColumnCache::fit(std::size_t columns) const {
  return settings_ * (columns * sizeof(double) + sizeof(Status)) <= limit_;
}

void ColumnCache::make_room() const {
  while (!recent_.empty() && !fit(columns_.size() + 1)) {
    columns_.erase(recent_.back());
    recent_.pop_back();
  }
}

ColumnCache::Column ColumnCache::column(Measure measure) const {
  const std::lock_guard lock(mutex_);
  if (const auto found = columns_.find(measure); found != columns_.end()) {
    recent_.remove(measure);
    recent_.push_front(measure);
    return found->second;
  }
  make_room();
  auto values = std::make_shared<std::vector<double>>();
  source_.read(measure, 0, settings_, *values);
  recent_.push_front(measure);
  return columns_[measure] = std::move(values);
}

ColumnCache::Statuses ColumnCache::statuses() const {
  const std::lock_guard lock(mutex_);
  if (!statuses_) {
    auto values = std::make_shared<std::vector<Status>>();
    source_.read_statuses(0, settings_, *values);
    statuses_ = std::move(values);
  }
  return statuses_;
}

void ColumnCache::read(Measure measure, std::uint64_t first, std::size_t count, std::vector<double>& values) const {
  if (fit(1)) return copy(*column(measure), first, count, values);
  const std::lock_guard lock(mutex_);
  source_.read(measure, first, count, values);
}

void ColumnCache::read_statuses(std::uint64_t first, std::size_t count, std::vector<Status>& values) const {
  if (fit(1)) return copy(*statuses(), first, count, values);
  const std::lock_guard lock(mutex_);
  source_.read_statuses(first, count, values);
}

std::vector<TileRange> ColumnCache::tile_ranges(Measure measure) const {
  const std::lock_guard lock(mutex_);
  const auto known = ranges_.find(measure);
  return known != ranges_.end() ? known->second : ranges_[measure] = source_.tile_ranges(measure);
}

std::vector<StatusCounts> ColumnCache::tile_status_counts() const {
  const std::lock_guard lock(mutex_);
  if (!counts_) counts_ = source_.tile_status_counts();
  return *counts_;
}

std::unique_ptr<ColumnSource> ColumnCache::for_another_thread() const {
  return std::make_unique<ThroughCache>(*this);
}

}  // namespace portrait
