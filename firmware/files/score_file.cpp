#include "firmware/files/score_file.hpp"

#include <utility>

namespace ivo::firmware {

std::string score_json(const ScoreFile& file) {
  constexpr int kFormat = 1;
  Json agents = Json::list();
  for (const ScoredAgent& agent : file.agents) {
    agents.elements.push_back({{"name", agent.name},
                               {"kind", kAgentKindWords[static_cast<std::size_t>(agent.kind)]},
                               {"length_m", agent.length_m},
                               {"duration_s", agent.duration_s},
                               {"given_length_m", agent.given_length_m},
                               {"preferred_share", json_or_null(agent.preferred_share)}});
  }
  return json_text({{"format", kFormat},
                    {"mission", file.mission},
                    {"map", file.map},
                    {"plan", file.plan},
                    {"cell_m", file.cell_m},
                    {"unobservable_share", file.unobservable_share},
                    {"score", json_of(file.score)},
                    {"bounds", json_of(file.bounds)},
                    {"gap", json_or_null(file.bounds.gap)},
                    {"agents", std::move(agents)}});
}

}  // namespace ivo::firmware
