#include "drivers/eds/eds_reader.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <memory>
#include <random>
#include <string>

#include "drivers/eds/eds_error_text.hpp"
#include "drivers/eds/eds_number.hpp"
#include "drivers/eds/shipped_eds.hpp"

namespace ivo::drivers {
namespace {

/// What is wrong with `text`, as "LINE: sentence"; empty when nothing is.
std::string complaint(std::string_view text) {
  static EdsDictionary dictionary;
  const auto error = read_eds(text, dictionary);
  return error.has_value() ? std::to_string(error->line) + ": " + describe(*error) : "";
}

std::unique_ptr<EdsDictionary> read(std::string_view text) {
  auto dictionary = std::make_unique<EdsDictionary>();
  const auto error = read_eds(text, *dictionary);
  EXPECT_FALSE(error.has_value()) << error->line << ": " << describe(*error);
  return dictionary;
}

std::string variable(const std::string& index, const std::string& type, const std::string& more = "") {
  return "[" + index + "]\nParameterName=P\nDataType=" + type + "\nAccessType=rw\n" + more;
}

TEST(EdsReader, ReadsTheShippedDriveWhole) {
  const EdsDictionary& eds = ivo_drive_eds();
  EXPECT_EQ(eds.vendor_name(), "IVO");
  EXPECT_EQ(eds.product_name(), "IVO-class wheel drive");
  EXPECT_EQ(eds.device().revision_number, 0x10000U);
  EXPECT_TRUE(eds.dummy(DataType::kUnsigned32));
  EXPECT_FALSE(eds.dummy(DataType::kBoolean));
  const EdsObject* const type = eds.find({0x1000, 0});
  ASSERT_NE(type, nullptr);
  EXPECT_EQ(eds.name_of(*type), "Device type");
  EXPECT_EQ(type->power_on.bits, 0x20192U);
  EXPECT_EQ(type->bytes, 4);
  EXPECT_FALSE(writable(type->access));
  const EdsObject* const cob_id = eds.find({0x1803, 1});
  ASSERT_NE(cob_id, nullptr);
  EXPECT_EQ(cob_id->power_on.at(5), 0xC0000485U);
  const EdsObject* const option = eds.find({0x605A, 0});
  ASSERT_NE(option, nullptr);
  EXPECT_EQ(option->low.bits, 0U);
  EXPECT_EQ(option->high.bits, 6U);
  EXPECT_EQ(eds.text_of(*eds.find({0x1008, 0})), "IVO-class wheel drive");
  EXPECT_EQ(static_cast<std::int64_t>(eds.find({0x60C2, 2})->power_on.bits), -3);
  EXPECT_TRUE(eds.find({0x60FF, 0})->mappable_into(true));
  EXPECT_FALSE(eds.find({0x60FF, 0})->mappable_into(false));
  EXPECT_TRUE(eds.find({0x6041, 0})->mappable_into(false));
  EXPECT_FALSE(eds.find({0x6041, 0})->mappable_into(true));
  EXPECT_EQ(eds.find({0x1400, 4}), nullptr);
  EXPECT_TRUE(eds.has_index(0x1400));
  EXPECT_FALSE(eds.has_index(0x1401 + 3));
}

TEST(EdsReader, ReadsTheDriveWhoseMappingCannotBeWritten) {
  const EdsDictionary& eds = fixed_mapping_drive_eds();
  EXPECT_FALSE(writable(eds.find({0x1603, 2})->access));
  EXPECT_EQ(eds.find({0x1603, 2})->power_on.bits, 0x60FF0020U);
  EXPECT_EQ(eds.find({0x1A02, 2})->power_on.bits, 0x60640020U);
  EXPECT_EQ(eds.find({0x1403, 1})->power_on.at(1), 0x501U);
}

TEST(EdsReader, TakesCarriageReturnsBlanksCommentsAndAnyCase) {
  const auto eds = read(
      "\xEF\xBB\xBF; a comment\r\n\r\n[ 100a ]\r\n parametername = Software = 1 \r\nDATATYPE=0X0009\r\n"
      "accesstype=RO\r\ndefaultvalue=v 1 ; not a comment\r\n[unknown]\r\nx=y\r\n");
  const EdsObject* const version = eds->find({0x100A, 0});
  ASSERT_NE(version, nullptr);
  EXPECT_EQ(eds->name_of(*version), "Software = 1");
  EXPECT_EQ(eds->text_of(*version), "v 1 ; not a comment");
  EXPECT_EQ(version->line, 3U);
}

TEST(EdsReader, TakesACompactObject) {
  const auto eds = read(
      "[1003]\nParameterName=Errors\nObjectType=8\nCompactSubObj=3\nDataType=7\nAccessType=ro\n"
      "DefaultValue=5\nPDOMapping=1\n[1003Name]\nNrOfEntries=0\n");
  EXPECT_EQ(eds->objects().size(), 4U);
  EXPECT_EQ(eds->find({0x1003, 0})->power_on.bits, 3U);
  EXPECT_EQ(eds->find({0x1003, 0})->bytes, 1);
  EXPECT_EQ(eds->find({0x1003, 3})->power_on.bits, 5U);
  EXPECT_TRUE(eds->find({0x1003, 3})->mappable);
}

TEST(EdsReader, PrefersTheConfiguredValueOfADcf) {
  const auto eds = read(variable("6083", "7", "DefaultValue=1\nParameterValue=2\n"));
  EXPECT_EQ(eds->find({0x6083, 0})->power_on.bits, 2U);
}

TEST(EdsReader, KeepsTheBeginningOfALongString) {
  const auto eds = read(variable("1008", "9", "DefaultValue=" + std::string(300, 'x') + "\n"));
  EXPECT_EQ(eds->text_of(*eds->find({0x1008, 0})), std::string(EdsDictionary::kStringBytes, 'x'));
}

struct NumberCase {
  DataType type{};
  const char* text = "";
  EdsNumberStatus status{};
  std::int64_t value = 0;
};

TEST(EdsReader, ReadsNumbersAsTheStandardWritesThem) {
  using enum EdsNumberStatus;
  const NumberCase cases[] = {
      {DataType::kUnsigned8, "255", kNumber, 255},
      {DataType::kUnsigned8, "256", kOutOfRange},
      {DataType::kUnsigned8, "0xff", kNumber, 255},
      {DataType::kUnsigned8, "0x100", kOutOfRange},
      {DataType::kUnsigned8, "017", kNumber, 15},
      {DataType::kUnsigned8, "08", kNotANumber},
      {DataType::kUnsigned8, "0", kNumber, 0},
      {DataType::kUnsigned8, "-1", kOutOfRange},
      {DataType::kUnsigned8, "", kNotANumber},
      {DataType::kUnsigned8, "0x", kNotANumber},
      {DataType::kUnsigned8, "1 2", kNotANumber},
      {DataType::kUnsigned8, "+1", kNotANumber},
      {DataType::kBoolean, "1", kNumber, 1},
      {DataType::kBoolean, "2", kOutOfRange},
      {DataType::kInteger8, "-128", kNumber, -128},
      {DataType::kInteger8, "-129", kOutOfRange},
      {DataType::kInteger8, "128", kOutOfRange},
      {DataType::kInteger8, "0xFF", kNumber, -1},
      {DataType::kInteger8, "0x7F", kNumber, 127},
      {DataType::kInteger8, "0x1FF", kOutOfRange},
      {DataType::kInteger8, "-0x1", kNotANumber},
      {DataType::kInteger24, "0x800000", kNumber, -8388608},
      {DataType::kInteger32, "0x80000000", kNumber, -2147483648LL},
      {DataType::kInteger64, "-9223372036854775808", kNumber, std::numeric_limits<std::int64_t>::min()},
      {DataType::kInteger64, "9223372036854775808", kOutOfRange},
      {DataType::kInteger64, "0xFFFFFFFFFFFFFFFF", kNumber, -1},
      {DataType::kUnsigned64, "18446744073709551616", kOutOfRange},
      {DataType::kUnsigned32, "$NODEID+0x180", kNumber, 0x180},
      {DataType::kUnsigned32, "$nodeid + 384", kNumber, 0x180},
      {DataType::kUnsigned32, "0x180+$NODEID", kNumber, 0x180},
      {DataType::kUnsigned32, "$NODEID", kNumber, 0},
      {DataType::kUnsigned32, "$NODEID+", kNotANumber},
      {DataType::kUnsigned32, "$NODEID-1", kNotANumber},
      {DataType::kUnsigned32, "$NODEID+$NODEID", kNotANumber},
      {DataType::kUnsigned32, "$NODEID+0xFFFFFFFF", kOutOfRange},
      {DataType::kInteger32, "$NODEID+1", kNotANumber},
  };
  for (const NumberCase& c : cases) {
    const EdsNumber number = eds_number(c.text, c.type);
    EXPECT_EQ(number.status, c.status) << c.text << " of type " << static_cast<int>(c.type);
    if (number.status == kNumber) {
      EXPECT_EQ(static_cast<std::int64_t>(number.value.bits), c.value) << c.text;
      EXPECT_EQ(number.value.plus_node, std::string(c.text).find('$') != std::string::npos ||
                                            std::string(c.text).find("nodeid") != std::string::npos)
          << c.text;
    }
  }
  EXPECT_EQ(std::bit_cast<double>(eds_number("-1.5e3", DataType::kReal64).value.bits), -1500.0);
  EXPECT_EQ(eds_number("0x3F800000", DataType::kReal32).value.bits, 0x3F800000U);
  EXPECT_EQ(eds_number("1e99", DataType::kReal32).status, kOutOfRange);
  EXPECT_EQ(eds_number("one", DataType::kReal32).status, kNotANumber);
}

TEST(EdsReader, KnowsTheSizesOfAllBasicTypes) {
  const std::pair<int, int> sizes[] = {{1, 1},    {2, 1},    {3, 2},    {4, 4},    {5, 1},    {6, 2},    {7, 4},
                                       {8, 4},    {9, 0},    {0xA, 0},  {0xB, 0},  {0xC, 6},  {0xD, 6},  {0xE, 0},
                                       {0xF, 0},  {0x10, 3}, {0x11, 8}, {0x12, 5}, {0x13, 6}, {0x14, 7}, {0x15, 8},
                                       {0x16, 3}, {0x17, 0}, {0x18, 5}, {0x19, 6}, {0x1A, 7}, {0x1B, 8}, {0x40, 0}};
  for (const auto& [type, bytes] : sizes) {
    EXPECT_EQ(bytes_of(static_cast<DataType>(type)), bytes) << type;
  }
}

const std::string kIdentity = "[1018]\nParameterName=I\nObjectType=9\nSubNumber=2\n";  // 4 lines
const std::string kSub0 = "[1018sub0]\nParameterName=N\nDataType=5\nAccessType=ro\n";  // 4 lines
const std::string kSub1 = "[1018sub1]\nParameterName=V\nDataType=7\nAccessType=ro\n";

TEST(EdsReader, RefusesByLineSectionAndKey) {
  EXPECT_EQ(complaint(""), "0: no object is described; expected sections as [1000]");
  EXPECT_EQ(complaint("[0005]\nParameterName=Type\nObjectType=5\n"),
            "0: no object is described; expected sections as [1000]")
      << "a type has no value";
  EXPECT_EQ(complaint("a=1\n"), "1: a: the key is before any section; expected [section] first");
  EXPECT_EQ(complaint("[1000\n"), "1: \"[1000\"; expected ] at its end");
  EXPECT_EQ(complaint("[1000]\nnonsense\n"),
            "2: [1000]: \"nonsense\"; expected [section], key=value or a comment that begins with ;");
  EXPECT_EQ(complaint("[1000]\n=1\n"),
            "2: [1000]: \"=1\"; expected [section], key=value or a comment that begins with ;");
  EXPECT_EQ(complaint("[1000]\n"), "1: [1000] ParameterName: missing; expected a value");
  EXPECT_EQ(complaint("[1000]\nParameterName=D\n"), "1: [1000] DataType: missing; expected a value");
  EXPECT_EQ(complaint("[1000]\nParameterName=D\nDataType=7\nAccessType=none\n"),
            "4: [1000] AccessType: \"none\"; expected ro, wo, rw, rwr, rww or const");
  EXPECT_EQ(complaint(variable("1000", "five")),
            "3: [1000] DataType: \"five\" is no number; expected decimal, 0x and hexadecimal, or 0 and octal");
  EXPECT_EQ(complaint(variable("1000", "0x10000")),
            "3: [1000] DataType: \"0x10000\" is too large; expected 0 to 65535");
  EXPECT_EQ(complaint(variable("1000", "5", "DefaultValue=0x1FF\n")),
            "5: [1000] DefaultValue: \"0x1FF\" does not fit UNSIGNED8; expected 0 to 255");
  EXPECT_EQ(complaint(variable("1000", "2", "LowLimit=-129\n")),
            "5: [1000] LowLimit: \"-129\" does not fit INTEGER8; expected -128 to 127");
  EXPECT_EQ(
      complaint(variable("1000", "7", "DefaultValue=x\n")),
      "5: [1000] DefaultValue: \"x\" is no number; expected decimal, 0x and hexadecimal, or 0 and octal, also with "
      "$NODEID+");
  EXPECT_EQ(complaint(variable("1000", "7", "LowLimit=5\nHighLimit=4\n")),
            "5: [1000] LowLimit: \"5\" is above HighLimit; expected at most that");
  EXPECT_EQ(complaint(variable("1000", "7", "PDOMapping=2\n")),
            "5: [1000] PDOMapping: \"2\" is too large; expected 0 to 1");
  EXPECT_EQ(complaint(variable("1000", "7", "ObjectType=3\n")),
            "5: [1000] ObjectType: \"3\"; expected 7 (VAR), 8 (ARRAY), 9 (RECORD), 2 (DOMAIN), 5, 6 or 0");
  EXPECT_EQ(complaint(variable("1000", "7", "datatype=7\n")),
            "5: [1000] datatype: the key is there already, on line 3; expected it once");
  EXPECT_EQ(complaint(variable("1000", "7") + variable("1000", "7")),
            "5: [1000]: the section is there already, on line 1; expected it once");
  EXPECT_EQ(complaint("[DeviceInfo]\n[deviceinfo]\n"),
            "2: [deviceinfo]: the section is there already, on line 1; expected it once");
  EXPECT_EQ(complaint("[DeviceInfo]\nVendorNumber=4294967296\n"),
            "2: [DeviceInfo] VendorNumber: \"4294967296\" is too large; expected 0 to 4294967295");
  EXPECT_EQ(complaint("[DummyUsage]\nDummy0005=2\n"), "2: [DummyUsage] Dummy0005: \"2\" is too large; expected 0 to 1");
  EXPECT_EQ(complaint("[DummyUsage]\nDummyX=1\n"),
            "2: [DummyUsage] DummyX: \"1\" is no number; expected decimal, 0x and hexadecimal, or 0 and octal");
}

TEST(EdsReader, RefusesObjectsThatDoNotFitTogether) {
  EXPECT_EQ(complaint(kIdentity + kSub0 + kSub1), "");
  EXPECT_EQ(complaint(kSub1 + kSub0 + kIdentity), "") << "in any order";
  EXPECT_EQ(complaint(kIdentity + kSub0), "1: [1018] SubNumber: there are 1; expected as many as it says");
  EXPECT_EQ(complaint(kIdentity + kSub0 + kSub1 + kSub1),
            "13: [1018sub1]: the section is there already, on line 9; expected it once");
  EXPECT_EQ(complaint(kSub1), "1: [1018sub1]: the object itself has no section; expected one");
  EXPECT_EQ(complaint(variable("2000", "7") + kSub1), "5: [1018sub1]: the object itself has no section; expected one");
  EXPECT_EQ(complaint(variable("1000", "7") + kSub1), "5: [1018sub1]: the object itself has no section; expected one");
  EXPECT_EQ(complaint(variable("1018", "7") + kSub1),
            "5: [1018sub1]: the object is a variable; expected ObjectType 8 or 9 of what has sub-indices");
  EXPECT_EQ(complaint("[1018]\nParameterName=I\nObjectType=9\nSubNumber=1\n" + kSub1),
            "1: [1018]: sub-index 0 is missing; expected its section");
  EXPECT_EQ(complaint("[1018]\nParameterName=I\nObjectType=9\n"), "1: [1018] SubNumber: missing; expected a value");
  EXPECT_EQ(complaint("[1018]\nParameterName=I\nObjectType=8\nCompactSubObj=1\nDataType=7\nAccessType=ro\n" + kSub1),
            "1: [1018]: CompactSubObj and sections of sub-indices; expected one of both");
  EXPECT_EQ(complaint("[1018]\nParameterName=I\nObjectType=8\nCompactSubObj=255\nDataType=7\nAccessType=ro\n"),
            "4: [1018] CompactSubObj: \"255\" is too large; expected 0 to 254");
  EXPECT_EQ(
      complaint("[1003Value]\nNrOfEntries=1\n"),
      "1: [1003Value]: tables of values are not supported; expected ParameterValue in sections of the sub-indices");
}

TEST(EdsReader, RefusesListsThatDoNotSayWhatIsThere) {
  const std::string list = "[MandatoryObjects]\nSupportedObjects=1\n1=0x1000\n";
  EXPECT_EQ(complaint(list + variable("1000", "7")), "");
  EXPECT_EQ(complaint(list + variable("1001", "7")),
            "3: [1000]: the object is listed but has no section; expected one");
  EXPECT_EQ(complaint("[MandatoryObjects]\nSupportedObjects=2\n1=0x1000\n" + variable("1000", "7")),
            "1: [MandatoryObjects] SupportedObjects: there are 1; expected as many as it says");
  EXPECT_EQ(complaint(list + "[OptionalObjects]\nSupportedObjects=1\n1=0x1000\n" + variable("1000", "7")),
            "6: [1000]: the object is listed already, on line 3; expected it once");
  EXPECT_EQ(complaint("[OptionalObjects]\n1=0x10000\n"),
            "2: [OptionalObjects] 1: \"0x10000\" is too large; expected 0 to 65535");
  EXPECT_EQ(complaint("[OptionalObjects]\n1=no\n"),
            "2: [OptionalObjects] 1: \"no\" is no number; expected decimal, 0x and hexadecimal, or 0 and octal");
}

TEST(EdsReader, RefusesBytesThatAreNoTextAndLinesWithoutEnd) {
  EXPECT_EQ(complaint(std::string("[1000]\nParam\0terName=x\n", 23)), "2: [1000]: byte 0 in the line; expected text");
  EXPECT_EQ(complaint("[1000]\n\x1b[31m=x\n"), "2: [1000]: byte 27 in the line; expected text");
  EXPECT_EQ(complaint("[1000]\nParameterName=" + std::string(5000, 'x')),
            "2: [1000]: the line has 5014 bytes; expected at most 1024");
  EXPECT_EQ(complaint("[\xff\xfe]\nx\n"),
            "2: [??]: \"x\"; expected [section], key=value or a comment that begins with ;");
}

TEST(EdsReader, RefusesWhatIsBeyondItsCapacity) {
  std::string names;
  for (int i = 0; i < 2100; ++i) {
    names +=
        "[" + std::to_string(2000 + i) + "]\nParameterName=" + std::string(70, 'n') + "\nDataType=7\nAccessType=ro\n";
  }
  EXPECT_EQ(complaint(names), "8193: [4048]: names and strings are too long together; expected at most 131072 bytes");
  std::string many;
  for (int i = 0; i <= 16; ++i) {
    many += "[" + std::to_string(2000 + i) +
            "]\nParameterName=n\nObjectType=8\nCompactSubObj=254\nDataType=7\nAccessType=ro\n";
  }
  EXPECT_EQ(complaint(many), "97: [2016]: one object too many; expected at most 4096");
}

TEST(EdsReader, SurvivesAnyDamageToAFile) {
  const std::string good(ivo_drive_eds_text());
  std::mt19937 random(20250115);
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  static EdsDictionary dictionary;
  for (int i = 0; i < 1000; ++i) {
    std::string text = good.substr(0, below(good.size()) + 1);
    for (std::size_t changes = below(20); changes > 0; --changes) {
      const std::size_t at = below(text.size());
      switch (below(3)) {
        case 0:
          text[at] = static_cast<char>(below(256));
          break;
        case 1:
          text.insert(at, good, below(good.size()), below(100));
          break;
        default:
          text.erase(at, below(100));
          if (text.empty()) {
            text = "[";
          }
      }
    }
    const auto error = read_eds(text, dictionary);
    if (error.has_value()) {
      EXPECT_NE(describe(*error), "");
      EXPECT_LE(error->line, static_cast<std::uint32_t>(std::count(text.begin(), text.end(), '\n') + 1));
    }
  }
}

}  // namespace
}  // namespace ivo::drivers
