// A sheet to draw on, in pixels from the top left.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "config/base/geometry.hpp"
#include "config/base/result.hpp"
#include "firmware/files/picture_layout.hpp"
#include "firmware/files/picture_style.hpp"

namespace ivo::firmware {

struct Stroke {
  Tint tint;
  double width = 1.0;
  double dash_on = 0.0;  ///< 0: a solid line
  double dash_off = 0.0;
  bool round_ends = true;
};

struct Lettering {
  Tint tint;
  double size = 17.0;
  bool bold = false;
  double align = 0.0;  ///< 0 starts at the place, 0.5 is centred, 1 ends there
  double room = 1e9;   ///< wider text is shrunk to this
};

/// Pixels for an image: premultiplied ARGB, the top row first.
struct Sprite {
  int width = 0;
  int height = 0;
  std::vector<std::uint32_t> pixels;
};

[[nodiscard]] std::uint32_t premultiplied(Tint tint);

class Pen {
 public:
  Pen(int width_px, int height_px, Tint paper);
  Pen(const Pen&) = delete;
  Pen& operator=(const Pen&) = delete;
  ~Pen();

  /// False after the first failure; later calls draw nothing.
  [[nodiscard]] bool ok() const;

  /// Nothing is drawn outside of `box` until unclip().
  void clip(const Box& box);
  void unclip();

  void line(std::span<const Point> points, const Stroke& stroke);
  void outline(std::span<const Point> corners, const Stroke& stroke);
  void area(std::span<const Point> corners, Tint tint);
  /// Slanted lines, `spacing` apart, within the areas; areas that touch are hatched as one.
  void hatch(std::span<const std::vector<Point>> areas, const Stroke& stroke, double spacing);
  void ring(Point centre, double radius, const Stroke& stroke);
  void disc(Point centre, double radius, Tint tint);

  /// UTF-8 on a base line.
  void text(const std::string& words, Point at, const Lettering& lettering);
  /// With its ink, not its base line, centred on the place.
  void centred_text(const std::string& words, Point at, const Lettering& lettering);

  /// `sprite` with its lower-left corner at `at`, each pixel `px_per_pixel` wide; smooth or with hard edges.
  void image(Sprite& sprite, Point lower_left, double px_per_pixel, bool smooth);

  [[nodiscard]] Result<std::string> png() const;

 private:
  struct Sheet;
  std::unique_ptr<Sheet> sheet_;
};

}  // namespace ivo::firmware
