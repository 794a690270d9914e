// The server's end of the controller's socket: never waits for it, and knows what it said last when it is gone.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "config/base/time.hpp"
#include "firmware/console/console_messages.hpp"
#include "firmware/console/document_assembly.hpp"
#include "firmware/web/request.hpp"
#include "firmware/web/view.hpp"
#include "hal/api/file_descriptor.hpp"

namespace ivo::firmware::web {

class ControllerLink {
 public:
  static constexpr Duration kTryAgain = std::chrono::milliseconds(250);
  static constexpr Duration kSilence = std::chrono::seconds(1);
  /// As the controller names it.
  struct Heard {
    std::uint32_t of_sequence = 0;
    console::Verdict verdict{};
  };

  explicit ControllerLink(std::string path) : path_(std::move(path)) {}

  /// Connects when that is due and reads what has come. Cost: at most kPackets packets.
  void turn(Instant now);
  [[nodiscard]] const View& view() const noexcept { return view_; }
  /// Says it now; the number that its answer will have, or none: nobody is there to hear it, or it is not for him.
  [[nodiscard]] std::optional<std::uint32_t> say(const Request& request, Instant now);
  /// The answers that came since it was asked last. Numbers begin anew when view().connections changes.
  [[nodiscard]] std::vector<Heard> answers() { return std::exchange(answers_, {}); }
  /// Why there is no connection, for a person; empty while there is one.
  [[nodiscard]] const std::string& complaint() const noexcept { return complaint_; }

 private:
  static constexpr int kPackets = 256;

  void connect(Instant now);
  void disconnect(std::string why, Instant now);
  /// False: the controller does not speak as this program does.
  [[nodiscard]] bool hear(std::span<const std::byte> packet);
  void forget_what_did_not_come();
  [[nodiscard]] bool hear_part(std::span<const std::byte> packet);

  std::string path_;
  hal::FileDescriptor socket_;
  std::uint32_t said_ = 0;
  Instant try_at_{};
  View view_;
  std::array<console::DocumentAssembly, console::kDocuments> parts_;
  std::array<bool, console::kDocuments> came_{};  // over this connection
  bool known_anew_ = false;                       // a status has come over this connection
  bool out_of_step_ = false;                      // nothing that is said over it will count any more
  std::uint32_t revisions_ = 0;
  std::vector<Heard> answers_;
  std::string complaint_;
};

}  // namespace ivo::firmware::web
