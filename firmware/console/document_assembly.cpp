#include "firmware/console/document_assembly.hpp"

#include <cstddef>
#include <utility>

namespace ivo::firmware::console {
namespace {

bool possible(const DocumentPart& part) {
  // In 64 bits: a sum of the numbers must not come round to a small one.
  const std::uint64_t end = std::uint64_t{part.from} + part.count;
  return part.revision != 0 && part.zero == 0 && part.zero_too == 0 && part.whole <= kLargestDocument &&
         part.count <= DocumentPart::kBytes && end <= part.whole && (part.count > 0 || part.whole == 0);
}

}  // namespace

DocumentAssembly::Outcome DocumentAssembly::add(const DocumentPart& part) {
  const bool begins = part.from == 0;
  const bool follows = part.revision == revision_ && part.whole == whole_ && part.from == bytes_.size();
  if (!possible(part) || (!begins && !follows)) {
    *this = {};
    return Outcome::kRefused;
  }
  if (begins) {
    revision_ = part.revision;
    whole_ = part.whole;
    bytes_.clear();  // room grows with what comes, not with what is announced
  }
  for (std::size_t i = 0; i < part.count; ++i) {
    bytes_.push_back(static_cast<char>(part.bytes[i]));
  }
  return bytes_.size() == whole_ ? Outcome::kWhole : Outcome::kMore;
}

std::string DocumentAssembly::take() {
  std::string bytes = std::move(bytes_);
  *this = {};
  return bytes;
}

}  // namespace ivo::firmware::console
