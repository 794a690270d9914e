#include "firmware/files/toml_table.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace ivo::firmware {
namespace {

/// The complaint about `text` read by `read`, or "fine".
std::string complaint_about_table(std::string_view text, const std::function<void(const TomlValue&)>& read) {
  const Result<TomlFile> file = TomlFile::parse(text, "f.toml");
  if (!file) {
    return file.error().message;
  }
  read(file.value().root());
  const Result<void> finish = file.value().finish();
  return finish ? "fine" : finish.error().message;
}

void read_speed(const TomlValue& root) {
  (void)root.required("speed_mps").number({0.05, 3.0, "metres a second"});
  (void)root.optional("sight_radius_m").number({0.1, 100.0, "metres"}, 2.5);
}

TEST(TomlTable, HandsOutValuesOfEveryType) {
  const auto file =
      TomlFile::parse("a = 1.5\nb = 2\nc = \"x\"\nd = true\ne = [3, 4.5]\nf = \"two\"\n[g]\nh = -7\n", "f.toml");
  ASSERT_TRUE(file.ok()) << file.error().message;
  const TomlValue root = file.value().root();
  EXPECT_EQ(root.required("a").number({0, 10}), 1.5);
  EXPECT_EQ(root.required("b").number({0, 10}), 2.0);
  EXPECT_EQ(root.required("c").text(), "x");
  EXPECT_TRUE(root.required("d").flag());
  EXPECT_EQ(root.required("e").point({0, 10}), (Point{3.0, 4.5}));
  EXPECT_EQ(root.required("f").choice({"one", "two"}), 1U);
  EXPECT_EQ(root.required("g").required("h").integer(-10, 10), -7);
  EXPECT_EQ(root.optional("i").number({0, 10}, 4.0), 4.0);
  EXPECT_EQ(root.optional("j").text("fallback"), "fallback");
  EXPECT_TRUE(file.value().finish().ok());
}

TEST(TomlTable, AcceptsBothEndsOfARange) {
  EXPECT_EQ(complaint_about_table("speed_mps = 0.05", read_speed), "fine");
  EXPECT_EQ(complaint_about_table("speed_mps = 3", read_speed), "fine");
}

TEST(TomlTable, RefusesWhatIsOutOfRangeByLineAndKey) {
  EXPECT_EQ(complaint_about_table("\n\nspeed_mps = 5", read_speed),
            "f.toml:3: speed_mps: 5 is out of range; expected 0.05 to 3 (metres a second)");
  EXPECT_EQ(complaint_about_table("speed_mps = 0.049", read_speed),
            "f.toml:1: speed_mps: 0.049 is out of range; expected 0.05 to 3 (metres a second)");
}

TEST(TomlTable, RefusesWhatIsNoFiniteNumber) {
  for (const std::string word : {"nan", "inf", "-inf"}) {
    EXPECT_EQ(
        complaint_about_table("speed_mps = " + word, read_speed),
        "f.toml:1: speed_mps: " + word + " is not a finite number; expected a number, 0.05 to 3 (metres a second)");
  }
}

TEST(TomlTable, RefusesEveryWrongTypeOfANumber) {
  const std::pair<std::string, std::string> wrong[] = {
      {"\"fast\"", "\"fast\" is text"},
      {"true", "true is a flag"},
      {"[1]", "is a list"},
      {"{ a = 1 }", "is a table"},
      {"2024-01-01", "is a date or a time"},
  };
  for (const auto& [value, is] : wrong) {
    EXPECT_EQ(complaint_about_table("speed_mps = " + value, read_speed),
              "f.toml:1: speed_mps: " + is + "; expected a number, 0.05 to 3 (metres a second)");
  }
}

TEST(TomlTable, RefusesPartsOfWholeNumbers) {
  const auto read = [](const TomlValue& root) { (void)root.required("ants").integer(1, 1000); };
  EXPECT_EQ(complaint_about_table("ants = 2.5", read),
            "f.toml:1: ants: 2.5 is a number; expected a whole number, 1 to 1000");
  EXPECT_EQ(complaint_about_table("ants = 0", read), "f.toml:1: ants: 0 is out of range; expected 1 to 1000");
}

TEST(TomlTable, RefusesTextThatIsEmptyOrHoldsControlCharacters) {
  const auto read = [](const TomlValue& root) { (void)root.required("name").text(); };
  EXPECT_EQ(complaint_about_table("name = ''", read), "f.toml:1: name: is empty; expected text");
  EXPECT_EQ(complaint_about_table("name = \"a\\nb\"", read),
            "f.toml:1: name: holds a control character; expected plain text");
  EXPECT_EQ(complaint_about_table("name = 5", read), "f.toml:1: name: 5 is a number; expected text in quotes");
}

TEST(TomlTable, RefusesUnknownWordsAndNamesTheKnownOnes) {
  const auto read = [](const TomlValue& root) { (void)root.required("kind").choice({"robot", "person"}); };
  EXPECT_EQ(complaint_about_table("kind = \"dog\"", read),
            "f.toml:1: kind: \"dog\" is unknown; expected \"robot\" or \"person\"");
  EXPECT_EQ(complaint_about_table("kind = 3", read), "f.toml:1: kind: 3 is a number; expected \"robot\" or \"person\"");
}

TEST(TomlTable, RefusesPointsThatAreNone) {
  const auto read = [](const TomlValue& root) { (void)root.required("start_m").point({0, 10, "metres"}); };
  EXPECT_EQ(complaint_about_table("start_m = [1]", read),
            "f.toml:1: start_m: has 1 element; expected a list of 2 numbers, [x, y]");
  EXPECT_EQ(complaint_about_table("start_m = [1, 2, 3]", read),
            "f.toml:1: start_m: has 3 elements; expected a list of 2 numbers, [x, y]");
  EXPECT_EQ(complaint_about_table("start_m = [\n1,\n-2]", read),
            "f.toml:3: start_m[1]: -2 is out of range; expected 0 to 10 (metres)");
}

TEST(TomlTable, NamesAMissingKeyAndItsUnit) {
  EXPECT_EQ(complaint_about_table("", read_speed),
            "f.toml:1: speed_mps: missing; it must be given, in metres a second");
  const auto read = [](const TomlValue& root) { (void)root.required("t").required("name").text(); };
  EXPECT_EQ(complaint_about_table("\n[t]\n", read), "f.toml:2: t.name: missing; it must be given");
}

TEST(TomlTable, TellsTheRightUnitOfAQuantityInAnother) {
  EXPECT_EQ(complaint_about_table("\nspeed_kmh = 5", read_speed),
            "f.toml:2: speed_kmh: unknown; this quantity is given as speed_mps, in metres a second");
  EXPECT_EQ(complaint_about_table("speed = 5", read_speed),
            "f.toml:1: speed: unknown; this quantity is given as speed_mps, in metres a second");
}

TEST(TomlTable, SuggestsTheNearestKeyToAMisspeltOne) {
  EXPECT_EQ(complaint_about_table("speed_mps = 1\nsihgt_radius_m = 2", read_speed),
            "f.toml:2: sihgt_radius_m: unknown; did you mean sight_radius_m?");
}

TEST(TomlTable, ListsTheKnownKeysWhenNoneIsNear) {
  EXPECT_EQ(complaint_about_table("speed_mps = 1\ncolour = 2", read_speed),
            "f.toml:2: colour: unknown; expected one of speed_mps, sight_radius_m");
}

TEST(TomlTable, ComplainsOfAnUnknownKeyBeforeTheMissingOneThatItExplains) {
  EXPECT_EQ(complaint_about_table("\n\nspeed_mp = 1", read_speed),
            "f.toml:3: speed_mp: unknown; did you mean speed_mps?");
}

TEST(TomlTable, ComplainsOfTheFirstFaultInTheFile) {
  EXPECT_EQ(complaint_about_table("sight_radius_m = 0\nspeed_mps = 9", read_speed),
            "f.toml:1: sight_radius_m: 0 is out of range; expected 0.1 to 100 (metres)");
}

TEST(TomlTable, RefusesAValueWhereATableBelongs) {
  const auto read = [](const TomlValue& root) { (void)root.required("bus").required("rate").integer(0, 9); };
  EXPECT_EQ(complaint_about_table("bus = 5", read), "f.toml:1: bus: 5 is a number; expected a table");
}

TEST(TomlTable, ReportsASyntaxErrorByLine) {
  const std::string message = complaint_about_table("a = 1\nb = = 2\n", read_speed);
  EXPECT_EQ(message.find("f.toml:2: not TOML: "), 0U) << message;
  EXPECT_NE(message.find("; expected TOML 1.0"), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

// Version 3.0 of the parser takes for granted that no file has these.
TEST(TomlTable, RefusesCharactersThatTheParserDoesNotExpect) {
  for (const std::string_view text :
       {"a = 1\n[(]\n", "a = 1\n[[*", "a = 1\n\xEF\xBB\xBE = 2\n", "a = 1\nb\xEF\xB7\xBA = 2\n",
        "a = 1\n[\xEF\xBB\xBE]\n", "a = 1\nb = \xEF\xAC\x80\n"}) {
    EXPECT_EQ(complaint_about_table(text, read_speed).find("f.toml:2: not TOML: "), 0U)
        << text << complaint_about_table(text, read_speed);
  }
}

TEST(TomlTable, RefusesTheSameKeyTwice) {
  const std::string message = complaint_about_table("a = 1\na = 2\n", read_speed);
  EXPECT_EQ(message.find("f.toml:2: not TOML: "), 0U) << message;
}

TEST(TomlTable, KeepsAComplaintOnOneLineWhateverTheKeyHolds) {
  const std::string message = complaint_about_table("speed_mps = 1\n\"a\\nb\" = 1", read_speed);
  EXPECT_EQ(message.find("f.toml:2: a b: unknown"), 0U) << message;
}

TEST(TomlTable, NamesAFileThatIsNotThere) {
  EXPECT_EQ(TomlFile::read("/nowhere/f.toml").error().message,
            "/nowhere/f.toml: cannot be read: No such file or directory; expected a TOML file");
}

TEST(TomlTable, RemembersTheLinesOfKeys) {
  const auto file =
      TomlFile::parse("a = 1\n[[agent]]\nname = 'x'\n\n[[agent]]\nstart_m = [\n1,\n2]\n[t.u]\nv = 1\n", "f.toml");
  ASSERT_TRUE(file.ok()) << file.error().message;
  const Lines& lines = file.value().lines();
  EXPECT_EQ(lines.line_of("a"), 1);
  EXPECT_EQ(lines.line_of("agent[0]"), 2);
  EXPECT_EQ(lines.line_of("agent[0].name"), 3);
  EXPECT_EQ(lines.line_of("agent[1]"), 5);
  EXPECT_EQ(lines.line_of("agent[1].start_m"), 6);
  EXPECT_EQ(lines.line_of("agent[1].start_m[1]"), 8);
  EXPECT_EQ(lines.line_of("agent[1].missing"), 5);
  EXPECT_EQ(lines.line_of("t.u.v"), 10);
  EXPECT_EQ(lines.line_of("nothing"), 1);
  EXPECT_EQ(lines.at("agent[1].start_m", "lies in an obstacle").message,
            "f.toml:6: agent[1].start_m: lies in an obstacle");
}

}  // namespace
}  // namespace ivo::firmware
