// A run that is killed at any write, sync, rename or removal, or whose disk fails at any of them, loses no batch, and
// resumed gives the portrait of a run that nothing happened to.
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include <sys/wait.h>
#include <unistd.h>

#include "engine/base/error.h"
#include "portraits/disk.h"
#include "portraits/run_writer.h"
#include "portraits/verify.h"
#include "tests/portraits/sample.h"
#include "tests/portraits/scratch.h"

namespace portrait {
namespace {

std::atomic<int> g_calls = 0;
std::atomic<int> g_at = 0;
std::atomic<int> g_error = 0;

int kill_at(const char*) {
  if (++g_calls == g_at) kill(getpid(), SIGKILL);
  return 0;
}
int fail_once(const char*) { return ++g_calls == g_at ? g_error.load() : 0; }
int fail_from(const char*) { return ++g_calls >= g_at ? g_error.load() : 0; }

class RunKill : public ScratchTest {
 protected:
  /// In memory where that is possible: a sync of every one of some thousand small files takes its time elsewhere.
  std::filesystem::path parent() const override {
    return std::filesystem::is_directory("/dev/shm") ? "/dev/shm" : ScratchTest::parent();
  }
  void TearDown() override {
    disk::set_hook(nullptr);
    ScratchTest::TearDown();
  }

  /// 48 tiles, each a batch.
  const Grid grid_ = sample::grid_of({48, 2100});
  const Provenance provenance_{"portrait sweep sample.toml", "sample", "2025-01-31T09:30:00Z"};
  const BatchLimits limits_{.bytes = 1, .seconds = 1e9};

  RunWriter writer(RunStart start = RunStart::resume) const {
    return RunWriter(in("p.h5"), grid_, provenance_, {}, start, limits_);
  }

  void run() const {
    RunWriter run = writer();
    for (const std::uint64_t tile : run.tiles_to_do()) run.write(run.encode(tile, sample::columns(grid_, tile)));
    run.finish({.wall_seconds = 1.5, .threads = 2}, Existing::refuse);
  }

  std::string digests() const {
    std::string all;
    for (const CheckedDataset& dataset : verify(in("p.h5"), 1).datasets) all += dataset.name + dataset.digest;
    return all;
  }

  std::uint64_t tiles_in_batches() const {
    const RunFolder folder = RunFolder::of_target(in("p.h5"));
    if (!folder.exists()) return 0;
    std::uint64_t count = 0;
    for (const ShardState& shard : folder.shards(fingerprint(manifest_of(grid_, provenance_)))) count += shard.tiles();
    return count;
  }

  /// What a user does after any of it: the same command once more.
  void resume_and_compare(const std::string& whole, int at) {
    if (!std::filesystem::exists(in("p.h5"))) {
      const std::uint64_t stored = tiles_in_batches();
      {
        RunWriter run = writer();
        EXPECT_TRUE(run.set_aside().empty()) << "cut " << at << ": " << run.set_aside().front();
        EXPECT_EQ(run.tiles_done(), stored) << "cut " << at;
        reused_ += run.tiles_done();
      }
      run();
    }
    EXPECT_EQ(digests(), whole) << "cut " << at;
    std::filesystem::remove_all(in("p.h5.run"));
    std::filesystem::remove(in("p.h5"));
  }

  std::string digests_of_a_whole_run() {
    run();
    const std::string whole = digests();
    EXPECT_EQ(files_in_folder(), 1u) << "nothing but the portrait is left";
    std::filesystem::remove(in("p.h5"));
    return whole;
  }

  std::uint64_t reused_ = 0;
};

/// Whether the child was killed; else it came to its end.
template <typename Work>
bool is_killed(Work work) {
  const pid_t child = fork();
  if (child == 0) {
    work();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0);
  return WIFSIGNALED(status);
}

TEST_F(RunKill, at_every_call_that_changes_the_disk) {
  const std::string whole = digests_of_a_whole_run();
  int cuts = 0;
  for (int at = 1;; ++at) {
    const bool killed = is_killed([&] {
      g_calls = 0;
      g_at = at;
      disk::set_hook(kill_at);
      run();
    });
    if (!killed) break;
    ++cuts;
    resume_and_compare(whole, at);
  }
  EXPECT_GE(cuts, 300);
  EXPECT_GT(reused_, 0u);
  std::printf("%d cut points, %llu tiles reused\n", cuts, static_cast<unsigned long long>(reused_));
}

TEST_F(RunKill, the_disk_fails_once_or_from_then_on) {
  const std::string whole = digests_of_a_whole_run();
  int failures = 0;
  for (const auto& [hook, error] : {std::pair<disk::Hook, int>{fail_from, ENOSPC}, {fail_once, EIO}})
    for (int at = 1, survived = 0; survived < 2; at += 7) {
      g_calls = 0;
      g_at = at;
      g_error = error;
      disk::set_hook(hook);
      try {
        run();
        ++survived;
      } catch (const StoreError& failure) {
        ++failures;
        EXPECT_NE(std::string(failure.what()).find(std::strerror(error)), std::string::npos) << failure.what();
      }
      disk::set_hook(nullptr);
      resume_and_compare(whole, at);
    }
  EXPECT_GT(failures, 80);
}

}  // namespace
}  // namespace portrait
