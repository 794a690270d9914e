#include "firmware/files/png_file.hpp"

#include <gtest/gtest.h>

#include "firmware/files/grey_image.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/firmware/files/written_png.hpp"

namespace ivo::firmware {
namespace {

constexpr Colour kRed{255, 0, 0};
constexpr Colour kGreen{0, 255, 0};
constexpr Colour kBlue{0, 0, 255};
constexpr Colour kGrey{7, 7, 7};

const std::vector<std::uint8_t> kTwoByTwo = {255, 0, 0, 0, 255, 0, /**/ 0, 0, 255, 7, 7, 7};
const std::vector<Colour> kTwoByTwoFromTheBottom = {kBlue, kGrey, kRed, kGreen};

std::vector<Colour> colours_of(const std::string& png) {
  const ScratchFolder folder;
  const Result<ColourImage> image = read_colours(folder.put("a.png", png));
  EXPECT_TRUE(image.ok()) << image.error().message;
  return image.ok() ? image.value().pixels : std::vector<Colour>{};
}

TEST(PngFile, PutsTheBottomRowFirst) {
  const ScratchFolder folder;
  const auto image = read_colours(folder.put("a.png", written_png(1, 2, {}, {255, 0, 0, 0, 255, 0})));
  ASSERT_TRUE(image.ok()) << image.error().message;
  EXPECT_EQ(image.value().width_px, 1);
  EXPECT_EQ(image.value().height_px, 2);
  EXPECT_EQ(image.value().pixels, (std::vector<Colour>{kGreen, kRed}));
}

TEST(PngFile, ReadsPlainAndInterlacedColours) {
  EXPECT_EQ(colours_of(written_png(2, 2, {}, kTwoByTwo)), kTwoByTwoFromTheBottom);
  EXPECT_EQ(colours_of(written_png(2, 2, {8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_ADAM7}, kTwoByTwo)),
            kTwoByTwoFromTheBottom);
}

TEST(PngFile, ReadsPalettesOfEightAndOfTwoBits) {
  const std::vector<png_color> palette = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {7, 7, 7}};
  const PngKind eight = {8, PNG_COLOR_TYPE_PALETTE, PNG_INTERLACE_NONE, palette};
  const PngKind two = {2, PNG_COLOR_TYPE_PALETTE, PNG_INTERLACE_NONE, palette};
  EXPECT_EQ(colours_of(written_png(2, 2, eight, {0, 1, 2, 3})), kTwoByTwoFromTheBottom);
  EXPECT_EQ(colours_of(written_png(2, 2, two, {0b00'01'0000, 0b10'11'0000})), kTwoByTwoFromTheBottom);
}

TEST(PngFile, IgnoresTheAlphaChannelOfColours) {
  const PngKind alpha = {8, PNG_COLOR_TYPE_RGBA};
  EXPECT_EQ(colours_of(written_png(1, 2, alpha, {255, 0, 0, 0, 0, 0, 255, 9})), (std::vector<Colour>{kBlue, kRed}));
}

TEST(PngFile, ReadsGreyAsColoursAndScalesSixteenBits) {
  EXPECT_EQ(colours_of(written_png(1, 1, {8, PNG_COLOR_TYPE_GRAY}, {7})), std::vector<Colour>{kGrey});
  EXPECT_EQ(colours_of(written_png(1, 1, {1, PNG_COLOR_TYPE_GRAY}, {0x80})),
            std::vector<Colour>{(Colour{255, 255, 255})});
  EXPECT_EQ(colours_of(written_png(1, 1, {16, PNG_COLOR_TYPE_RGB}, {0xff, 0xff, 0, 0, 0, 0})),
            std::vector<Colour>{kRed});
}

TEST(PngFile, NamesAFileThatIsMissingOrNoPng) {
  const ScratchFolder folder;
  EXPECT_EQ(read_colours(folder.path("a.png")).error().message,
            folder.path("a.png") + ": cannot be read: No such file or directory; expected a PNG image");
  EXPECT_EQ(read_colours(folder.put("b.png", "GIF89a, really")).error().message,
            folder.path("b.png") + ": not a PNG; expected a PNG image");
  EXPECT_EQ(read_colours(folder.put("c.png", "")).error().message,
            folder.path("c.png") + ": not a PNG; expected a PNG image");
  EXPECT_FALSE(read_colours(folder.path()).ok());
}

TEST(PngFile, RefusesEveryCutOfAFile) {
  const ScratchFolder folder;
  const std::string whole = written_png(2, 2, {}, kTwoByTwo);
  for (std::size_t length = 8; length + 1 < whole.size(); ++length) {
    const auto image = read_colours(folder.put("a.png", whole.substr(0, length)));
    ASSERT_FALSE(image.ok()) << length << " of " << whole.size() << " bytes";
    EXPECT_EQ(image.error().message.find(folder.path("a.png") + ": cut short or damaged ("), 0U)
        << image.error().message;
  }
}

TEST(PngFile, RefusesDamagedPixels) {
  const ScratchFolder folder;
  std::string png = written_png(2, 2, {}, kTwoByTwo);
  png[png.size() - 20] = static_cast<char>(png[png.size() - 20] ^ 0x55);
  EXPECT_FALSE(read_colours(folder.put("a.png", png)).ok());
}

TEST(PngFile, RefusesMorePixelsThanFitBeforeTakingMemory) {
  const ScratchFolder folder;
  std::string png = written_png(8001, 8000, {1, PNG_COLOR_TYPE_GRAY}, std::vector<std::uint8_t>(1001 * 8000));
  EXPECT_EQ(read_colours(folder.put("a.png", png)).error().message,
            folder.path("a.png") + ": 8001 x 8000 pixels are too many; expected at most 64000000");
}

TEST(GreyImage, KeepsValuesOfEightAndSixteenBits) {
  const ScratchFolder folder;
  const auto eight = read_grey(folder.put("8.png", written_png(2, 2, {8, PNG_COLOR_TYPE_GRAY}, {1, 2, 3, 255})));
  ASSERT_TRUE(eight.ok()) << eight.error().message;
  EXPECT_EQ(eight.value().values, (std::vector<std::uint16_t>{3, 255, 1, 2}));
  const auto sixteen =
      read_grey(folder.put("16.png", written_png(1, 2, {16, PNG_COLOR_TYPE_GRAY}, {0x12, 0x34, 0xff, 0xff})));
  ASSERT_TRUE(sixteen.ok()) << sixteen.error().message;
  EXPECT_EQ(sixteen.value().values, (std::vector<std::uint16_t>{65535, 0x1234}));
}

TEST(GreyImage, WidensFewBitsAndIgnoresAlpha) {
  const ScratchFolder folder;
  const auto one = read_grey(folder.put("1.png", written_png(2, 1, {1, PNG_COLOR_TYPE_GRAY}, {0b0100'0000})));
  ASSERT_TRUE(one.ok()) << one.error().message;
  EXPECT_EQ(one.value().values, (std::vector<std::uint16_t>{0, 255}));
  const auto alpha = read_grey(folder.put("a.png", written_png(1, 1, {8, PNG_COLOR_TYPE_GRAY_ALPHA}, {9, 0})));
  ASSERT_TRUE(alpha.ok()) << alpha.error().message;
  EXPECT_EQ(alpha.value().values, std::vector<std::uint16_t>{9});
}

TEST(GreyImage, RefusesColours) {
  const ScratchFolder folder;
  EXPECT_EQ(read_grey(folder.put("a.png", written_png(2, 2, {}, kTwoByTwo))).error().message,
            folder.path("a.png") + ": has colours; expected a grey PNG of 8 or 16 bits");
}

}  // namespace
}  // namespace ivo::firmware
