#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "firmware/web/ros/cbor_writer.hpp"
#include "firmware/web/ros/json_writer.hpp"

namespace ivo::firmware::web {
namespace {

constexpr std::array<std::int8_t, 3> kBytes = {100, 0, -1};
constexpr std::array<float, 2> kFloats = {0.25F, 1.0F};

void write_sample(ValueWriter& writer) {
  writer.begin_object();
  writer.add("a", 1).add("b", -500).add("c", 0.1).add("d", true).add("e", "\"x\n").begin_list("f");
  writer.whole(70'000);
  writer.begin_object();
  writer.end_object();
  writer.end_list();
  writer.key("g");
  writer.bytes(kBytes);
  writer.key("h");
  writer.floats(kFloats);
  writer.end_object();
}

TEST(JsonWriter, WritesWhatReadsBackTheSame) {
  JsonWriter writer;
  write_sample(writer);
  EXPECT_EQ(writer.take(),
            R"({"a":1,"b":-500,"c":0.1,"d":true,"e":"\"x\u000a","f":[70000,{}],"g":[100,0,-1],"h":[0.25,1]})");
}

TEST(JsonWriter, ANumberThatIsNoneIsNull) {
  JsonWriter writer;
  writer.number(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(writer.take(), "null");
}

TEST(CborWriter, WritesRfc8949AndTypedArraysOfRfc8746) {
  CborWriter writer;
  write_sample(writer);
  const std::string bytes = writer.take();
  std::string hex;
  for (const char c : bytes) {
    constexpr const char* kDigits = "0123456789abcdef";
    const auto byte = static_cast<unsigned char>(c);
    (hex += kDigits[byte >> 4U]) += kDigits[byte & 0xFU];
  }
  EXPECT_EQ(hex,
            "bf"
            "616101"  // "a": 1
            "6162"
            "3901f3"  // "b": -500
            "6163"
            "fb3fb999999999999a"
            "6164"
            "f5"
            "6165"
            "6322780a"
            "6166"
            "9f"
            "1a00011170"
            "bf"
            "ff"
            "ff"
            "6167"
            "d84843"
            "6400ff"
            "6168"
            "d85548"
            "0000803e"
            "0000803f"
            "ff");
}

}  // namespace
}  // namespace ivo::firmware::web
