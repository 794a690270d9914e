#include "firmware/files/score_document.hpp"

namespace ivo::firmware {

Json json_of(const ScoreDocument& s) {
  Json json = {{"expected_time_s", s.expected_time_s},
               {"expected_time_continuous_s", s.expected_time_continuous_s},
               {"expected_sub_prior_time_s", json_or_null(s.expected_sub_prior_time_s)},
               {"unseen_mass", s.unseen_mass},
               {"horizon_s", s.horizon_s},
               {"complete", s.complete}};
  if (s.expected_sub_prior_time_own_s) {
    json.members.emplace_back("expected_sub_prior_time_own_s", *s.expected_sub_prior_time_own_s);
  }
  return json;
}

Json json_of(const BoundsDocument& b) {
  return {{"area_s", b.area_s},
          {"area_strict_s", b.area_strict_s},
          {"reach_s", b.reach_s},
          {"reach_strict_s", b.reach_strict_s}};
}

}  // namespace ivo::firmware
