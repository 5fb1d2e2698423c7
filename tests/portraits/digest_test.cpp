// The digits are those of xxHash's own program, so that anyone can check a portrait without us.
#include "portraits/digest.h"

#include <algorithm>
#include <span>

#include <gtest/gtest.h>

namespace portrait {
namespace {

TEST(Digest, PublishedValues) {
  // printf '' | xxhsum -H3 ; printf 'portrait' | xxhsum -H3
  EXPECT_EQ(digest_text(digest_of(std::string())), "2d06800538d394c2");
  EXPECT_EQ(digest_text(digest_of(std::string("portrait"))), "c28702743bbcfc74");
}

TEST(Digest, PiecesDoNotMatter) {
  const std::string text(5000, 'x');
  Digest digest;
  for (std::size_t at = 0; at < text.size(); at += 7)
    digest.add(std::as_bytes(std::span(text)).subspan(at, std::min<std::size_t>(7, text.size() - at)));
  EXPECT_EQ(digest.value(), digest_of(text));
}

}  // namespace
}  // namespace portrait
