// Brings all together: the controller, the screens, and what is between them. One thread; time is handed in.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "config/base/time.hpp"
#include "firmware/web/controller_link.hpp"
#include "firmware/web/controls.hpp"
#include "firmware/web/layer.hpp"
#include "firmware/web/published.hpp"
#include "firmware/web/refusals.hpp"
#include "firmware/web/requests.hpp"
#include "firmware/web/session.hpp"
#include "firmware/web/status_json.hpp"

namespace ivo::firmware::web {

class Hub {
 public:
  static constexpr Duration kStatusEvery =
      std::chrono::milliseconds(45);  ///< at most 20 times a second, at 10 ms steps

  /// `said` takes one line for a person who watches the server.
  Hub(std::string socket, std::function<void(const std::string&)> said)
      : link_(std::move(socket)), said_(std::move(said)) {}
  Hub(const Hub&) = delete;
  Hub& operator=(const Hub&) = delete;

  /// A page, or a ROS client.
  Session& came(const Paired& paired, bool ros, Instant now);
  void went(Screen screen, Instant now);
  /// Every few milliseconds.
  void turn(Instant now);

  [[nodiscard]] const View& view() const noexcept { return link_.view(); }
  [[nodiscard]] Refusals& refusals() noexcept { return refusals_; }
  [[nodiscard]] const Published& published() const noexcept { return published_; }
  [[nodiscard]] const std::string& complaint() const noexcept { return link_.complaint(); }
  [[nodiscard]] std::optional<Screen> operator_screen() const noexcept { return controls_.holder(); }

  // For who asks over HTTP.
  /// Whose screen holds the controls asks for that, without hearing an answer; the verdict, or none: it is on its way.
  [[nodiscard]] std::optional<Verdict> ask(const Paired& paired, const Request& request, Instant now);

  // For sessions.
  /// The verdict, or none: answered() tells it.
  [[nodiscard]] std::optional<Verdict> ask(const Session& session, std::uint32_t number, const Request& request,
                                           Instant now);
  void show(const Layer& layer);
  struct Status {
    std::string common;          ///< as status_json.hpp has it
    std::uint64_t number = 0;    ///< of what is new in it: another number, another status
    std::uint64_t composed = 0;  ///< grows with each text
  };
  [[nodiscard]] const Status& status() const noexcept { return status_; }
  struct ShownLayer {
    std::uint64_t number = 0;  ///< 0: never shown
    Layer layer;
  };
  [[nodiscard]] const std::array<ShownLayer, kLayers>& layers() const noexcept { return layers_; }

 private:
  /// What a page is told of at once.
  struct Seen {
    std::uint64_t statuses = 0;
    LinkState link{};
    std::optional<Screen> holder;
    std::optional<Screen> requester;
    std::uint64_t screens = 0;
    Refusals refusals;
    friend bool operator==(const Seen&, const Seen&) = default;
  };

  void compose(Instant now);
  void say_what_changed();

  ControllerLink link_;
  std::function<void(const std::string&)> said_;
  LinkState said_link_ = LinkState::kAbsent;
  std::optional<Screen> said_holder_;
  Controls controls_;
  Refusals refusals_;
  Requests requests_{link_, controls_, refusals_};
  Published published_;
  std::map<Screen, std::unique_ptr<Session>> sessions_;
  std::map<Screen, bool> ros_;
  Screen last_screen_ = 0;
  std::uint64_t changes_of_screens_ = 0;
  Status status_;
  Seen seen_;
  Instant composed_at_{};
  std::array<ShownLayer, kLayers> layers_;
};

}  // namespace ivo::firmware::web
