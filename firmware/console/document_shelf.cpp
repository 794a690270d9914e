#include "firmware/console/document_shelf.hpp"

#include <utility>

namespace ivo::firmware::console {

bool DocumentShelf::put(Document document, std::string bytes) {
  if (bytes.size() > kLargestDocument) {
    return false;
  }
  auto made = std::make_shared<const std::string>(std::move(bytes));
  const std::lock_guard lock(mutex_);
  Copy& copy = copies_[place_of(document)];
  if (copy.revision > 0 && *copy.bytes == *made) {
    return true;
  }
  copy = {copy.revision + 1, std::move(made)};
  return true;
}

DocumentShelf::Copy DocumentShelf::at(Document document) const {
  const std::lock_guard lock(mutex_);
  return copies_[place_of(document)];
}

std::uint32_t DocumentShelf::revision(Document document) const {
  const std::lock_guard lock(mutex_);
  return copies_[place_of(document)].revision;
}

}  // namespace ivo::firmware::console
