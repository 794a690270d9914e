#include "firmware/files/json_value.hpp"

#include <gtest/gtest.h>

#include <string>

namespace ivo::firmware {
namespace {

std::string fault_in(const std::string& text) {
  const Result<Json> json = parse_json(text, "it", "JSON");
  return json ? "" : json.error().message;
}

std::string repeated(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) {
    text += part;
  }
  return text;
}

/// {"0":0,"1":1,...}
std::string object_of(int members) {
  std::string text = "{";
  for (int i = 0; i < members; ++i) {
    text += (i == 0 ? "\"" : ",\"") + std::to_string(i) + "\":" + std::to_string(i);
  }
  return text + "}";
}

const char* const kTooDeep = "it: nested deeper than 64 levels; expected JSON";
const char* const kTooMany = "it: holds an object of more than 500 members; expected JSON";

TEST(JsonText, IsRefusedBeyondSixtyFourLevels) {
  EXPECT_EQ(fault_in(repeated("[", 64) + repeated("]", 64)), "");
  EXPECT_EQ(fault_in(repeated("[", 65) + repeated("]", 65)), kTooDeep);
  EXPECT_EQ(fault_in(repeated("{\"a\":", 65) + "0" + repeated("}", 65)), kTooDeep);
}

TEST(JsonText, IsAsDeepAsItsBracketsOutsideOfTexts) {
  const std::string deep = repeated("[", 1'000'000) + repeated("]", 1'000'000);
  EXPECT_EQ(fault_in("[\"" + repeated("]", 1'000'000) + "\"," + deep + "]"), kTooDeep);
  EXPECT_EQ(fault_in("[\"\\\"" + repeated("]", 1'000'000) + "\"," + deep + "]"), kTooDeep);
  EXPECT_EQ(fault_in("[\"\\\\\"," + deep + "]"), kTooDeep);
  EXPECT_EQ(fault_in(repeated("]", 1'000'000) + deep), kTooDeep);
  EXPECT_EQ(fault_in("[\"" + repeated("[", 1000) + "\"]"), "");
  EXPECT_EQ(fault_in("[\"\\\"" + repeated("{", 1000) + "\"]"), "");
}

TEST(JsonText, HasObjectsOfFiveHundredMembersAtMost) {
  EXPECT_EQ(fault_in(object_of(500)), "");
  EXPECT_EQ(fault_in(object_of(501)), kTooMany);
  EXPECT_EQ(fault_in(object_of(300'000)), kTooMany);
  EXPECT_EQ(fault_in("[[" + object_of(501) + "]]"), kTooMany);
  EXPECT_EQ(fault_in("[" + object_of(300) + "," + object_of(300) + "]"), "");
  EXPECT_EQ(fault_in("{\"a\":" + object_of(500) + ",\"b\":" + object_of(499) + "}"), "");
  EXPECT_EQ(fault_in("{\"a\":\"" + repeated(":", 1000) + "\"}"), "");
  EXPECT_EQ(fault_in("[" + repeated("0,", 100'000) + "0]"), "");
}

}  // namespace
}  // namespace ivo::firmware
