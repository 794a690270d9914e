// A mission: which map, which prior, who searches from where, and how the plan is made. Plain data, read from TOML by
// firmware/files/mission_file.hpp. Lengths in metres, speeds in metres a second, angles in radians.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "config/base/geometry.hpp"
#include "config/semantic_class.hpp"

namespace ivo {

/// A closed polygon, first vertex not repeated; a rectangle is one of four vertices.
using Polygon = std::vector<Point>;

struct UniformPrior {};
struct Gaussian {
  Point mean;
  double sigma_m = 1.0;
  double weight = 1.0;  ///< relative to the other components
  std::string agent{};  ///< whose sub-prior it belongs to, by name; empty: sub-priors are not given this way
};
struct GaussianMixturePrior {
  std::vector<Gaussian> components;
};
struct ImagePrior {
  std::string image_path;     ///< grey, 8 or 16 bit; value over sum of values is the mass
  double resolution_m = 0.0;  ///< of a pixel; the image's lower-left corner lies on the map's
};
using PriorSpec = std::variant<UniformPrior, GaussianMixturePrior, ImagePrior>;

struct ObjectDrawn {};    ///< drawn from the prior with the mission's seed
struct ObjectUnknown {};  ///< only a person can say that it was found
using ObjectSpec = std::variant<ObjectDrawn, Point, ObjectUnknown>;

enum class FindRule : std::uint8_t {
  kSight,     ///< seen: in reach and not occluded
  kDistance,  ///< in reach, walls ignored (the paper's experiment)
};

enum class PersonMotion : std::uint8_t {
  kSimulated,  ///< walks its plan at its speed
  kReported,   ///< its position comes from outside
};

struct AgentSpec {
  std::string name;
  AgentKind kind = AgentKind::kRobot;
  std::string robot_path;  ///< of a robot
  PersonMotion motion = PersonMotion::kSimulated;
  Point start;
  double heading_rad = 0.0;
  double speed_mps = 0.5;            ///< v_m, what the planner assumes
  double sight_radius_m = 2.5;       ///< R_m
  double footprint_radius_m = 0.30;  ///< of a person; a robot's comes from its file
  std::vector<Polygon> preferred;
  std::optional<ImagePrior> sub_prior;  ///< given, in place of preferred areas
  std::vector<Polygon> restricted;
};

/// planner::Profile and planner::Heuristic, as missions and plans name them.
enum class SearchProfile : std::uint8_t { kPaper, kFast };
inline constexpr std::array<const char*, 2> kSearchProfileWords = {"paper", "fast"};
enum class SearchHeuristic : std::uint8_t { kTsp, kMts };
inline constexpr std::array<const char*, 2> kSearchHeuristicWords = {"tsp", "mts"};

struct PlannerParameters {
  SearchProfile profile = SearchProfile::kFast;
  SearchHeuristic heuristic = SearchHeuristic::kTsp;
  double cell_m = 0.25;       ///< sensing resolution
  double spacing_m = 3.5;     ///< h, side of a square of the graph
  double clearance_m = 0.40;  ///< node to nearest obstacle
  int generations = 300;
  int ants = 10;
  int beta = 6;                    ///< weight of the heuristic (alpha is 1)
  std::optional<double> rho;       ///< evaporation; none: 0.002 in the paper's profile, 0.02 in the fast one
  double shortest_first = 0.9;     ///< q: probability of extending the agent whose path ends earliest
  double iteration_best = 0.5;     ///< probability that the generation's best deposits, not the best so far
  double max_unseen_mass = 0.014;  ///< a plan is complete at or below this
};

struct Mission {
  std::string name;
  std::string map_path;
  std::uint64_t seed = 1;
  ObjectSpec object = ObjectDrawn{};
  FindRule find = FindRule::kSight;
  PriorSpec prior = UniformPrior{};
  bool alike_sub_priors = false;  ///< each agent's sub-prior is its part of the prior
  PlannerParameters planner;
  std::vector<AgentSpec> agents;
};

}  // namespace ivo
