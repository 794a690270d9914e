#include "firmware/tools/resume/kept_search.hpp"

#include <cmath>

#include "firmware/record/plain_bytes.hpp"

namespace ivo::firmware {
namespace {

constexpr std::uint32_t kMostSources = 256;

void write(ByteWriter& out, const Point& point) {
  out.real(point.x_m);
  out.real(point.y_m);
}

Point read_point(ByteReader& in) {
  const double x_m = in.real();
  return {x_m, in.real()};
}

void write(ByteWriter& out, const planner::PlanScore& score) {
  out.real(score.expected_time_s);
  out.real(score.expected_time_continuous_s);
  out.real(score.expected_sub_prior_time_s);
  out.real(score.expected_sub_prior_time_own_s);
  out.real(score.unseen_mass);
  out.real(score.horizon_s);
  out.flag(score.complete);
}

void read(ByteReader& in, planner::PlanScore& score) {
  score.expected_time_s = in.real();
  score.expected_time_continuous_s = in.real();
  score.expected_sub_prior_time_s = in.real();
  score.expected_sub_prior_time_own_s = in.real();
  score.unseen_mass = in.real();
  score.horizon_s = in.real();
  score.complete = in.flag();
}

void write(ByteWriter& out, const planner::Plan& plan) {
  out.u32(static_cast<std::uint32_t>(plan.paths.size()));
  for (const planner::AgentPath& path : plan.paths) {
    out.real(path.length_m);
    out.real(path.duration_s);
    out.u32(static_cast<std::uint32_t>(path.waypoints.size()));
    for (const Point& waypoint : path.waypoints) {
      write(out, waypoint);
    }
  }
  write(out, plan.score);
}

// False when there are more agents or waypoints than this build has room for.
bool read(ByteReader& in, planner::Plan& plan) {
  const std::uint32_t agents = in.u32();
  if (agents > plan.paths.capacity()) {
    return false;
  }
  plan.paths.resize(agents);
  for (planner::AgentPath& path : plan.paths) {
    path.length_m = in.real();
    path.duration_s = in.real();
    const std::uint32_t waypoints = in.u32();
    if (waypoints == 0 || waypoints > path.waypoints.capacity()) {
      return false;
    }
    path.waypoints.resize(waypoints);
    for (Point& waypoint : path.waypoints) {
      waypoint = read_point(in);
    }
  }
  read(in, plan.score);
  return true;
}

void write(ByteWriter& out, const SearchProgress& progress, std::size_t agents) {
  for (std::size_t m = 0; m < agents; ++m) {
    const AgentTrack& track = progress.tracks[m];
    write(out, track.position);
    out.real(track.moved_m);
    out.real(track.before_m);
    out.i64(track.under_way.count());
    out.flag(track.path_ended);
  }
  out.i64(progress.elapsed.count());
  out.u8(static_cast<std::uint8_t>(progress.state));
  out.u8(static_cast<std::uint8_t>(progress.finder.value_or(-1) + 1));
}

bool read(ByteReader& in, SearchProgress& progress, std::size_t agents) {
  for (std::size_t m = 0; m < agents; ++m) {
    AgentTrack& track = progress.tracks[m];
    track.position = read_point(in);
    track.moved_m = in.real();
    track.before_m = in.real();
    track.under_way = Duration(in.i64());
    track.path_ended = in.flag();
  }
  progress.elapsed = Duration(in.i64());
  const std::uint8_t state = in.u8();
  const std::uint8_t finder = in.u8();
  progress.state = static_cast<SearchState>(state);
  progress.finder = finder > 0 ? std::optional<int>(finder - 1) : std::nullopt;
  return state <= static_cast<std::uint8_t>(SearchState::kPathsEnded) && finder <= agents;
}

}  // namespace

std::string to_bytes(const KeptSearch& kept) {
  ByteWriter out;
  out.text(kept.world);
  out.u32(static_cast<std::uint32_t>(kept.sources.size()));
  for (const KeptSource& source : kept.sources) {
    out.text(source.path);
    out.u64(source.fingerprint);
  }
  out.flag(kept.ended);
  out.i64(kept.unix_time_s);
  out.real(kept.at_s);
  out.u64(kept.log_bytes);
  out.flag(kept.planned);
  out.flag(kept.consented);
  const ResumedSearch& search = kept.search;
  if (kept.planned) {
    write(out, search.plan);
    out.u32(static_cast<std::uint32_t>(search.generations));
    out.flag(search.started);
    write(out, search.progress, search.plan.paths.size());
    write(out, search.robot.point());
    out.real(search.robot.heading_rad);
    out.real(search.distance_left_m);
  }
  return out.bytes();
}

bool from_bytes(std::string_view bytes, KeptSearch& kept) {
  kept.sources.clear();
  ByteReader in(bytes);
  kept.world = in.text();
  const std::uint32_t sources = in.u32();
  if (sources > kMostSources) {
    return false;
  }
  for (std::uint32_t i = 0; i < sources && in.ok(); ++i) {
    KeptSource& source = kept.sources.emplace_back();
    source.path = in.text();
    source.fingerprint = in.u64();
  }
  kept.ended = in.flag();
  kept.unix_time_s = in.i64();
  kept.at_s = in.real();
  kept.log_bytes = in.u64();
  kept.planned = in.flag();
  kept.consented = in.flag();
  if (kept.planned) {
    ResumedSearch& search = kept.search;
    if (!read(in, search.plan)) {
      return false;
    }
    search.generations = static_cast<int>(in.u32());
    search.started = in.flag();
    if (!read(in, search.progress, search.plan.paths.size())) {
      return false;
    }
    const Point robot = read_point(in);
    const double heading_rad = in.real();
    search.robot = {robot.x_m, robot.y_m, heading_rad};
    search.distance_left_m = in.real();
  }
  return in.ok() && in.at_end();
}

}  // namespace ivo::firmware
