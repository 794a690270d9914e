// The only file that includes libpng.
#include "firmware/files/png_file.hpp"

#include <png.h>

#include <bit>
#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <memory>

#include "firmware/files/grey_image.hpp"

namespace ivo::firmware {
namespace {

static_assert(sizeof(Colour) == 3, "a row of colours is a row of the file");

enum class Target : std::uint8_t { kColours, kGrey };

struct Header {
  std::uint32_t width_px = 0;
  std::uint32_t height_px = 0;
  int bits = 0;
  bool colour = false;
  bool alpha = false;
};

// libpng reports errors by longjmp. So that no destructor is jumped over, each function with a setjmp holds plain
// values only; memory and the file belong to callers above it.
class Decoder {
 public:
  explicit Decoder(const std::string& path) : path_(path), file_(std::fopen(path.c_str(), "rbe")) {}
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;
  ~Decoder() {
    png_destroy_read_struct(&png_, &info_, nullptr);
    if (file_ != nullptr) {
      std::fclose(file_);
    }
  }

  Result<Header> open() {
    if (file_ == nullptr) {
      return Error{path_ + ": cannot be read: " + std::strerror(errno) + "; expected a PNG image"};
    }
    png_byte signature[8];
    if (std::fread(signature, 1, sizeof signature, file_) != sizeof signature ||
        png_sig_cmp(signature, 0, sizeof signature) != 0) {
      return Error{path_ + ": not a PNG; expected a PNG image"};
    }
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, &Decoder::on_error, &Decoder::on_warning);
    info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
    Header header;
    if (info_ == nullptr) {
      return Error{path_ + ": cannot be read: out of memory"};
    }
    if (!read_header(header)) {
      return damaged();
    }
    if (std::int64_t{header.width_px} * header.height_px > kMostPixels) {
      return Error{path_ + ": " + std::to_string(header.width_px) + " x " + std::to_string(header.height_px) +
                   " pixels are too many; expected at most " + std::to_string(kMostPixels)};
    }
    return header;
  }

  Result<void> read(Target target, std::vector<png_bytep>& rows, std::size_t row_bytes) {
    if (!read_rows(target, rows.data(), row_bytes)) {
      return damaged();
    }
    return {};
  }

 private:
  static void on_error(png_structp png, png_const_charp message) {
    auto* const self = static_cast<Decoder*>(png_get_error_ptr(png));
    std::snprintf(self->message_, sizeof self->message_, "%s", message);
    png_longjmp(png, 1);
  }
  static void on_warning(png_structp, png_const_charp) {}

  [[nodiscard]] Error damaged() const {
    return Error{path_ + ": cut short or damaged (" + message_ + "); expected a whole PNG image"};
  }

  bool read_header(Header& header) {
    if (setjmp(png_jmpbuf(png_)) != 0) {
      return false;
    }
    png_init_io(png_, file_);
    png_set_sig_bytes(png_, 8);
    png_read_info(png_, info_);
    header.width_px = png_get_image_width(png_, info_);
    header.height_px = png_get_image_height(png_, info_);
    header.bits = png_get_bit_depth(png_, info_);
    header.colour = (png_get_color_type(png_, info_) & PNG_COLOR_MASK_COLOR) != 0;
    header.alpha =
        (png_get_color_type(png_, info_) & PNG_COLOR_MASK_ALPHA) != 0 || png_get_valid(png_, info_, PNG_INFO_tRNS) != 0;
    return true;
  }

  bool read_rows(Target target, png_bytepp rows, std::size_t row_bytes) {
    if (setjmp(png_jmpbuf(png_)) != 0) {
      return false;
    }
    const int type = png_get_color_type(png_, info_);
    if (type == PNG_COLOR_TYPE_PALETTE) {
      png_set_palette_to_rgb(png_);
    }
    if (type == PNG_COLOR_TYPE_GRAY) {
      png_set_expand_gray_1_2_4_to_8(png_);
    }
    png_set_strip_alpha(png_);
    if (target == Target::kColours) {
      png_set_scale_16(png_);
      png_set_gray_to_rgb(png_);
    } else if (std::endian::native == std::endian::little) {
      png_set_swap(png_);
    }
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    if (png_get_rowbytes(png_, info_) != row_bytes) {
      png_error(png_, "unexpected kind of pixels");
    }
    png_read_image(png_, rows);
    png_read_end(png_, nullptr);
    return true;
  }

  const std::string& path_;
  std::FILE* file_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  char message_[128] = {};
};

/// Pointers for libpng, which starts at the top, into memory whose first row is the bottom one.
std::vector<png_bytep> rows_from_the_top(void* memory, std::size_t rows, std::size_t row_bytes) {
  auto* const bytes = static_cast<png_bytep>(memory);
  std::vector<png_bytep> pointers(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    pointers[i] = bytes + (rows - 1 - i) * row_bytes;
  }
  return pointers;
}

}  // namespace

Result<ColourImage> read_colours(const std::string& path) {
  Decoder decoder(path);
  const Result<Header> header = decoder.open();
  if (!header) {
    return header.error();
  }
  const std::size_t width = header.value().width_px;
  const std::size_t height = header.value().height_px;
  ColourImage image{static_cast<int>(width), static_cast<int>(height), header.value().alpha,
                    std::vector<Colour>(width * height)};
  std::vector<png_bytep> rows = rows_from_the_top(image.pixels.data(), height, width * sizeof(Colour));
  const Result<void> read = decoder.read(Target::kColours, rows, width * sizeof(Colour));
  if (!read) {
    return read.error();
  }
  return image;
}

Result<GreyImage> read_grey(const std::string& path) {
  Decoder decoder(path);
  const Result<Header> header = decoder.open();
  if (!header) {
    return header.error();
  }
  if (header.value().colour) {
    return Error{path + ": has colours; expected a grey PNG of 8 or 16 bits"};
  }
  const std::size_t width = header.value().width_px;
  const std::size_t height = header.value().height_px;
  GreyImage image{static_cast<int>(width), static_cast<int>(height), std::vector<std::uint16_t>(width * height)};
  if (header.value().bits == 16) {
    std::vector<png_bytep> rows = rows_from_the_top(image.values.data(), height, width * 2);
    const Result<void> read = decoder.read(Target::kGrey, rows, width * 2);
    if (!read) {
      return read.error();
    }
    return image;
  }
  std::vector<std::uint8_t> bytes(width * height);
  std::vector<png_bytep> rows = rows_from_the_top(bytes.data(), height, width);
  const Result<void> read = decoder.read(Target::kGrey, rows, width);
  if (!read) {
    return read.error();
  }
  image.values.assign(bytes.begin(), bytes.end());
  return image;
}

}  // namespace ivo::firmware
