/// Threads that share the tiles of a pass.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <future>
#include <memory>
#include <thread>
#include <vector>

#include "portraits/query/sheet.h"

namespace portrait {

/// How many threads a pass takes: `wanted`, or as many as the machine has.
inline std::size_t thread_count(int wanted) {
  return wanted > 0 ? static_cast<std::size_t>(wanted) : std::max(1U, std::thread::hardware_concurrency());
}

/// Calls work(begin, end) for runs that make up 0 .. count - 1, on as many threads as have `least` of them to do each. The
/// first failure is rethrown when all have ended.
template <typename Work>
void in_parts(int threads, std::size_t count, std::size_t least, Work work) {
  const std::size_t parts = std::max<std::size_t>(1, std::min(thread_count(threads), count / least));
  std::vector<std::future<void>> others;
  for (std::size_t part = 0; part + 1 < parts; ++part)
    others.push_back(std::async(std::launch::async, work, count * part / parts, count * (part + 1) / parts));
  work(count * (parts - 1) / parts, count);
  for (std::future<void>& other : others) other.get();
}

/// A number that threads lower, or read to see how far it has come. What it decides must not change an answer, only how
/// much is read for it.
class SharedLeast {
 public:
  double value() const { return least_.load(std::memory_order_relaxed); }
  void lower(double to) {
    double now = value();
    while (to < now && !least_.compare_exchange_weak(now, to, std::memory_order_relaxed)) {
    }
  }

 private:
  std::atomic<double> least_ = kInf;
};

/// Calls visit(tally, page, k) for k = 0 .. count - 1, on several threads, each with a page and a copy of `empty` of its
/// own, and merges the tallies. The answer is that of one thread as long as merging does not depend on the order.
/// The first failure of a thread is rethrown when all have ended.
template <typename Tally, typename Visit>
Tally share(const Sheet& sheet, int threads, std::uint64_t count, const Tally& empty, Visit visit) {
  std::atomic<std::uint64_t> next = 0;
  const auto work = [&](const ColumnSource& source) {
    constexpr std::uint64_t kStep = 16;  // neighbours lie together in the file
    Tally tally = empty;
    TilePage page(sheet, source);
    for (std::uint64_t k = next.fetch_add(kStep); k < count; k = next.fetch_add(kStep))
      for (std::uint64_t j = k; j < std::min(k + kStep, count); ++j) visit(tally, page, j);
    return tally;
  };
  const std::size_t wanted = std::min<std::uint64_t>(thread_count(threads), count / 64 + 1);
  std::vector<std::unique_ptr<ColumnSource>> sources;
  while (sources.size() + 1 < wanted) sources.push_back(sheet.source().for_another_thread());
  std::vector<std::future<Tally>> others;
  for (const auto& source : sources) others.push_back(std::async(std::launch::async, work, std::cref(*source)));
  Tally all = work(sheet.source());
  for (std::future<Tally>& other : others) all.merge(other.get());
  return all;
}

}  // namespace portrait
