// sensor_msgs/PointCloud2.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "firmware/web/ros/message_reading.hpp"

namespace ivo::firmware::web {
namespace {

constexpr std::uint64_t kMostCloudBytes = 4U << 20U;
constexpr std::uint64_t kFloat32 = 7;  // of sensor_msgs/PointField

int base64_digit(char c) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::size_t at = kDigits.find(c);
  return at == std::string_view::npos ? -1 : static_cast<int>(at);
}

/// None of what is no base64 (RFC 4648) with its padding.
std::optional<std::string> bytes_of_base64(std::string_view text) {
  if (text.size() % 4 != 0) {
    return std::nullopt;
  }
  const std::size_t padding = text.ends_with("==") ? 2 : text.ends_with('=') ? 1 : 0;
  text.remove_suffix(padding);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : text) {
    const int digit = base64_digit(c);
    if (digit < 0) {
      return std::nullopt;
    }
    bits = bits << 6U | static_cast<std::uint32_t>(digit);
    held += 6;
    if (held >= 8) {
      held -= 8;
      bytes += static_cast<char>(bits >> static_cast<unsigned>(held) & 0xFFU);
    }
  }
  return bytes;
}

std::string cloud_bytes(JsonReading& reading, const Json& message) {
  const Json* const data = reading.field(message, "", "data");
  if (data != nullptr && data->kind == Json::Kind::kText) {
    if (std::optional<std::string> bytes = bytes_of_base64(data->text)) {
      return *std::move(bytes);
    }
  } else if (data != nullptr && data->kind == Json::Kind::kList) {
    std::string bytes;
    for (const Json& value : data->elements) {
      if (value.kind != Json::Kind::kCount || value.count > 0xFF) {
        reading.fault("data", "holds what is no byte; expected numbers of 0 to 255");
      }
      bytes += static_cast<char>(value.count & 0xFFU);
    }
    return bytes;
  }
  reading.fault("data", "is neither base64 nor a list; expected the points' bytes");
  return {};
}

/// Where the field begins in a point.
std::size_t offset_of(JsonReading& reading, const Json& message, std::string_view name, std::uint64_t step) {
  for (const Json& field : reading.list(message, "", "fields").elements) {
    if (reading.text(field, "fields.", "name") == name) {
      if (reading.count(field, "fields.", "datatype", 8) != kFloat32) {
        reading.fault("fields", std::string(name) + " is no float32; expected datatype 7");
      }
      const std::uint64_t offset = reading.count(field, "fields.", "offset", kMostCloudBytes);
      if (offset + sizeof(float) > step) {
        reading.fault("fields", std::string(name) + " lies beyond point_step; expected it within a point");
      }
      return offset;
    }
  }
  reading.fault("fields", std::string(name) + " is missing; expected x, y and z as float32");
  return 0;
}

float float_at(std::string_view bytes, std::size_t at, bool big_endian) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < sizeof bits; ++i) {
    const auto byte = static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i]));
    bits |= byte << (8 * (big_endian ? 3 - i : i));
  }
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

}  // namespace

std::vector<Point> cloud_points(JsonReading& reading, const Json& message) {
  std::vector<Point> points;
  const std::uint64_t height = reading.count(message, "", "height", kMostCloudBytes);
  const std::uint64_t width = reading.count(message, "", "width", kMostCloudBytes);
  const std::uint64_t step = reading.count(message, "", "point_step", kMostCloudBytes);
  const std::uint64_t row = reading.count(message, "", "row_step", kMostCloudBytes);
  const bool big_endian = reading.flag(message, "", "is_bigendian");
  const std::size_t x = offset_of(reading, message, "x", step);
  const std::size_t y = offset_of(reading, message, "y", step);
  (void)offset_of(reading, message, "z", step);
  const std::string bytes = cloud_bytes(reading, message);
  if (reading.ok() && (row < width * step || bytes.size() != row * height)) {
    reading.fault("data", "has " + std::to_string(bytes.size()) +
                              " bytes; expected row_step x height, and a row_step of " + "width x point_step at least");
  }
  for (std::uint64_t i = 0; i < height && reading.ok(); ++i) {
    for (std::uint64_t k = 0; k < width; ++k) {
      const std::size_t at = i * row + k * step;
      const Point point{double{float_at(bytes, at + x, big_endian)}, double{float_at(bytes, at + y, big_endian)}};
      if (std::isfinite(point.x_m) && std::isfinite(point.y_m)) {
        points.push_back(point);
      }
    }
  }
  return points;
}

}  // namespace ivo::firmware::web
