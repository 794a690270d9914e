#include "firmware/web/page_session.hpp"

#include <utility>
#include <variant>

#include "firmware/web/hub.hpp"

namespace ivo::firmware::web {

PageSession::PageSession(Screen screen, const Paired& paired, Hub& hub) : Session(screen, paired), hub_(hub) {
  answers_.push_back(hello_text(screen, paired.name, paired.role == Role::kOperator));
}

void PageSession::hear(std::string_view message, bool binary, Instant now) {
  PageMessage heard = check_.judge(message, now);
  if (binary) {
    heard.verdict = Verdict::kMalformed;
  }
  if (heard.verdict != Verdict::kAccepted) {
    hub_.refusals().count(heard.verdict);
    if (answers_.size() < kUnreadRefusals) {
      answered(heard.sequence, heard.verdict);
    }
    return;
  }
  if (const auto* const beat = std::get_if<Beat>(&heard.request)) {
    (void)liveness().beat(beat->seen, now);
  }
  if (const std::optional<Verdict> verdict = hub_.ask(*this, heard.sequence, heard.request, now)) {
    answered(heard.sequence, *verdict);
  }
}

void PageSession::answered(std::uint32_t number, Verdict verdict) { answers_.push_back(answer_text(number, verdict)); }

std::optional<Frame> PageSession::next(Instant now) {
  writing_status_ = false;
  if (!answers_.empty()) {
    Frame frame{.bytes = std::move(answers_.front()), .binary = false};
    answers_.pop_front();
    return frame;
  }
  const Hub::Status& status = hub_.status();
  const bool due = now - status_at_ >= Hub::kStatusEvery && status.number != status_told_;
  if (status.composed > 0 && (due || now - status_at_ >= kStatusAtLeastEvery)) {
    status_told_ = status.number;
    status_at_ = now;
    writing_status_ = true;
    return Frame{.bytes = status_text(status.common, liveness().beats(now), ++statuses_), .binary = false};
  }
  std::optional<std::string> more = next_document();
  if (!more) {
    more = next_layer(now);
  }
  return more ? std::optional(Frame{.bytes = std::move(*more), .binary = false}) : std::nullopt;
}

std::optional<std::string> PageSession::next_document() {
  const auto& messages = hub_.published().messages();
  for (std::size_t i = 0; i < messages.size(); ++i) {
    if (messages[i].revision != told_[i]) {
      told_[i] = messages[i].revision;
      if (!messages[i].text->empty()) {
        return *messages[i].text;
      }
    }
  }
  return std::nullopt;
}

std::optional<std::string> PageSession::next_layer(Instant now) {
  const auto& layers = hub_.layers();
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const bool due = !layers_told_at_[i] || now - *layers_told_at_[i] >= kLayerEvery;
    if (due && layers[i].number != layers_told_[i]) {
      layers_told_[i] = layers[i].number;
      layers_told_at_[i] = now;
      return layer_text(layers[i].layer, now);
    }
  }
  return std::nullopt;
}

void PageSession::written(Instant now) {
  if (writing_status_) {
    liveness().told(statuses_, now);
  }
}

}  // namespace ivo::firmware::web
