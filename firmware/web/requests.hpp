// Who may do what: judges what is asked for, tells it to the controller, and says what became of it.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "config/base/time.hpp"
#include "firmware/web/controller_link.hpp"
#include "firmware/web/controls.hpp"
#include "firmware/web/page_check.hpp"
#include "firmware/web/refusals.hpp"
#include "firmware/web/request.hpp"
#include "firmware/web/verdict.hpp"

namespace ivo::firmware::web {

struct Asker {
  Screen screen = 0;
  std::string owner;
  bool may_operate = false;
  bool fresh = false;  ///< its link, as liveness.hpp has it
};

/// The verdict of what was asked under a number of that screen.
struct Settled {
  Screen screen = 0;
  std::uint32_t number = 0;
  Verdict verdict{};
};

class Requests {
 public:
  static constexpr Duration kPatience = std::chrono::seconds(3);  ///< with the controller's answer
  static constexpr int kBeatsPerSecond = 10;
  /// Of what those without the controls may say of places and finds, all together: the controller hears a hundred
  /// messages a second, and the operator's are among them.
  static constexpr int kOthersPerSecond = 60;

  /// They outlive this.
  Requests(ControllerLink& link, Controls& controls, Refusals& refusals)
      : link_(link), controls_(controls), refusals_(refusals) {}

  /// The verdict, or none: it comes out of settled(). Refusals are counted.
  [[nodiscard]] std::optional<Verdict> ask(const Asker& asker, std::uint32_t number, const Request& request,
                                           Instant now);
  /// After each turn of the link.
  [[nodiscard]] std::vector<Settled> settled(Instant now);

 private:
  struct Pending {
    Screen screen = 0;
    std::uint32_t number = 0;
    Instant since{};
  };

  [[nodiscard]] std::optional<Verdict> judge(const Asker& asker, const Request& request, Instant now);
  [[nodiscard]] Verdict control(const Asker& asker, const Request& request, Instant now);
  [[nodiscard]] bool there() const noexcept;

  ControllerLink& link_;
  Controls& controls_;
  Refusals& refusals_;
  RateLimit beats_{kBeatsPerSecond};
  RateLimit others_{kOthersPerSecond};
  std::map<std::uint32_t, Pending> pending_;  // by the controller's number
};

}  // namespace ivo::firmware::web
