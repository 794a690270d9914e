// PNG files of any kind for tests of reading them.
#pragma once

#include <png.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace ivo::firmware {

struct PngKind {
  int bits = 8;
  int type = PNG_COLOR_TYPE_RGB;
  int interlace = PNG_INTERLACE_NONE;
  std::vector<png_color> palette = {};
};

/// `bytes`: the rows as the file has them, the top one first, each padded to a whole byte.
inline std::string written_png(std::uint32_t width, std::uint32_t height, const PngKind& kind,
                               std::vector<std::uint8_t> bytes) {
  std::string file;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &file,
      [](png_structp p, png_bytep data, std::size_t length) {
        static_cast<std::string*>(png_get_io_ptr(p))->append(reinterpret_cast<const char*>(data), length);
      },
      nullptr);
  png_set_IHDR(png, info, width, height, kind.bits, kind.type, kind.interlace, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  if (!kind.palette.empty()) {
    png_set_PLTE(png, info, kind.palette.data(), static_cast<int>(kind.palette.size()));
  }
  png_write_info(png, info);
  std::vector<png_bytep> rows;
  for (std::size_t i = 0; i < height; ++i) {
    rows.push_back(bytes.data() + i * (bytes.size() / height));
  }
  png_write_image(png, rows.data());
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return file;
}

}  // namespace ivo::firmware
