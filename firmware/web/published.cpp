#include "firmware/web/published.hpp"

#include <cstddef>

#include "firmware/files/json_value.hpp"
#include "firmware/web/status_json.hpp"

namespace ivo::firmware::web {
namespace {

bool is_grid(console::Document document) {
  return document == console::Document::kMap || document == console::Document::kAerial ||
         document == console::Document::kProbability || document == console::Document::kSearched;
}

std::string message_of(console::Document document, const KnownDocument& known) {
  const std::string_view name = name_of(document);
  if (is_grid(document)) {
    return known.there() ? grid_text(name, known.revision) : "";
  }
  // It becomes a part of a message of ours: what is no JSON would spoil it.
  const bool right = known.there() && parse_json(*known.bytes, std::string(name), "JSON").ok();
  return document_text(name, known.revision, right ? std::string_view(*known.bytes) : "");
}

}  // namespace

std::string_view name_of(console::Document document) noexcept {
  static constexpr std::array<std::string_view, console::kDocuments> kNames{
      "mission", "map", "aerial", "probability", "searched", "plan", "previous_plan", "areas", "notice", "report"};
  return kNames[static_cast<std::size_t>(document) - 1];
}

void Published::update(const View& view) {
  for (std::size_t i = 0; i < messages_.size(); ++i) {
    const KnownDocument& known = view.documents[i];
    if (messages_[i].revision != known.revision) {
      messages_[i] = {
          .revision = known.revision,
          .text = std::make_shared<const std::string>(message_of(static_cast<console::Document>(i + 1), known))};
    }
  }
}

}  // namespace ivo::firmware::web
