// Any bytes as messages of a page: what is accepted is right in every field, in order, once, and not too often.
#include <chrono>
#include <cmath>
#include <string>
#include <variant>

#include "firmware/web/page_check.hpp"
#include "tests/fuzz/input.hpp"

namespace {

using namespace ivo::firmware;
using ivo::fuzz::require;

/// Any bytes, or a message of which nothing or one byte is wrong.
std::string message(ivo::fuzz::Input& input, std::uint32_t next) {
  static constexpr const char* kRests[] = {
      R"("do":"beat"})",
      R"("do":"stop"})",
      R"("do":"replan","areas_revision":7})",
      R"("do":"start","question":1})",
      R"("do":"position","agent":1,"x_m":1.5,"y_m":2})",
      R"("do":"area.put","slot":3,"purpose":"no_go","agent":null,"polygon_m":[[0,0],[1,0],[1,1]]})",
      R"("do":"area.remove","slot":3})",
      R"("do":"control.request"})",
  };
  std::string text;
  if (input.up_to(3) == 0) {
    for (unsigned left = input.up_to(200); left > 0 && !input.empty(); --left) {
      text += static_cast<char>(input.byte());
    }
    return text;
  }
  text = "{\"seq\":" + std::to_string(input.up_to(5) == 0 ? input.take<std::uint32_t>() : next) + "," +
         kRests[input.up_to(7)];
  if (input.up_to(2) == 0) {
    text[input.byte() % text.size()] = static_cast<char>(input.byte());
  }
  return text;
}

void judge_fields(const web::Request& request) {
  if (const auto* const area = std::get_if<web::PutArea>(&request)) {
    require(area->slot < console::kAreaSlots && area->purpose <= console::AreaPurpose::kNoGo, "an area is one of ours");
    require(area->polygon.size() >= 3 && area->polygon.size() <= console::kAreaCorners, "an area has corners");
    require(area->agent < console::kAgents || area->agent == console::AreaCommand::kEverybody, "an area is somebody's");
    for (const ivo::Point& corner : area->polygon) {
      require(std::isfinite(corner.x_m) && std::isfinite(corner.y_m), "corners are numbers");
    }
  }
  if (const auto* const position = std::get_if<web::Position>(&request)) {
    require(
        position->agent < console::kAgents && std::isfinite(position->pose.x_m) && std::isfinite(position->pose.y_m),
        "a position is one");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ivo::fuzz::Input input(data, size);
  web::PageCheck check;
  ivo::Instant now{std::chrono::seconds(1)};
  std::uint32_t last = 0;
  int accepted = 0;  // but for stops
  const ivo::Instant begin = now;
  while (!input.empty()) {
    now += std::chrono::milliseconds(input.byte() / 8);
    const std::string text = message(input, last + 1);
    const web::PageMessage heard = check.judge(text, now);
    last += heard.sequence == last + 1 ? 1 : 0;
    if (heard.verdict != web::Verdict::kAccepted) {
      continue;
    }
    require(heard.sequence == last, "only the next is accepted");
    require(check.judge(text, now).verdict != web::Verdict::kAccepted, "nothing is accepted twice");
    judge_fields(heard.request);
    accepted += std::holds_alternative<web::Stop>(heard.request) ? 0 : 1;
    require(accepted <= web::PageCheck::kPerSecond * (1.0 + ivo::seconds(now - begin)), "no more than the rate");
  }
  return 0;
}
