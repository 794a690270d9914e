#include "firmware/tools/resume/logged_run.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

#include "firmware/files/json_value.hpp"
#include "firmware/files/text_file.hpp"

namespace ivo::firmware {
namespace {

std::optional<LoggedStep::Kind> kind_of(std::string_view event) {
  if (event == "position") {
    return LoggedStep::Kind::kPosition;
  }
  if (event == "search started") {
    return LoggedStep::Kind::kSetOff;
  }
  if (event == "found") {
    return LoggedStep::Kind::kFound;
  }
  if (event == "paths ended") {
    return LoggedStep::Kind::kPathsEnded;
  }
  return std::nullopt;
}

struct Line {
  double t_s = 0.0;
  std::optional<LoggedStep> step;  // none: it does not move the search
};

// None when it is no event of these agents.
std::optional<Line> parse(std::string_view text, const std::vector<std::string>& agents) {
  const Result<Json> json = parse_json(text, "", "an event");
  if (!json) {
    return std::nullopt;
  }
  const Json* const t = json.value().member("t_s");
  const Json* const event = json.value().member("event");
  if (t == nullptr || !t->is_number() || event == nullptr || event->kind != Json::Kind::kText) {
    return std::nullopt;
  }
  Line line{.t_s = t->real, .step = {}};
  const std::optional<LoggedStep::Kind> kind = kind_of(event->text);
  if (!kind) {
    return line;
  }
  LoggedStep step{.kind = *kind, .t_s = t->real, .agent = 0, .at = {}};
  if (*kind == LoggedStep::Kind::kPosition || *kind == LoggedStep::Kind::kFound) {
    const Json* const name = json.value().member("agent");
    const Json* const x = json.value().member("x_m");
    const Json* const y = json.value().member("y_m");
    const auto agent = name == nullptr ? agents.end() : std::find(agents.begin(), agents.end(), name->text);
    if (agent == agents.end() || x == nullptr || !x->is_number() || y == nullptr || !y->is_number()) {
      return std::nullopt;
    }
    step.agent = static_cast<std::size_t>(agent - agents.begin());
    step.at = {x->real, y->real};
  }
  line.step = step;
  return line;
}

}  // namespace

Result<LoggedRun> read_logged_run(const std::string& path, const std::vector<std::string>& agents) {
  const Result<std::string> contents = read_file(path);
  if (!contents) {
    return contents.error();
  }
  LoggedRun run;
  run.tracks.resize(agents.size());
  const std::string_view text = contents.value();
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n', run.whole_bytes)) {
    const std::optional<Line> line = parse(text.substr(run.whole_bytes, end - run.whole_bytes), agents);
    run.whole_bytes = end + 1;
    if (!line) {
      ++run.unreadable;
      continue;
    }
    run.last_s = std::max(run.last_s, line->t_s);
    if (!line->step) {
      continue;
    }
    if (line->step->kind == LoggedStep::Kind::kPosition) {
      run.tracks[line->step->agent].push_back(line->step->at);
    }
    run.steps.push_back(*line->step);
  }
  return run;
}

}  // namespace ivo::firmware
