// Changes drawn at random of routes drawn at random: each is a route that can be followed, differs from the current one
// only where it says so, and keeps no segment of the pool that its route does not use.
#include "planner/search/route_change.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "tests/support/m1.hpp"
#include "tests/support/random_searches.hpp"
#include "tests/support/shared_planner.hpp"

namespace ivo::planner {
namespace {

constexpr std::int32_t kBorder = 70;  // ticks; farther than any agent must stay away
constexpr int kLegs = 12;             // of an agent to begin with

enum class Outcome { kOfNoUse, kNotFree, kMade };

// A route and what changes it, on the shared planner's tables.
class Rig {
 public:
  static Rig& get() {
    static Rig rig;  // large
    return rig;
  }

  bool open(const SearchProblem& problem) {
    if (!pool_.open()) {
      return false;
    }
    agents_ = static_cast<int>(problem.agents.size());
    std::array<SecondsAMetre, limits::kAgents> paces{};
    double widest_m = 0.0;
    for (int m = 0; m < agents_; ++m) {
      paces[index(m)] = SecondsAMetre(1.0 / problem.agents[index(m)].speed_mps);
      widest_m = std::max(widest_m, problem.agents[index(m)].sight_radius_m);
      current_.legs[index(m)].clear();
    }
    const Planner& planner = test::shared_planner();
    judge_.open(planner.cells(), planner.belief(), paces, problem.colony.ant.max_unseen_mass);
    width_ = static_cast<std::int32_t>(problem.map.width_m() * kTicksAMetre);
    height_ = static_cast<std::int32_t>(problem.map.height_m() * kTicksAMetre);
    change_.open({.agents = agents_,
                  .width = width_,
                  .height = height_,
                  .border = kBorder,
                  .sight = static_cast<std::int32_t>(widest_m * kTicksAMetre)});
    return true;
  }

  void draw_route(std::mt19937_64& random) {
    for (int m = 0; m < agents_; ++m) {
      for (int i = 0; i < 10 * kLegs && size_of(current_.legs[index(m)]) < kLegs; ++i) {
        (void)go_to(m, {{within(width_, random), within(height_, random)}, -1});
      }
    }
  }

  bool go_to(int agent, const Place& to) {
    Legs& legs = current_.legs[index(agent)];
    const Place from = legs.empty() ? pool_.place_of(agent) : end_of(legs.back(), pool_);
    int work = 0;
    const std::int32_t id = from.spot == to.spot ? -1 : pool_.make(agent, from, to, work);
    return id >= 0 && legs.push_back({id, false});
  }

  // Draws a change of the current route, of whose legs a plan uses `legs_used`; makes it in parts.
  Outcome propose(std::mt19937_64& random) {
    for (int m = 0; m < agents_; ++m) {
      judged_.legs_used[index(m)] = static_cast<std::int32_t>(random() % (current_.legs[index(m)].size() + 1));
    }
    Rng rng(random());
    int work = 0;
    if (!change_.propose(current_, judged_, rng, work)) {
      return Outcome::kOfNoUse;
    }
    do {
      if (!change_.make(work, work + 1 + static_cast<int>(random() % 300))) {
        return Outcome::kNotFree;
      }
    } while (!change_.made());
    return Outcome::kMade;
  }
  void accept() { change_.accept(current_); }
  void reject() { change_.reject(); }

  // Fills the pool and empties it again.
  int free_parts() {
    std::vector<std::int32_t> filled;
    int work = 0;
    for (std::int32_t id = 0; (id = pool_.begin(0, pool_.place_of(0), pool_.place_of(0), work)) >= 0;) {
      filled.push_back(id);
    }
    for (const std::int32_t id : filled) {
      pool_.release(id);
    }
    return static_cast<int>(filled.size());
  }
  [[nodiscard]] int parts_of_current() const {
    int parts = 0;
    for (int m = 0; m < agents_; ++m) {
      for (const Leg& leg : current_.legs[index(m)]) {
        parts += pool_[leg.segment].parts;
      }
    }
    return parts;
  }

  [[nodiscard]] int agents() const { return agents_; }
  [[nodiscard]] const SegmentPool& pool() const { return pool_; }
  [[nodiscard]] const RouteJudge& judge() const { return judge_; }
  [[nodiscard]] const Judgement& judged() const { return judged_; }
  [[nodiscard]] const Legs& current(int agent) const { return current_.legs[index(agent)]; }
  [[nodiscard]] const Legs& candidate(int agent) const { return change_.candidate().legs[index(agent)]; }
  [[nodiscard]] Seconds changed_s() const { return change_.changed_s(); }
  [[nodiscard]] bool inside(Spot spot) const {
    return spot.x >= kBorder && spot.y >= kBorder && spot.x <= width_ - kBorder && spot.y <= height_ - kBorder;
  }

 private:
  static std::int32_t within(std::int32_t length, std::mt19937_64& random) {
    return std::uniform_int_distribution<std::int32_t>(kBorder, length - kBorder)(random);
  }

  SegmentPool pool_{test::shared_planner().world()};
  RouteJudge judge_{pool_};
  RouteChange change_{pool_, judge_};
  int agents_ = 0;
  std::int32_t width_ = 0;
  std::int32_t height_ = 0;
  Route current_;
  Judgement judged_;
};

Rig& rig() { return Rig::get(); }

template <class OnSearch>
void on_random_searches(std::uint64_t seed, int count, OnSearch&& on_search) {
  const auto opens = [](int draw, SearchProblem& problem) {
    if (draw % 2 == 0) {
      test::make_alike(problem);
    }
    return !test::shared_planner().prepare(problem) && rig().open(problem);
  };
  test::on_random_searches(seed, count, opens, [&](const SearchProblem&, std::mt19937_64& random) {
    rig().draw_route(random);
    on_search(random);
  });
}

// Half of those that can be made are accepted. Returns how many there were.
template <class OnChange>
int on_random_changes(std::uint64_t seed, OnChange&& on_change) {
  int made = 0;
  on_random_searches(seed, 20, [&](std::mt19937_64& random) {
    for (int i = 0; i < 400 && !testing::Test::HasFailure(); ++i) {
      if (rig().propose(random) != Outcome::kMade) {
        continue;
      }
      SCOPED_TRACE("change " + std::to_string(i));
      ++made;
      on_change();
      if (random() % 2 == 0) {
        rig().accept();
      } else {
        rig().reject();
      }
    }
  });
  return made;
}

bool same(const Leg& a, const Leg& b) { return a.segment == b.segment && a.back == b.back; }

// Legs that both have in common from the start on.
int common_legs(int agent) {
  const Legs& a = rig().current(agent);
  const Legs& b = rig().candidate(agent);
  int i = 0;
  while (i < std::min(size_of(a), size_of(b)) && same(a[index(i)], b[index(i)])) {
    ++i;
  }
  return i;
}

bool differs(int agent) {
  return common_legs(agent) < std::max(size_of(rig().current(agent)), size_of(rig().candidate(agent)));
}

void expect_connected() {
  std::set<std::int32_t> used;
  for (int m = 0; m < rig().agents(); ++m) {
    const SegmentPool& pool = rig().pool();
    Place at = pool.place_of(m);
    for (const Leg& leg : rig().candidate(m)) {
      ASSERT_GE(leg.segment, 0) << "agent " << m;
      EXPECT_TRUE(end_of(leg.turned(), pool) == at) << "agent " << m;
      at = end_of(leg, pool);
      EXPECT_TRUE(used.insert(leg.segment).second) << "a segment is used twice";
    }
  }
}

TEST(RouteChange, LeadsEachAgentFromItsStartLegByLeg) {
  int longer = 0;
  int shorter = 0;
  int as_long = 0;
  int turned = 0;
  int of_two_agents = 0;
  const int made = on_random_changes(71, [&] {
    expect_connected();
    int more = 0;
    int agents = 0;
    std::set<std::int32_t> forth;
    for (int m = 0; m < rig().agents(); ++m) {
      more += size_of(rig().candidate(m)) - size_of(rig().current(m));
      agents += differs(m) ? 1 : 0;
      for (const Leg& leg : rig().current(m)) {
        if (!leg.back) {
          forth.insert(leg.segment);
        }
      }
    }
    bool turns = false;
    for (int m = 0; m < rig().agents(); ++m) {
      for (const Leg& leg : rig().candidate(m)) {
        turns = turns || (leg.back && forth.count(leg.segment) > 0);
      }
    }
    EXPECT_GE(agents, 1) << "nothing has changed";
    EXPECT_LE(agents, 2);
    longer += more > 0 ? 1 : 0;
    shorter += more < 0 ? 1 : 0;
    as_long += more == 0 ? 1 : 0;
    turned += turns ? 1 : 0;
    of_two_agents += agents == 2 ? 1 : 0;
  });
  EXPECT_GT(made, 1'000);
  EXPECT_GT(longer, 100);
  EXPECT_GT(shorter, 100);
  EXPECT_GT(as_long, 100);
  EXPECT_GT(turned, 20);
  EXPECT_GT(of_two_agents, 20);
}

TEST(RouteChange, IsAsTheCurrentRouteUpToWhenItSaysThatItChanges) {
  int late = 0;
  const int made = on_random_changes(72, [&] {
    for (int m = 0; m < rig().agents(); ++m) {
      const Legs& legs = rig().current(m);
      Seconds begin_s{};
      for (int i = 0; i < size_of(legs) && begin_s < rig().changed_s(); ++i) {
        EXPECT_GT(common_legs(m), i) << "agent " << m;
        begin_s += rig().judge().seconds_along(m, legs[index(i)].segment);
      }
    }
    late += rig().changed_s() > Seconds{} ? 1 : 0;
  });
  EXPECT_GT(late, made / 2);
}

TEST(RouteChange, ChangesOnlyWhatThePlanComesTo) {
  int at_last = 0;
  (void)on_random_changes(73, [&] {
    for (int m = 0; m < rig().agents(); ++m) {
      const int last = rig().judged().legs_used[index(m)] + 2;
      EXPECT_TRUE(!differs(m) || common_legs(m) <= last) << "agent " << m;
      at_last += differs(m) && common_legs(m) == last ? 1 : 0;
    }
  });
  EXPECT_GT(at_last, 0);
}

TEST(RouteChange, PutsNoWaypointNearTheBorder) {
  int at_border = 0;
  (void)on_random_changes(74, [&] {
    for (int m = 0; m < rig().agents(); ++m) {
      for (const Leg& leg : rig().candidate(m)) {
        const Spot spot = end_of(leg, rig().pool()).spot;
        EXPECT_TRUE(rig().inside(spot)) << spot.x << ", " << spot.y;
        at_border += spot.x == kBorder || spot.y == kBorder ? 1 : 0;
      }
    }
  });
  EXPECT_GT(at_border, 0);
}

TEST(RouteChange, LetsOnlyThoseTakeOverALegForWhomItIsAsGood) {
  int taken_over = 0;
  (void)on_random_changes(75, [&] {
    std::map<std::int32_t, int> agent_of;
    for (int m = 0; m < rig().agents(); ++m) {
      for (const Leg& leg : rig().current(m)) {
        agent_of[leg.segment] = m;
      }
    }
    for (int m = 0; m < rig().agents(); ++m) {
      for (const Leg& leg : rig().candidate(m)) {
        const auto before = agent_of.find(leg.segment);
        if (before != agent_of.end() && before->second != m) {
          EXPECT_TRUE(rig().pool().alike(before->second, m)) << "agent " << m << " from " << before->second;
          ++taken_over;
        }
      }
    }
  });
  EXPECT_GT(taken_over, 20);
}

TEST(RouteChange, GivesBackWhatItWishedWhenItIsRejectedAndWhatItLostWhenItIsAccepted) {
  int not_free = 0;
  int rejected = 0;
  int accepted = 0;
  on_random_searches(76, 10, [&](std::mt19937_64& random) {
    for (int i = 0; i < 120 && !testing::Test::HasFailure(); ++i) {
      SCOPED_TRACE("change " + std::to_string(i));
      const Outcome outcome = rig().propose(random);
      if (outcome == Outcome::kMade) {
        const bool accepts = random() % 2 == 0;
        if (accepts) {
          rig().accept();
        } else {
          rig().reject();
        }
        ++(accepts ? accepted : rejected);
      }
      not_free += outcome == Outcome::kNotFree ? 1 : 0;
      EXPECT_EQ(rig().free_parts() + rig().parts_of_current(), SegmentPool::kParts);
    }
  });
  EXPECT_GT(not_free, 50);
  EXPECT_GT(rejected, 50);
  EXPECT_GT(accepted, 50);
}

// Both agents go to and fro between two places, one as often as there is room for, the other almost.
TEST(RouteChange, LosesNothingOfWaysThatAreFull) {
  test::M1 m1(1);
  m1.problem().agents[1].body.start = m1.problem().agents[0].body.start;
  ASSERT_FALSE(test::shared_planner().prepare(m1.problem()));
  ASSERT_TRUE(rig().open(m1.problem()));
  for (int m = 0; m < 2; ++m) {
    for (int i = 200 * m; i < static_cast<int>(Legs::capacity()); ++i) {
      ASSERT_TRUE(rig().go_to(m, {spot_at({i % 2 == 0 ? 2.75 : 1.75, 1.75}), -1}));
    }
  }
  std::mt19937_64 random(77);
  int of_two_agents = 0;
  int accepted = 0;
  for (int i = 0; i < 4'000 && !HasFailure(); ++i) {
    if (rig().propose(random) != Outcome::kMade) {
      continue;
    }
    SCOPED_TRACE("change " + std::to_string(i));
    const bool both = differs(0) && differs(1);
    of_two_agents += both ? 1 : 0;
    // Few of the others are accepted: the first way stays about full.
    if (!both && random() % 8 != 0) {
      rig().reject();
      continue;
    }
    expect_connected();
    rig().accept();
    ++accepted;
    EXPECT_EQ(rig().free_parts() + rig().parts_of_current(), SegmentPool::kParts);
  }
  EXPECT_GT(of_two_agents, 10);
  EXPECT_GT(accepted, 100);
}

}  // namespace
}  // namespace ivo::planner
