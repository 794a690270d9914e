#include "firmware/tools/bench/bench_report.hpp"

#include <gtest/gtest.h>

#include <set>

namespace ivo::firmware::bench {
namespace {

Sheet sheet() {
  Sheet sheet("speed");
  sheet.add_median("M1/U", "search", {0.5, 0.25, 0.125}, "s", Target{0.25});
  sheet.add("M2/U", "search", 2.0, "s", Target{3.0, Sense::kAtLeast});
  sheet.add("M2/U", "ratio", 1234.5, "");
  sheet.skip("Dubai", "no --data folder");
  return sheet;
}

TEST(BenchSheet, PutsTheWorstBesideMedianAndMean) {
  Sheet sheet("x");
  sheet.add_median("a", "t", {4, 1, 3, 2}, "s");
  sheet.add_mean("a", "u", {1, 2, 6}, "s");
  sheet.add_median("a", "v", {1, 2, 6}, "", Target{2, Sense::kAtLeast});
  sheet.add_median("a", "w", {1, 2, 6}, "", std::nullopt, Sense::kAtLeast);
  const auto& r = sheet.records();
  ASSERT_EQ(r.size(), 8U);
  EXPECT_EQ(*r[0].value, 2.5);
  EXPECT_EQ(r[1].figure, "t, worst");
  EXPECT_EQ(*r[1].value, 4);
  EXPECT_EQ(*r[2].value, 3);
  EXPECT_EQ(*r[3].value, 6);
  EXPECT_EQ(*r[7].value, 1);
  EXPECT_EQ(*r[5].value, 1) << "where more is better the least is the worst";
}

TEST(BenchSheet, HoldsATargetWhenItIsJustMet) {
  Sheet sheet("x");
  sheet.add("a", "t", 2.0, "s", Target{2.0});
  sheet.add("a", "t", 2.1, "s", Target{2.0});
  sheet.add("a", "t", 2.0, "s", Target{2.0, Sense::kAtLeast});
  sheet.add("a", "t", 1.9, "s", Target{2.0, Sense::kAtLeast});
  sheet.add("a", "t", 1.9, "s");
  const auto& r = sheet.records();
  EXPECT_EQ(r[0].holds, true);
  EXPECT_EQ(r[1].holds, false);
  EXPECT_EQ(r[2].holds, true);
  EXPECT_EQ(r[3].holds, false);
  EXPECT_EQ(r[4].holds, std::nullopt);
}

TEST(BenchReport, AlignsCasesThatShareAFigureInOneTable) {
  EXPECT_EQ(table_of(sheet().records()),
            "speed               search [s]  search, worst [s]  ratio\n"
            "M1/U   0.250 (<= 0.250, holds)              0.500\n"
            "M2/U    2.00 (>= 3.00, MISSED)                      1234\n"
            "Dubai: skipped: no --data folder\n");
}

TEST(BenchReport, WritesARecordAFigureForPrograms) {
  EXPECT_EQ(
      json_of(sheet().records()),
      "[\n"
      R"(  {"bench":"speed","case":"M1/U","figure":"search","value":0.25,"unit":"s","target":0.25,"holds":true,"sense":"at most"},)"
      "\n"
      R"(  {"bench":"speed","case":"M1/U","figure":"search, worst","value":0.5,"unit":"s","target":null,"holds":null},)"
      "\n"
      R"(  {"bench":"speed","case":"M2/U","figure":"search","value":2.0,"unit":"s","target":3.0,"holds":false,"sense":"at least"},)"
      "\n"
      R"(  {"bench":"speed","case":"M2/U","figure":"ratio","value":1234.5,"unit":"","target":null,"holds":null},)"
      "\n"
      R"(  {"bench":"speed","case":"Dubai","figure":"skipped: no --data folder","value":null,"unit":"","target":null,"holds":null})"
      "\n]\n");
}

TEST(BenchReport, ReadsBackWhatItWrote) {
  Sheet written("can");
  written.clock("simulated time");
  written.add("1 silent", "detected", 12.0, "ms", Target{12.0});
  written.add("1 silent", "moves again", 1.0, "", Target{1.0, Sense::kAtLeast});
  written.add("1 silent", "frames", 7.0, "");
  written.add_text("1 silent", "says", "feedback \"lost\"", false);
  written.skip("23 killed", "elsewhere");
  const std::string json = json_of(written.records());
  const Result<std::vector<Record>> read = records_of(json, "x.json");
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(json_of(read.value()), json);
  EXPECT_EQ(table_of(read.value()), table_of(written.records()));
}

TEST(BenchReport, RefusesWhatItDidNotWrite) {
  for (const char* text : {"", "[]", "{}", "[{\"bench\":\"can\"}]", "[7]"}) {
    const Result<std::vector<Record>> read = records_of(text, "x.json");
    ASSERT_FALSE(read.ok()) << text;
    EXPECT_EQ(read.error().message.find("x.json"), 0U) << read.error().message;
  }
}

TEST(BenchReport, SetsFiguresInWordsApartWhenTheyAreNotAsExpected) {
  Sheet sheet("can");
  sheet.clock("simulated time");
  sheet.add("1 silent", "detected", 12.0, "ms");
  sheet.add_text("1 silent", "says", "lost", true);
  sheet.add("2 reboot", "detected", 2.0, "ms");
  sheet.add_text("2 reboot", "says", "no fault", false);
  EXPECT_EQ(table_of(sheet.records()),
            "can: simulated time  detected [ms]                     says\n"
            "1 silent                     12.00                     lost\n"
            "2 reboot                      2.00  no fault (NOT EXPECTED)\n");
}

TEST(Benches, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const Bench& bench : benches()) {
    EXPECT_TRUE(names.insert(bench.name).second) << bench.name;
    EXPECT_NE(std::string(bench.name), "all");
  }
}

}  // namespace
}  // namespace ivo::firmware::bench
