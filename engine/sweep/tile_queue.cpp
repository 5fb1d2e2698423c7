#include "engine/sweep/tile_queue.h"

#include <algorithm>

namespace portrait {

bool TileQueue::may_begin() const {
  return !ending_ && begun_ < tile_count_ && begun_ - stored_ < kTilesInMemory;
}

/// Settings and columns take as long as many slices: others go on meanwhile.
std::uint64_t TileQueue::begin_tile(std::unique_lock<std::mutex>& lock) {
  const std::uint64_t number = begun_++;
  ++coming_;  // for good where an exception leaves this function: the worker that catches it closes the queue
  lock.unlock();
  std::vector<Setting> settings = settings_of_(number);
  const std::size_t count = settings.size();
  auto tile =
      std::make_shared<Tile>(Tile{number, std::move(settings), MeasureColumns(measures_, count), count, {}});
  lock.lock();
  --coming_;
  open_.emplace(number, OpenTile{std::move(tile), 0});
  changed_.notify_all();
  return number;
}

/// Of a tile without settings a slice that is empty.
Slice TileQueue::cut(OpenTiles::iterator from) {
  OpenTile& open = from->second;
  const std::size_t settings = open.tile->settings.size();
  const Slice slice{open.tile, open.cut, std::min(kSliceSettings, settings - open.cut)};
  open.cut += slice.count;
  if (open.cut == settings) open_.erase(from);
  return slice;
}

std::optional<Slice> TileQueue::next(std::optional<std::uint64_t> own) {
  std::unique_lock lock(mutex_);
  const auto none_comes = [&] { return coming_ == 0 && (ending_ || begun_ == tile_count_); };
  for (;;) {
    changed_.wait(lock, [&] { return closed_ || !open_.empty() || may_begin() || none_comes(); });
    if (closed_) return std::nullopt;
    if (const auto found = own ? open_.find(*own) : open_.end(); found != open_.end()) return cut(found);
    if (may_begin()) {
      own = begin_tile(lock);
      continue;
    }
    if (open_.empty()) return std::nullopt;
    return cut(open_.begin());
  }
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
    changed_.notify_all();
  }
  storing_ = false;
}

void TileQueue::begin_no_more() {
  const std::scoped_lock lock(mutex_);
  ending_ = true;
  changed_.notify_all();
}

void TileQueue::close() {
  const std::scoped_lock lock(mutex_);
  closed_ = true;
  changed_.notify_all();
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
