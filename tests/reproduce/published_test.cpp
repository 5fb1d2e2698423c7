#include "reproduce/published.h"

#include <set>

#include <gtest/gtest.h>

#include "engine/base/error.h"
#include "reproduce/reproduction.h"

namespace portrait::reproduce {
namespace {

std::string table(const std::string& rest) {
  return "[[table]]\nkey = \"a/b\"\ntitle = \"t\"\npage = \"1\"\ncolumns = [\"x\", \"y\"]\n" + rest;
}

std::string error_of(const std::string& rest) {
  try {
    read_published(table(rest), "d.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Published, DigitsAreKept) {
  const auto t = read_published(table("rows = [\"m = 1 | 0.1050 -\"]"), "d.toml");
  EXPECT_EQ(t[0].rows[0].label, "m = 1");
  EXPECT_EQ(*t[0].rows[0].cells[0], "0.1050");
  EXPECT_FALSE(t[0].rows[0].cells[1].has_value());
  EXPECT_DOUBLE_EQ(printed("0.1050").half_unit, 0.5e-4);
  EXPECT_DOUBLE_EQ(printed("4.38e-7").half_unit, 0.5e-9);
  EXPECT_DOUBLE_EQ(printed("1529.2").half_unit, 0.05);
  EXPECT_DOUBLE_EQ(printed("120").half_unit, 0.5);
}

TEST(Published, MistakesInADataFileHaveAPlace) {
  EXPECT_EQ(error_of("rows = [\"m = 1 | 1 2 3\"]"), "d.toml:6:9: 3 numbers for 2 columns");
  EXPECT_EQ(error_of("rows = [\"m = 1 | 1 x\"]"), "d.toml:6:9: \"x\" is not a number");
  EXPECT_EQ(error_of("rows = [\"1 2\"]"), "d.toml:6:9: a row is \"label | number number ...\"");
  EXPECT_EQ(error_of("rows = [\"m = 1 | 1 2\"]\n[[table.note]]\ncolumns = [\"z\"]\nwhy = \"w\""),
            "d.toml:1:1: a/b: a note names the column \"z\"");
}

/// Every table has code, and every piece of code a table.
TEST(Published, TablesAndMakersMatch) {
  std::multiset<std::string> tables, makers;
  for (const PublishedTable& t : published_tables()) tables.insert(t.key);
  for (auto* family : {huba2022_makers, dalen2018_makers, huba2021_makers, ho_pid_makers, kos2021_makers})
    for (const Maker& m : family()) makers.insert(std::string(m.key));
  EXPECT_EQ(tables, makers);
  EXPECT_GE(tables.size(), 90u);
}

TEST(Published, TablesAreFoundByPaperAndByName) {
  EXPECT_EQ(tables_named("huba2022/table3").size(), 1u);
  EXPECT_GT(tables_named("kos2021").size(), 40u);
  EXPECT_THROW(tables_named("huba2022/tabel3"), InputError);
}

}  // namespace
}  // namespace portrait::reproduce
