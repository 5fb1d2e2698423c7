#include "engine/sweep/tile_queue.h"

#include <algorithm>

namespace portrait {

void TileQueue::begin_tile() {
  std::vector<Setting> settings = settings_of_(begun_);
  const std::size_t count = settings.size();
  current_ = std::make_shared<Tile>(Tile{begun_, std::move(settings), MeasureColumns(measures_, count), count, {}});
  ++begun_;
  cut_ = 0;
}

std::optional<Slice> TileQueue::next() {
  std::unique_lock lock(mutex_);
  // Others may begin the tile this one waits for, and cut it up: then the question is the same again.
  const auto is_cut_up = [&] { return !current_ || cut_ == current_->settings.size(); };
  const auto is_last = [&] { return ending_ || begun_ == tile_count_; };
  stored_one_.wait(lock,
                   [&] { return closed_ || !is_cut_up() || is_last() || begun_ - stored_ < kTilesInMemory; });
  if (closed_ || (is_cut_up() && is_last())) return std::nullopt;
  if (is_cut_up()) begin_tile();
  const std::size_t count = std::min(kSliceSettings, current_->settings.size() - cut_);
  const Slice slice{current_, cut_, count};
  cut_ += count;
  return slice;
}

void TileQueue::finish(const Slice& slice) {
  std::unique_lock lock(mutex_);
  measured_ += slice.count;
  slice.tile->unfinished -= slice.count;
  if (slice.tile->unfinished > 0) return;
  lock.unlock();  // all of the tile's other slices are back: nobody else looks at it
  slice.tile->store = prepare_(slice.tile->number, slice.tile->columns);
  lock.lock();
  waiting_.emplace(slice.tile->number, slice.tile);
  if (!storing_) store_in_order(lock);
}

void TileQueue::store_in_order(std::unique_lock<std::mutex>& lock) {
  storing_ = true;
  for (auto tile = waiting_.find(stored_); tile != waiting_.end(); tile = waiting_.find(stored_)) {
    const std::shared_ptr<Tile> ready = tile->second;
    waiting_.erase(tile);
    lock.unlock();  // others go on measuring while this thread stores
    ready->store();
    ready->store = nullptr;
    lock.lock();
    ++stored_;
    stored_one_.notify_all();
  }
  storing_ = false;
}

void TileQueue::begin_no_more() {
  const std::scoped_lock lock(mutex_);
  ending_ = true;
  stored_one_.notify_all();
}

void TileQueue::close() {
  const std::scoped_lock lock(mutex_);
  closed_ = true;
  stored_one_.notify_all();
}

std::uint64_t TileQueue::settings_measured() const {
  const std::scoped_lock lock(mutex_);
  return measured_;
}

std::uint64_t TileQueue::tiles_stored() const {
  const std::scoped_lock lock(mutex_);
  return stored_;
}

}  // namespace portrait
