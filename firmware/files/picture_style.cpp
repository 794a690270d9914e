#include "firmware/files/picture_style.hpp"

#include <algorithm>
#include <cmath>

namespace ivo::firmware {
namespace {

constexpr Tint kRobotRed = {0.80, 0.10, 0.13};
constexpr std::array<Tint, 7> kPersonTints = {{
    {0.02, 0.46, 0.24},
    {0.13, 0.33, 0.75},
    {0.49, 0.22, 0.62},
    {0.00, 0.48, 0.52},
    {0.72, 0.20, 0.50},
    {0.45, 0.30, 0.16},
    {0.25, 0.28, 0.34},
}};

double distance(Point a, Point b) { return std::hypot(b.x_m - a.x_m, b.y_m - a.y_m); }

}  // namespace

Tint faded(Tint tint, double alpha) { return {tint.r, tint.g, tint.b, alpha}; }

Tint mixed(Tint a, Tint b, double share_of_b) {
  const auto mix = [&](double u, double v) { return u + (v - u) * share_of_b; };
  return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b), mix(a.alpha, b.alpha)};
}

Tint agent_tint(std::span<const PicturedAgent> agents, std::size_t agent) {
  if (agents[agent].kind == AgentKind::kRobot) {
    return kRobotRed;
  }
  const auto before = std::count_if(agents.begin(), agents.begin() + static_cast<std::ptrdiff_t>(agent),
                                    [](const PicturedAgent& a) { return a.kind == AgentKind::kPerson; });
  return kPersonTints[static_cast<std::size_t>(before) % kPersonTints.size()];
}

std::array<Tint, kClasses> calm_palette() {
  const ClassTable table = default_class_table();
  std::array<Tint, kClasses> palette;
  for (std::size_t i = 0; i < palette.size(); ++i) {
    const Colour c = table[i].colour;
    palette[i] = mixed({c.r / 255.0, c.g / 255.0, c.b / 255.0}, {1.0, 1.0, 1.0}, 0.42);
  }
  return palette;
}

Tint heat(double level) {
  constexpr Tint kLow = {1.00, 0.86, 0.42};
  constexpr Tint kMiddle = {0.98, 0.62, 0.18};
  constexpr Tint kHigh = {0.86, 0.33, 0.08};
  const double clamped = std::clamp(level, 0.0, 1.0);
  Tint tint = clamped < 0.5 ? mixed(kLow, kMiddle, 2 * clamped) : mixed(kMiddle, kHigh, 2 * clamped - 1);
  tint.alpha = 0.82 * std::pow(clamped, 0.7);
  return tint;
}

double full_heat_density(std::span<const double> mass, double cell_m) {
  double sum = 0.0;
  double largest = 0.0;
  double cells = 0.0;
  for (const double m : mass) {
    sum += m;
    largest = std::max(largest, m);
    cells += m > 0 ? 1.0 : 0.0;
  }
  return cells > 0 ? std::max(largest, 3.0 * sum / cells) / (cell_m * cell_m) : 0.0;
}

double round_length(double most) {
  const double decade = std::pow(10.0, std::floor(std::log10(most)));
  for (const double step : {5.0, 2.0}) {
    if (step * decade <= most) {
      return step * decade;
    }
  }
  return decade;
}

std::vector<Mark> arrows_along(std::span<const Point> line, double spacing, double clear) {
  std::vector<Mark> marks;
  double until_next = spacing / 2;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Point a = line[i - 1];
    const Point b = line[i];
    const double length = distance(a, b);
    if (until_next > length || length < 2 * clear) {
      until_next -= length;
      continue;
    }
    for (double s = std::max(until_next, clear); s <= length - clear; s += spacing) {
      const double share = s / length;
      const Point at = {a.x_m + (b.x_m - a.x_m) * share, a.y_m + (b.y_m - a.y_m) * share};
      if (std::none_of(marks.begin(), marks.end(), [&](const Mark& m) { return distance(m.at, at) < clear; })) {
        marks.push_back({at, std::atan2(b.y_m - a.y_m, b.x_m - a.x_m)});
      }
      until_next = s + spacing;
    }
    until_next -= length;
  }
  return marks;
}

std::vector<Point> beside_line(std::span<const Point> line, double offset, double step) {
  std::vector<Point> thinned;
  for (const Point p : line) {
    if (thinned.empty() || distance(thinned.back(), p) >= step) {
      thinned.push_back(p);
    }
  }
  std::vector<Point> moved;
  for (std::size_t i = 0; i < thinned.size(); ++i) {
    const Point before = thinned[i == 0 ? 0 : i - 1];
    const Point after = thinned[std::min(i + 1, thinned.size() - 1)];
    const double length = distance(before, after);
    const double dx = length > 0 ? (after.x_m - before.x_m) / length : 0.0;
    const double dy = length > 0 ? (after.y_m - before.y_m) / length : 0.0;
    moved.push_back({thinned[i].x_m + dy * offset, thinned[i].y_m - dx * offset});
  }
  return moved;
}

}  // namespace ivo::firmware
