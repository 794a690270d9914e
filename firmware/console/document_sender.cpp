#include "firmware/console/document_sender.hpp"

#include <algorithm>
#include <cstring>

namespace ivo::firmware::console {

const DocumentPart* DocumentSender::next(const DocumentShelf& shelf) {
  if (document_ && shelf.revision(*document_) != copy_.revision) {
    document_.reset();
    made_ = false;
  }
  if (!document_ && !find(shelf)) {
    return nullptr;
  }
  if (!made_) {
    const auto whole = static_cast<std::uint32_t>(copy_.bytes->size());
    const auto count = std::min<std::uint32_t>(DocumentPart::kBytes, whole - from_);
    part_ = {};
    part_.header = {.kind = Kind::kDocumentPart, .size = sizeof(DocumentPart)};
    part_.document = *document_;
    part_.revision = copy_.revision;
    part_.whole = whole;
    part_.from = from_;
    part_.count = count;
    std::memcpy(part_.bytes.data(), copy_.bytes->data() + from_, count);
    made_ = true;
  }
  return &part_;
}

void DocumentSender::sent() {
  made_ = false;
  from_ += part_.count;
  if (from_ == part_.whole) {
    had_[place_of(*document_)] = copy_.revision;
    next_ = place_of(*document_) + 1;
    document_.reset();
    copy_ = {};
  }
}

bool DocumentSender::find(const DocumentShelf& shelf) {
  for (std::size_t i = 0; i < had_.size(); ++i) {
    const std::size_t place = (next_ + i) % had_.size();
    const auto document = static_cast<Document>(place + 1);
    if (shelf.revision(document) != had_[place]) {
      document_ = document;
      copy_ = shelf.at(document);
      from_ = 0;
      return true;
    }
  }
  return false;
}

}  // namespace ivo::firmware::console
