#include "firmware/web/document_assembly.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace ivo::firmware::web {
namespace {

using Outcome = DocumentAssembly::Outcome;

console::DocumentPart part_of(const std::string& whole, std::size_t from, std::size_t count,
                              std::uint32_t revision = 1) {
  console::DocumentPart part;
  part.revision = revision;
  part.whole = static_cast<std::uint32_t>(whole.size());
  part.from = static_cast<std::uint32_t>(from);
  part.count = static_cast<std::uint32_t>(count);
  std::transform(whole.begin() + static_cast<std::ptrdiff_t>(from),
                 whole.begin() + static_cast<std::ptrdiff_t>(from + count), part.bytes.begin(),
                 [](char c) { return static_cast<std::byte>(c); });
  return part;
}

TEST(DocumentAssembly, PutsPartsTogether) {
  DocumentAssembly assembly;
  const std::string text(20'000, 'x');
  EXPECT_EQ(assembly.add(part_of(text, 0, 8192)), Outcome::kMore);
  EXPECT_EQ(assembly.add(part_of(text, 8192, 8192)), Outcome::kMore);
  EXPECT_EQ(assembly.add(part_of(text, 16'384, 20'000 - 16'384)), Outcome::kWhole);
  EXPECT_EQ(assembly.take(), text);
}

TEST(DocumentAssembly, KnowsAnEmptyDocument) {
  DocumentAssembly assembly;
  EXPECT_EQ(assembly.add(part_of("", 0, 0)), Outcome::kWhole);
  EXPECT_EQ(assembly.take(), "");
}

TEST(DocumentAssembly, BeginsAnewWithAnotherRevision) {
  DocumentAssembly assembly;
  EXPECT_EQ(assembly.add(part_of("abcdef", 0, 3, 1)), Outcome::kMore);
  EXPECT_EQ(assembly.add(part_of("ABCDEF", 0, 3, 2)), Outcome::kMore);
  EXPECT_EQ(assembly.add(part_of("ABCDEF", 3, 3, 2)), Outcome::kWhole);
  EXPECT_EQ(assembly.take(), "ABCDEF");
}

TEST(DocumentAssembly, RefusesAPartThatCannotFollow) {
  const std::string text = "abcdef";
  const console::DocumentPart second = part_of(text, 3, 3);
  const auto after_the_first = [&](auto change) {
    DocumentAssembly assembly;
    EXPECT_EQ(assembly.add(part_of(text, 0, 3)), Outcome::kMore);
    console::DocumentPart part = second;
    change(part);
    return assembly.add(part);
  };
  EXPECT_EQ(after_the_first([](auto&) {}), Outcome::kWhole);
  EXPECT_EQ(after_the_first([](auto& part) { part.revision = 2; }), Outcome::kRefused);
  EXPECT_EQ(after_the_first([](auto& part) { part.revision = 0; }), Outcome::kRefused);
  EXPECT_EQ(after_the_first([](auto& part) { part.whole = 7; }), Outcome::kRefused);
  EXPECT_EQ(after_the_first([](auto& part) { part.from = 2; }), Outcome::kRefused);
  EXPECT_EQ(after_the_first([](auto& part) { part.from = 4; }), Outcome::kRefused);
  EXPECT_EQ(after_the_first([](auto& part) { part.count = 4; }), Outcome::kRefused);
  EXPECT_EQ(after_the_first([](auto& part) { part.count = 0; }), Outcome::kRefused);
  EXPECT_EQ(after_the_first([](auto& part) { part.count = 0xFFFFFFFFU; }), Outcome::kRefused);
  EXPECT_EQ(after_the_first([](auto& part) { part.zero = 1; }), Outcome::kRefused);
  EXPECT_EQ(after_the_first([](auto& part) { part.zero_too = 1; }), Outcome::kRefused);
  DocumentAssembly assembly;
  EXPECT_EQ(assembly.add(second), Outcome::kRefused);
}

TEST(DocumentAssembly, RefusesWhatIsTooLargeAtOnce) {
  DocumentAssembly assembly;
  console::DocumentPart part = part_of("abc", 0, 3);
  part.whole = console::kLargestDocument + 1;
  EXPECT_EQ(assembly.add(part), Outcome::kRefused);
}

}  // namespace
}  // namespace ivo::firmware::web
