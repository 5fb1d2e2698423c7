#include "engine/records/record.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/base/error.h"

namespace portrait::records {
namespace {

std::string error_of(const std::string& text) {
  try {
    quality(read_record(text, "r.csv"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string rows(int count, const char* u = "1") {
  std::string text;
  for (int i = 0; i < count; ++i) text += std::to_string(i) + "," + (i < 5 ? "0" : u) + ",0\n";
  return text;
}

TEST(Record, ColumnsByNameOrByOrder) {
  const Record named = read_record("# a comment\ny;t;note;u\n" + std::string("1;0;x;2\n3;1;x;4\n5;2;x;6\n") +
                                       "7;3;x;8\n7;4;x;8\n7;5;x;8\n7;6;x;8\n7;7;x;8\n7;8;x;8\n7;9;x;8\n",
                                   "r.csv");
  EXPECT_EQ(named.t[1], 1);
  EXPECT_EQ(named.u[1], 4);
  EXPECT_EQ(named.y[1], 3);
  const Record plain =
      read_record("0 1 2\n1\t1\t3\n2, 1, 4\n3,1,4\n4,1,4\n5,1,4\n6,1,4\n7,1,4\n8,1,4\n9,1,4\n", "r.csv");
  EXPECT_EQ(plain.y[1], 3);
}

TEST(Record, WrongFilesGetClearAnswers) {
  EXPECT_EQ(error_of("a,b,c\n" + rows(20)),
            "r.csv:1: no column \"t\": the header must name t, u and y (it has a, b, c)");
  EXPECT_EQ(error_of("0,0\n1,0\n"), "r.csv:1: 2 columns, expected 3 (t, u, y)");
  EXPECT_EQ(error_of("t,u,y\n0,0,0\n1,,0\n"), "r.csv:3: u is missing");
  EXPECT_EQ(error_of("t,u,y\n0,0,0\n1,0,nan\n"), "r.csv:3: y = \"nan\" is not a number");
  EXPECT_EQ(error_of("0,0,0\n2,0,0\n1,0,0\n"), "r.csv:3: t = 1 does not come after 2");
  EXPECT_EQ(error_of("0,0,0\n1,0,0\n"), "r.csv: 2 samples are too few for a response");
  EXPECT_EQ(error_of(rows(20, "0")), "u never changes: a record needs a step, or any other change of u");
  EXPECT_EQ(error_of("\"\n"), "r.csv:1: no column \"t\": the header must name t, u and y (it has )");
  EXPECT_EQ(error_of("0,0,0\n\" \"\n"), "r.csv:2: 0 columns, expected 3 (t, u, y)");
  EXPECT_EQ(error_of(""), "r.csv: 0 samples are too few for a response");
}

TEST(Record, MissingSamplesAreToldOf) {
  std::string text;
  for (int i = 0; i < 30; ++i)
    if (i < 12 || i > 16) text += std::to_string(i) + "," + (i < 5 ? "0" : "1") + ",0\n";
  const Quality q = quality(read_record(text, "r.csv"));
  ASSERT_EQ(q.remarks.size(), 1u);
  EXPECT_EQ(q.remarks[0],
            "about 5 samples are missing after t = 11: y is taken as a straight line, u as held there");
  EXPECT_EQ(q.start, 5);
}

TEST(Record, NoiseAndDriftBeforeTheChange) {
  std::string text;
  unsigned state = 1;
  for (int i = 0; i < 400; ++i) {
    state = state * 1664525u + 1013904223u;
    const double noise = (state / 4294967296.0 * 2 - 1) * 0.01;  // uniform within 0.01
    text += std::to_string(i) + "," + (i < 200 ? "0" : "1") + "," + std::to_string(3 + 0.5 * i + noise) + "\n";
  }
  const Quality q = quality(read_record(text, "r.csv"));
  EXPECT_NEAR(q.drift, 0.5, 1e-4);
  EXPECT_NEAR(q.noise, 0.01 / std::sqrt(3.0), 0.001);
}

}  // namespace
}  // namespace portrait::records
