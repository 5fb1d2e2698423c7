#include "grids/toml.h"

#include <gtest/gtest.h>

namespace portrait {
namespace {

std::string complaint_about(const std::string& text) {
  try {
    parse_toml(text, "x.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

const Value::Table& table_at(const Value& value) { return std::get<Value::Table>(value.content); }

TEST(Toml, TablesKeepTheOrderOfTheFile) {
  const Value root = parse_toml("z = 1\n[parameters]\nkappa = 1\nb = 2\na = 3\n", "x.toml");
  ASSERT_EQ(table_at(root).size(), 2u);
  const Value::Table& parameters = table_at(table_at(root)[1].value);
  EXPECT_EQ(parameters[0].key, "kappa");
  EXPECT_EQ(parameters[1].key, "b");
  EXPECT_EQ(parameters[2].key, "a");
}

TEST(Toml, EveryNodeKnowsItsPlace) {
  const Value root = parse_toml("z = 1\n[p]\n  kappa = { from = 1, to = [2, inf] }\n", "x.toml");
  const Entry& kappa = table_at(table_at(root)[1].value)[0];
  EXPECT_EQ(to_string(root.place), "x.toml:1:1");
  EXPECT_EQ(to_string(kappa.place), "x.toml:3:3");
  EXPECT_EQ(to_string(kappa.value.place), "x.toml:3:11");
  const Entry& to = table_at(kappa.value)[1];
  EXPECT_EQ(to_string(to.place), "x.toml:3:23");
  EXPECT_EQ(to_string(std::get<Value::List>(to.value.content)[1].place), "x.toml:3:32");
}

TEST(Toml, KindsOfValues) {
  const Value root = parse_toml("a = 1\nb = 1.5\nc = 'x'\nd = [1]\ne = {}\nf = true\ng = 1979-05-27\n", "x.toml");
  const Value::Table& table = table_at(root);
  EXPECT_EQ(std::get<std::int64_t>(table[0].value.content), 1);
  EXPECT_EQ(std::get<double>(table[1].value.content), 1.5);
  EXPECT_EQ(std::get<std::string>(table[2].value.content), "x");
  EXPECT_EQ(std::get<Value::List>(table[3].value.content).size(), 1u);
  EXPECT_TRUE(std::get<Value::Table>(table[4].value.content).empty());
  EXPECT_EQ(std::get<Value::Other>(table[5].value.content).kind, "a boolean");
  EXPECT_EQ(std::get<Value::Other>(table[6].value.content).kind, "a date");
}

TEST(Toml, KeysOfAThousandPartsAreRefusedBeforeTheyExhaustTheStack) {
  const std::string refusal = ": a key has more than 16 parts";
  EXPECT_EQ(complaint_about("a" + repeated(".a", 15) + " = 1"), "");
  EXPECT_EQ(complaint_about("a" + repeated(".a", 16) + " = 1"), "x.toml:1:32" + refusal);
  EXPECT_EQ(complaint_about("x = 1\n\n[a" + repeated(".a", 500'000) + "]"), "x.toml:3:33" + refusal);
  EXPECT_EQ(complaint_about("x = 1\ny = {a" + repeated(". a", 500'000) + " = 1}"), "x.toml:2:52" + refusal);
  EXPECT_EQ(complaint_about("\"=\"" + repeated(".\",\"", 500'000) + " = 1"), "x.toml:1:64" + refusal);
  EXPECT_EQ(complaint_about("'='" + repeated(".'#'", 500'000) + " = 1"), "x.toml:1:64" + refusal);
  EXPECT_EQ(complaint_about("s = '''\n'''''\na" + repeated(".a", 500'000) + " = 1"), "x.toml:3:32" + refusal);
  EXPECT_EQ(complaint_about("x = {s = '''q'''', a" + repeated(".a", 500'000) + " = 1}"), "x.toml:1:51" + refusal);
  EXPECT_EQ(complaint_about("s = \"\\\"\" # '''\na" + repeated(".a", 500'000) + " = 1"), "x.toml:2:32" + refusal);
}

TEST(Toml, DotsElsewhereAreNoKeys) {
  const std::string dots(1000, '.');
  EXPECT_EQ(complaint_about("a = 1 # " + dots), "");
  EXPECT_EQ(complaint_about("# " + dots + "\na = 1"), "");
  EXPECT_EQ(complaint_about("a = \"" + dots + "\""), "");
  EXPECT_EQ(complaint_about("a = '" + dots + "'"), "");
  EXPECT_EQ(complaint_about("a = \"\"\"" + dots + "\n\\\"\"\" " + dots + "\"\"\"\nb = 1"), "");
  EXPECT_EQ(complaint_about("a = '''" + dots + "\n'' " + dots + "'''''\nb = 1"), "");
  EXPECT_EQ(complaint_about("a = [0.5" + repeated(", 0.5", 1000) + "]"), "");
  EXPECT_EQ(complaint_about("[a.b]\n[c.d]\n"), "");
}

TEST(Toml, ATreeDeeperThanAnyGridFileIsRefused) {
  EXPECT_EQ(complaint_about("a = " + repeated("[", 16) + repeated("]", 16)), "");
  EXPECT_EQ(complaint_about("a = " + repeated("[", 17) + repeated("]", 17)),
            "x.toml:1:21: nested deeper than 16 levels");
  const std::string key = "a" + repeated(".a", 15) + " = ";
  const std::string deepest_of_the_library = repeated(key + "{", 250) + repeated("}", 250);
  EXPECT_EQ(complaint_about("[a" + repeated(".a", 15) + "]\n" + deepest_of_the_library),
            "x.toml:2:1: nested deeper than 16 levels");
}

TEST(Toml, ListsInListsWithoutEndAreRefused) {
  EXPECT_NE(complaint_about("a = " + repeated("[", 100'000) + repeated("]", 100'000)), "");
  EXPECT_NE(complaint_about("a = " + repeated("{a=", 100'000)), "");
}

}  // namespace
}  // namespace portrait
