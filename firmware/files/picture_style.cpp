#include "firmware/files/picture_style.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace ivo::firmware {
namespace {

constexpr Tint kRobotRed = {0.80, 0.10, 0.13};
constexpr std::array<Tint, 7> kPersonTints = {{
    {0.02, 0.46, 0.24},
    {0.13, 0.33, 0.75},
    {0.70, 0.42, 0.00},
    {0.00, 0.48, 0.52},
    {0.10, 0.58, 0.86},
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
    palette[i] = mixed({c.r / 255.0, c.g / 255.0, c.b / 255.0}, {1.0, 1.0, 1.0}, 0.5);
  }
  // Violet is the heat's alone.
  palette[static_cast<std::size_t>(SemanticClass::kStairs)] = {0.70, 0.84, 0.82};
  return palette;
}

Tint heat(double level) {
  constexpr Tint kLow = {0.88, 0.58, 0.98};
  constexpr Tint kMiddle = {0.74, 0.38, 0.92};
  constexpr Tint kHigh = {0.53, 0.20, 0.78};
  const double clamped = std::clamp(level, 0.0, 1.0);
  Tint tint = clamped < 0.5 ? mixed(kLow, kMiddle, 2 * clamped) : mixed(kMiddle, kHigh, 2 * clamped - 1);
  tint.alpha = 0.8 * std::pow(clamped, 0.6);
  return tint;
}

double full_heat_density(std::span<const double> mass, double cell_m) {
  constexpr double kMassBelow = 0.98;
  std::vector<double> ascending;
  std::copy_if(mass.begin(), mass.end(), std::back_inserter(ascending), [](double m) { return m > 0; });
  if (ascending.empty()) {
    return 0.0;
  }
  std::sort(ascending.begin(), ascending.end());
  const double sum = std::accumulate(ascending.begin(), ascending.end(), 0.0);
  double below = 0.0;
  std::size_t i = 0;
  while (i + 1 < ascending.size() && below + ascending[i] < kMassBelow * sum) {
    below += ascending[i++];
  }
  return std::max(ascending[i], 3.0 * sum / static_cast<double>(ascending.size())) / (cell_m * cell_m);
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

std::vector<std::size_t> standing_at_the_end(const SearchPicture& picture) {
  std::vector<std::size_t> standing;
  for (std::size_t i = 0; i < picture.agents.size(); ++i) {
    if (!picture.agents[i].track.empty() && !(picture.find && picture.find->agent == i)) {
      standing.push_back(i);
    }
  }
  return standing;
}

std::vector<Point> beside_line(std::span<const Point> line, double offset, double step) {
  std::vector<Point> thinned;
  for (const Point p : line) {
    if (thinned.empty() || (p != thinned.back() && distance(thinned.back(), p) >= step)) {
      thinned.push_back(p);
    }
  }
  if (thinned.size() < 2) {
    return thinned;
  }
  std::vector<Point> aside;  // of each segment, one unit to its right
  for (std::size_t i = 1; i < thinned.size(); ++i) {
    const double length = distance(thinned[i - 1], thinned[i]);
    aside.push_back({(thinned[i].y_m - thinned[i - 1].y_m) / length, -(thinned[i].x_m - thinned[i - 1].x_m) / length});
  }
  std::vector<Point> moved;
  for (std::size_t i = 0; i < thinned.size(); ++i) {
    const Point p = thinned[i];
    const Point a = aside[i == 0 ? 0 : i - 1];
    const Point b = aside[std::min(i, aside.size() - 1)];
    const double cosine = a.x_m * b.x_m + a.y_m * b.y_m;
    if (cosine < -0.5) {
      // A mitre would reach far out where the line turns back.
      moved.push_back({p.x_m + a.x_m * offset, p.y_m + a.y_m * offset});
      moved.push_back({p.x_m + b.x_m * offset, p.y_m + b.y_m * offset});
    } else {
      const double mitre = offset / (1.0 + cosine);
      moved.push_back({p.x_m + (a.x_m + b.x_m) * mitre, p.y_m + (a.y_m + b.y_m) * mitre});
    }
  }
  return moved;
}

}  // namespace ivo::firmware
