#include "planner/search/segment_pool.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "tests/support/random_searches.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::planner {
namespace {

SegmentPool& pool() {
  static SegmentPool pool(test::shared_planner().world());  // large
  return pool;
}

// Prepares searches drawn at random and opens the pool on them.
template <class OnSearch>
void on_random_pools(std::uint64_t seed, int count, OnSearch&& on_search) {
  const auto opens = [](int, const SearchProblem& problem) {
    return !test::shared_planner().prepare(problem) && pool().open();
  };
  test::on_random_searches(seed, count, opens, on_search);
}

Place anywhere(const SegmentedMap& map, std::mt19937_64& random) {
  std::uniform_real_distribution<double> x_m(0.0, map.width_m());
  std::uniform_real_distribution<double> y_m(0.0, map.height_m());
  return {spot_at({x_m(random), y_m(random)}), -1};
}

Place node_or_anywhere(const SegmentedMap& map, std::mt19937_64& random) {
  const auto nodes = static_cast<std::uint64_t>(test::shared_planner().graph().nodes());
  return random() % 4 == 0 ? pool().place_of(static_cast<Node>(random() % nodes)) : anywhere(map, random);
}

// Who owns each part: no part belongs to two segments, and a segment keeps its parts until it is released.
class Owners {
 public:
  void take(std::int32_t segment) {
    for (const std::int32_t part : parts_of(segment)) {
      EXPECT_EQ(of_part_[index(part)], -1) << "part " << part << " is given twice";
      of_part_[index(part)] = segment;
    }
  }
  void give_back(std::int32_t segment) {
    for (const std::int32_t part : parts_of(segment)) {
      EXPECT_EQ(of_part_[index(part)], segment) << "part " << part << " has changed hands";
      of_part_[index(part)] = -1;
    }
  }

 private:
  static std::vector<std::int32_t> parts_of(std::int32_t id) {
    const Segment& segment = pool()[id];
    std::vector<std::int32_t> parts;
    std::int32_t before = -1;
    for (std::int32_t p = segment.first_part; parts.size() < index(segment.parts); p = pool().part(p).next) {
      EXPECT_EQ(pool().part(p).before, before);
      before = p;
      parts.push_back(p);
    }
    EXPECT_EQ(before, segment.last_part);
    return parts;
  }

  std::vector<std::int32_t> of_part_ = std::vector<std::int32_t>(SegmentPool::kParts, -1);
};

// Segments of one part, until there is no room.
std::vector<std::int32_t> fill(const Place& place) {
  std::vector<std::int32_t> filled;
  int work = 0;
  for (std::int32_t id = 0; (id = pool().begin(0, place, place, work)) >= 0;) {
    filled.push_back(id);
  }
  return filled;
}

TEST(SegmentPool, LosesNothingOverFiftyThousandSegmentsBegunMadeAndReleased) {
  int released_half_made = 0;
  on_random_pools(21, 5, [&](const SearchProblem& problem, std::mt19937_64& random) {
    Owners owners;
    std::vector<std::int32_t> kept;
    for (int i = 0; i < 10'000; ++i) {
      if (!kept.empty() && (random() % 2 == 0 || kept.size() > 600)) {
        const std::size_t k = random() % kept.size();
        owners.give_back(kept[k]);
        pool().release(kept[k]);
        kept[k] = kept.back();
        kept.pop_back();
        continue;
      }
      int work = 0;
      const auto agent = static_cast<int>(random() % problem.agents.size());
      const Place to = node_or_anywhere(problem.map, random);
      const Place from = node_or_anywhere(problem.map, random);
      const std::int32_t id = pool().begin(agent, from, to, work);
      if (id < 0) {
        continue;
      }
      owners.take(id);
      const bool made = pool().make_rows(work, work + static_cast<int>(random() % 1'500));
      if (made || random() % 2 == 0) {
        kept.push_back(id);  // half made, too: it is not gone on with
      } else {
        ++released_half_made;
        owners.give_back(id);
        pool().release(id);
      }
    }
    for (const std::int32_t id : kept) {
      owners.give_back(id);
      pool().release(id);
    }
    const std::vector<std::int32_t> all = fill(pool().place_of(0));
    EXPECT_EQ(all.size(), index(std::min(SegmentPool::kSegments, SegmentPool::kParts)));
    for (const std::int32_t id : all) {
      owners.take(id);
    }
  });
  EXPECT_GT(released_half_made, 500);
}

TEST(SegmentPool, AcceptsOnlyWaysOnWhichTheAgentCanGo) {
  int accepted = 0;
  int refused = 0;
  const auto on_pool = [&](const SearchProblem& problem, std::mt19937_64& random) {
    const SegmentedMap& map = problem.map;
    for (int i = 0; i < 400; ++i) {
      const auto agent = static_cast<int>(random() % problem.agents.size());
      const GraphAgent& body = problem.agents[index(agent)].body;
      const Place from = node_or_anywhere(map, random);
      const Place to = node_or_anywhere(map, random);
      int work = 0;
      const std::int32_t id = from == to ? -1 : pool().make(agent, from, to, work);
      if (id < 0) {
        ++refused;
        continue;
      }
      ++accepted;
      const Point a = pool().point_at(from);
      const Point b = pool().point_at(to);
      const auto blocked =
          static_cast<ClassSet>(obstacle_classes(map.classes) | restricted_classes(map.classes, body.kind));
      EXPECT_TRUE(swept_disc_is_free(map, blocked, a, b, body.footprint_radius_m))
          << "agent " << agent << " from " << a.x_m << ", " << a.y_m << " to " << b.x_m << ", " << b.y_m;
      EXPECT_FALSE(touches(body.restricted, a, b));
      pool().release(id);
    }
  };
  on_random_pools(22, 40, on_pool);
  on_random_pools(39, 40, on_pool);  // a node nearer to the border than the spot that it is rounded to
  EXPECT_GT(accepted, 1'000);
  EXPECT_GT(refused, 1'000);
}

TEST(SegmentPool, AcceptsEveryEdgeOfTheGraphForWhomItIsOpen) {
  int edges = 0;
  on_random_pools(23, 10, [&](const SearchProblem& problem, std::mt19937_64&) {
    const Graph& graph = test::shared_planner().graph();
    for (Node n = 0; n < graph.nodes(); ++n) {
      for (Edge e = graph.first_edge(n); e < graph.end_edge(n); ++e) {
        for (int m = 0; m < static_cast<int>(problem.agents.size()); ++m) {
          if (!in(graph.open_to(e), m)) {
            continue;
          }
          int work = 0;
          const std::int32_t id = pool().begin(m, pool().place_of(n), pool().place_of(graph.head(e)), work);
          ASSERT_GE(id, 0) << "agent " << m << " from node " << n << " to node " << graph.head(e);
          // The places of nodes are rounded to the lattice.
          EXPECT_NEAR(to_double(pool()[id].length), graph.length_m(e), 1.5 / kTicksAMetre);
          pool().release(id);
          ++edges;
        }
      }
    }
  });
  EXPECT_GT(edges, 1'000);
}

TEST(SegmentPool, MakesTheSameSightInManyPartsAsInOne) {
  on_random_pools(24, 10, [&](const SearchProblem& problem, std::mt19937_64& random) {
    for (int i = 0; i < 40; ++i) {
      const auto agent = static_cast<int>(random() % problem.agents.size());
      const Place from = node_or_anywhere(problem.map, random);
      const Place to = node_or_anywhere(problem.map, random);
      int work = 0;
      const std::int32_t whole = pool().make(agent, from, to, work);
      if (whole < 0) {
        continue;
      }
      work = 0;
      const std::int32_t sliced = pool().begin(agent, from, to, work);
      ASSERT_GE(sliced, 0);
      for (int enough = work + 1; !pool().make_rows(work, enough); enough = work + 1) {
      }
      ASSERT_EQ(pool()[sliced].parts, pool()[whole].parts);
      std::int32_t p = pool()[whole].first_part;
      std::int32_t q = pool()[sliced].first_part;
      for (int k = 0; k < pool()[whole].parts; ++k, p = pool().part(p).next, q = pool().part(q).next) {
        const Part& a = pool().part(p);
        const Part& b = pool().part(q);
        ASSERT_EQ(a.rows, b.rows);
        ASSERT_EQ(a.first_row, b.first_row);
        ASSERT_EQ(a.first_byte, b.first_byte);
        EXPECT_TRUE(std::equal(a.words.begin(), a.words.begin() + a.rows, b.words.begin()));
      }
      pool().release(whole);
      pool().release(sliced);
    }
  });
}

// A route is kept as waypoints, and a leg of it that was gone back is made anew the other way round.
TEST(SegmentPool, AcceptsAWayInBothDirectionsOrInNeither) {
  int accepted = 0;
  on_random_pools(25, 40, [&](const SearchProblem& problem, std::mt19937_64& random) {
    for (int i = 0; i < 2'000; ++i) {
      const auto agent = static_cast<int>(random() % problem.agents.size());
      const Place from = node_or_anywhere(problem.map, random);
      const Place to = node_or_anywhere(problem.map, random);
      int work = 0;
      const std::int32_t there = pool().begin(agent, from, to, work);
      const std::int32_t back = pool().begin(agent, to, from, work);
      EXPECT_EQ(there >= 0, back >= 0) << "agent " << agent << " from " << from.spot.x << ", " << from.spot.y << " to "
                                       << to.spot.x << ", " << to.spot.y << " ticks";
      for (const std::int32_t id : {there, back}) {
        if (id >= 0) {
          ++accepted;
          pool().release(id);
        }
      }
    }
  });
  EXPECT_GT(accepted, 1'000);
}

// One agent, alone with one node, in the middle of a square of a single pixel.
struct OnePixel {
  OnePixel(double side_m, double cell_m, double sight_radius_m) {
    problem.map = {pixels, 1, 1, side_m, default_class_table()};
    problem.cell_m = cell_m;
    problem.graph = {.spacing_m = 2 * side_m, .clearance_m = 0.0};
    problem.agents.resize(1);
    problem.agents[0].body.start = {side_m / 2, side_m / 2};
    problem.agents[0].body.footprint_radius_m = 0.0;
    problem.agents[0].sight_radius_m = sight_radius_m;
  }
  std::array<SemanticClass, 1> pixels = {SemanticClass::kPavement};
  SearchProblem problem;
};

TEST(SegmentPool, IsOfNoUseWhereCellsAreSmallerThanTheLatticeOrNumbersTooLarge) {
  struct Case {
    double side_m, cell_m, sight_radius_m;
    bool useful;
  };
  for (const Case& c : {Case{4, 0.25, 2, true}, Case{0.5, 0.02, 0.1, true}, Case{0.5, 0.01, 0.05, false},
                        Case{0.01, 1e-5, 2e-5, false}, Case{4, 0.25, 5.6, false}, Case{2000, 5, 70, false},
                        Case{4e8, 1e6, 5e6, false}, Case{1e5, 1e5, 60, true}, Case{1e6, 1e6, 60, false}}) {
    OnePixel one(c.side_m, c.cell_m, c.sight_radius_m);
    ASSERT_FALSE(test::shared_planner().prepare(one.problem)) << c.side_m;
    EXPECT_EQ(pool().open(), c.useful) << "side " << c.side_m << ", cells " << c.cell_m;
  }
}

}  // namespace
}  // namespace ivo::planner
