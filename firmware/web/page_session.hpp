// A page's connection: protocol.md.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "firmware/web/page_check.hpp"
#include "firmware/web/session.hpp"

namespace ivo::firmware::web {

class Hub;

class PageSession final : public Session {
 public:
  static constexpr std::size_t kUnreadAnswers = 256;
  static constexpr std::size_t kUnreadRefusals = 64;  ///< of messages without form or order; more are only counted
  static constexpr Duration kStatusAtLeastEvery = std::chrono::milliseconds(450);
  static constexpr Duration kLayerEvery = std::chrono::milliseconds(200);  ///< at most; each of them

  /// `hub` outlives this.
  PageSession(Screen screen, const Paired& paired, Hub& hub);

  void hear(std::string_view message, bool binary, Instant now) override;
  [[nodiscard]] bool fresh(std::uint32_t seen, Instant now) const noexcept override {
    return liveness().is_new(seen, now) && liveness().beats(now);
  }
  // Its beats say so, and that somebody looks at it.
  void pinged(std::uint32_t /*number*/, Instant /*now*/) override {}
  void alive(std::uint32_t /*number*/, Instant /*now*/) override {}
  void answered(std::uint32_t number, Verdict verdict) override;
  [[nodiscard]] std::optional<Frame> next(Instant now) override;
  void written(Instant now) override;
  [[nodiscard]] bool overfull() const noexcept override { return answers_.size() > kUnreadAnswers; }

 private:
  [[nodiscard]] std::optional<std::string> next_document();
  [[nodiscard]] std::optional<std::string> next_layer(Instant now);

  Hub& hub_;
  PageCheck check_;
  std::deque<std::string> answers_;
  std::array<std::uint32_t, console::kDocuments> told_{};  // revisions
  std::array<std::uint64_t, kLayers> layers_told_{};
  std::array<std::optional<Instant>, kLayers> layers_told_at_{};
  std::uint64_t status_told_ = 0;
  Instant status_at_{};
  std::uint32_t statuses_ = 0;  // the number of the last
  bool writing_status_ = false;
};

}  // namespace ivo::firmware::web
