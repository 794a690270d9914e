// Two numbers along the axes of a plane. Eigen's would do as well, and cost every file that sees a path seconds to
// compile.
#pragma once

#include <cmath>

namespace ivo::firmware {

struct Vector2 {
  double x = 0.0;
  double y = 0.0;

  friend constexpr Vector2 operator+(const Vector2& a, const Vector2& b) noexcept { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Vector2 operator-(const Vector2& a, const Vector2& b) noexcept { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Vector2 operator*(double factor, const Vector2& v) noexcept { return {factor * v.x, factor * v.y}; }
  friend constexpr Vector2 operator/(const Vector2& v, double divisor) noexcept {
    return {v.x / divisor, v.y / divisor};
  }
};

[[nodiscard]] constexpr double dot(const Vector2& a, const Vector2& b) noexcept { return a.x * b.x + a.y * b.y; }
/// Of b to the left of a, times both lengths.
[[nodiscard]] constexpr double cross(const Vector2& a, const Vector2& b) noexcept { return a.x * b.y - a.y * b.x; }
[[nodiscard]] inline double norm(const Vector2& v) noexcept { return std::sqrt(dot(v, v)); }

}  // namespace ivo::firmware
