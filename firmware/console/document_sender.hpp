// Documents on their way to one client, a part at a time: the next that it does not have in its newest form.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "firmware/console/console_messages.hpp"
#include "firmware/console/document_shelf.hpp"

namespace ivo::firmware::console {

class DocumentSender {
 public:
  /// The part to be sent now, without sequence; none: the client has all. The same until sent() says that it left. A
  /// document that changes meanwhile is begun anew.
  [[nodiscard]] const DocumentPart* next(const DocumentShelf& shelf);
  void sent();

 private:
  [[nodiscard]] bool find(const DocumentShelf& shelf);

  std::array<std::uint32_t, kDocuments> had_{};  // revisions
  std::size_t next_ = 0;              // place of whose turn it is: one that changes often is not always first
  std::optional<Document> document_;  // under way
  DocumentShelf::Copy copy_;
  std::uint32_t from_ = 0;
  DocumentPart part_;
  bool made_ = false;
};

}  // namespace ivo::firmware::console
