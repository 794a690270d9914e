#include "firmware/files/geojson_file.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/unit/firmware/files/complaint.hpp"

namespace ivo::firmware {
namespace {

const std::vector<std::string> kDrawers = {"IVO", "Ana"};

std::vector<DrawnArea> two_areas() {
  return {{DrawnPurpose::kPreferred, "Ana", 3, {{0.1, 0.2}, {1.0 / 3.0, -0.0}, {1e-7, 20.000000000000004}}},
          {DrawnPurpose::kNoGo, std::nullopt, std::nullopt, {{0, 0}, {2, 0}, {2, 2}, {0, 2}}}};
}

std::string complaint_about_geojson(std::string_view from, std::string_view to) {
  return message_of(parse_geojson(replaced(geojson_text(two_areas()), from, to), "a.geojson", kDrawers));
}

TEST(GeojsonFile, WhatIsWrittenReadsBackTheSameToTheLastBit) {
  const std::string text = geojson_text(two_areas());
  const auto read = parse_geojson(text, "a.geojson", kDrawers);
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read.value(), two_areas());
  EXPECT_EQ(geojson_text(read.value()), text);
}

TEST(GeojsonFile, SaysWhoseFrameItsMetresAreOf) {
  const std::string text = geojson_text({});
  EXPECT_NE(text.find("\"frame\": \"map\""), std::string::npos);
  EXPECT_NE(text.find("\"unit\": \"metre\""), std::string::npos);
  EXPECT_TRUE(parse_geojson(text, "a.geojson", kDrawers).value().empty());
}

TEST(GeojsonFile, TakesWhatOtherToolsWriteAround) {
  const auto read = parse_geojson(
      R"({"type":"FeatureCollection","name":"garden","features":[{"type":"Feature","id":7,
          "properties":{"purpose":"no_go","agent":"IVO","fill":"#ff0000"},
          "geometry":{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,0]]]}}]})",
      "a.geojson", kDrawers);
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read.value().front().agent, "IVO");
  EXPECT_EQ(read.value().front().polygon, (Polygon{{0, 0}, {1, 0}, {1, 1}}));
}

TEST(GeojsonFile, NamesTheFeatureAndWhatIsExpectedOfIt) {
  EXPECT_EQ(complaint_about_geojson("[0.0,2.0],[0.0,0.0]]]", "[0.0,2.0],[0.0,0.5]]]"),
            "a.geojson: features[1].geometry.coordinates: has a ring that is not closed; expected its last position as "
            "its first");
  EXPECT_EQ(complaint_about_geojson("[[[0.0,0.0],[2.0,0.0]", "[[[9,9],[8,9],[8,8],[9,9]],[[0.0,0.0],[2.0,0.0]"),
            "a.geojson: features[1].geometry.coordinates: has 2 rings; expected one, an area has no holes");
  EXPECT_EQ(complaint_about_geojson("[2.0,0.0],[2.0,2.0]", "[2.0,2.0],[2.0,0.0]"),
            "a.geojson: features[1].geometry.coordinates: crosses itself: sides 0 and 2 meet; expected a polygon whose "
            "sides meet only at its vertices");
  EXPECT_EQ(complaint_about_geojson("[2.0,2.0],[0.0,2.0],", ""),
            "a.geojson: features[1].geometry.coordinates: has a ring of 3 positions; expected 4 to 65, the last as the "
            "first");
  EXPECT_EQ(complaint_about_geojson("[2.0,2.0]", "[2.0,2.0,1.0]"),
            "a.geojson: features[1].geometry.coordinates[0][2]: is no point; expected [x, y]");
  EXPECT_EQ(complaint_about_geojson("[2.0,2.0]", "[2.0,1e7]"),
            "a.geojson: features[1].geometry.coordinates[0][2]: 10000000 will not do; expected a number, -1000000 to "
            "1000000");
  EXPECT_EQ(complaint_about_geojson("\"Ana\"", "\"Eva\""),
            "a.geojson: features[0].properties.agent: \"Eva\" is unknown; expected one of IVO, Ana");
  EXPECT_EQ(
      complaint_about_geojson("\"Ana\"", "null"),
      "a.geojson: features[0].properties.agent: is null; expected whose preferred area it is, everybody has no-go "
      "areas alone");
  EXPECT_EQ(complaint_about_geojson("no_go", "lawn"),
            "a.geojson: features[1].properties.purpose: \"lawn\" is unknown; expected \"preferred\" or \"no_go\"");
  EXPECT_EQ(complaint_about_geojson("\"slot\":3", "\"slot\":32"),
            "a.geojson: features[0].properties.slot: is no count; expected a whole number, 0 to 31");
  EXPECT_EQ(complaint_about_geojson("\"agent\":null", "\"agent\":null,\"slot\":3"),
            "a.geojson: features[1].properties.slot: 3 is taken by an earlier feature; expected each slot once");
  EXPECT_EQ(complaint_about_geojson("\"Polygon\"", "\"Point\""),
            "a.geojson: features[0].geometry.type: \"Point\" will not do; expected \"Polygon\"");
}

TEST(GeojsonFile, RefusesDegreesAndOtherDocuments) {
  EXPECT_EQ(complaint_about_geojson("\"metre\"", "\"degree\""),
            "a.geojson: unit: \"degree\" will not do; expected \"metre\"");
  EXPECT_EQ(complaint_about_geojson("\"frame\"", "\"crs\": {}, \"frame\""),
            "a.geojson: crs: names a reference system; expected none, positions are metres of the map's frame");
  EXPECT_EQ(message_of(parse_geojson("[]", "a.geojson", kDrawers)),
            "a.geojson: type: missing; expected \"FeatureCollection\"");
  EXPECT_EQ(message_of(parse_geojson("{", "a.geojson", kDrawers)),
            "a.geojson:1: not JSON: ends too early; expected areas as GeoJSON");
}

}  // namespace
}  // namespace ivo::firmware
