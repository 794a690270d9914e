#include "firmware/files/polygon_checks.hpp"

#include "config/simple_polygon.hpp"

namespace ivo::firmware {

std::optional<std::string> fault_of(const Polygon& polygon) {
  const PolygonVerdict verdict = judge_polygon(polygon);
  const std::string first = std::to_string(verdict.first);
  const std::string second = std::to_string(verdict.second);
  switch (verdict.fault) {
    case PolygonFault::kTooFew:
      return "has " + std::to_string(polygon.size()) + " vertices; expected at least 3";
    case PolygonFault::kTwice:
      return "vertices " + first + " and " + second + " are the same; expected each vertex once";
    case PolygonFault::kNoArea:
      return "covers no area; expected a polygon";
    case PolygonFault::kCrosses:
      return "crosses itself: sides " + first + " and " + second +
             " meet; expected a polygon whose sides meet only at its vertices";
    case PolygonFault::kNone:
      break;
  }
  return std::nullopt;
}

}  // namespace ivo::firmware
