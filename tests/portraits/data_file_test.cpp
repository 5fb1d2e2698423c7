#include "portraits/data_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <random>

#include "engine/base/error.h"
#include "portraits/digest.h"
#include "portraits/disk.h"
#include "tests/portraits/scratch.h"

namespace portrait {
namespace {

Piece piece_of(const std::string& text) {
  Piece piece{page_memory(text.size()), text.size(), digest_of(text)};
  std::memcpy(piece.memory.get(), text.data(), text.size());
  return piece;
}

std::string random_text(std::size_t size, std::mt19937& random) {
  std::string text(size, ' ');
  std::generate(text.begin(), text.end(), [&] { return static_cast<char>(random()); });
  return text;
}

/// Sizes around a page, and one that fills many: more pieces than may wait at a time.
constexpr std::size_t kSizes[] = {1, 4095, 4096, 4097, 9000, 1, 2'000'000, 5, 12288, 300'000, 7};

class DataFileTest : public ScratchTest {
 protected:
  void TearDown() override {
    disk::set_hook(nullptr);
    ScratchTest::TearDown();
  }

  /// Appends pieces of these sizes; afterwards every one must lie where the file said, with zeros up to the next.
  void append_all(DataFile& file) {
    for (const std::size_t size : kSizes) {
      texts_.push_back(random_text(size, random_));
      at_.push_back(file.end());
      file.append(piece_of(texts_.back()));
    }
  }
  void expect_all() const {
    const std::string bytes = bytes_of(in("data"));
    for (std::size_t i = 0; i < texts_.size(); ++i) {
      EXPECT_EQ(at_[i] % kPageBytes, 0u);
      const std::size_t end = at_[i] + texts_[i].size();
      ASSERT_LE(whole_pages(end), bytes.size());
      EXPECT_TRUE(bytes.compare(at_[i], texts_[i].size(), texts_[i]) == 0) << i;
      EXPECT_TRUE(std::all_of(bytes.begin() + static_cast<std::ptrdiff_t>(end),
                              bytes.begin() + static_cast<std::ptrdiff_t>(whole_pages(end)), [](char c) { return c == 0; }))
          << i;
    }
  }

  std::mt19937 random_{1};
  std::vector<std::string> texts_;
  std::vector<std::uint64_t> at_;
};

TEST_F(DataFileTest, PiecesLieOnPagesInTheirOrder) {
  const auto file = DataFile::create(in("data"));
  EXPECT_EQ(file->end(), DataFile::kHeadBytes);
  append_all(*file);
  const std::uint64_t end = file->commit();
  EXPECT_EQ(end, std::filesystem::file_size(in("data")));
  expect_all();
}

TEST_F(DataFileTest, GoesOnWhereACommitEnded) {
  std::uint64_t end = 0;
  {
    const auto file = DataFile::create(in("data"));
    append_all(*file);
    end = file->commit();
    file->append(piece_of("not committed, not wanted"));
  }
  const auto file = DataFile::reopen(in("data"), end);
  EXPECT_EQ(file->end(), end);
  append_all(*file);
  file->commit();
  expect_all();
}

TEST_F(DataFileTest, WhatTheDiskDoesNotGiveBackIsTold) {
  const auto file = DataFile::create(in("data"));
  Piece piece = piece_of("these bytes");
  piece.digest = digest_of("other bytes");  // as if the disk had lost them
  file->append(std::move(piece));
  EXPECT_EQ(message_of<StoreError>([&] { file->commit(); }),
            in("data").string() + ": the disk does not give back what was written to it");
}

int calls_to_write = 0;
int fails_once(const char* call) { return std::strcmp(call, "write") == 0 && calls_to_write++ == 0 ? EINTR : 0; }
int is_full(const char* call) { return std::strcmp(call, "write") == 0 ? ENOSPC : 0; }

TEST_F(DataFileTest, ACallThatWritesNotAllIsMadeUpFor) {
  const auto file = DataFile::create(in("data"));
  calls_to_write = 0;
  disk::set_hook(fails_once);
  append_all(*file);
  file->commit();
  EXPECT_GT(calls_to_write, 1);
  expect_all();
}

TEST_F(DataFileTest, AFullDiskIsToldAtTheNextCall) {
  const auto file = DataFile::create(in("data"));
  disk::set_hook(is_full);
  const std::string told = message_of<StoreError>([&] {
    append_all(*file);  // more than may wait: this call or the next hears of it
    file->commit();
  });
  EXPECT_EQ(told, in("data").string() + ": cannot write to it: No space left on device");
  EXPECT_EQ(message_of<StoreError>([&] { file->append(piece_of("more")); }), told);
}

TEST(PageMemory, BeginsWithAPageAndIsUsedAgain) {
  PageMemory memory = page_memory(5000);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory.get()) % kPageBytes, 0u);
  EXPECT_GE(memory.get_deleter().bytes, 8192u);
  const std::byte* before = memory.get();
  memory.reset();
  EXPECT_EQ(page_memory(4097).get(), before) << "what was given back last";
  EXPECT_EQ(page_memory(5000).get_deleter().bytes, 8192u);
}

}  // namespace
}  // namespace portrait
