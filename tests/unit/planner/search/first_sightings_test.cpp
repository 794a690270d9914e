#include "planner/search/first_sightings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

namespace ivo::planner {
namespace {

TEST(StepOf, IsTheSecondThatHoldsTheTime) {
  EXPECT_EQ(step_of(0.0), 0);
  EXPECT_EQ(step_of(0.1), 1);
  EXPECT_EQ(step_of(1.0), 1);
  EXPECT_EQ(step_of(1.01), 2);
  EXPECT_EQ(step_of(2.0), 2);
  EXPECT_EQ(step_of(639.5), 640);
}

TEST(StepOf, DoesNotMindTheRoundingOfSums) {
  EXPECT_EQ(step_of(3.0 + 1e-9), 3);
  EXPECT_EQ(step_of(3.0 - 1e-9), 3);
  EXPECT_EQ(step_of(1e-9), 0);
  EXPECT_EQ(step_of(-1.0), 0);
}

TEST(StepOf, IsTheFormulaOfTheModel) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> time_s(0.0, 50.0);
  for (int i = 0; i < 20'000; ++i) {
    const double t = i % 2 == 0 ? time_s(random) : std::floor(time_s(random)) + 1e-6 * (time_s(random) - 25.0);
    ASSERT_EQ(step_of(t), std::max(0, static_cast<int>(std::ceil(t - 1e-6)))) << t;
  }
}

class FirstSightingsTest : public testing::Test {
 protected:
  std::unique_ptr<FirstSightings> sightings_ = std::make_unique<FirstSightings>();
  FirstSightingsTest() { clear(); }

  void clear() { sightings_->clear(100); }
  bool see(Cell c, int agent, double time_s) { return sightings_->see(c, agent, Seconds(time_s)); }
};

TEST_F(FirstSightingsTest, KnowNothingAtFirst) { EXPECT_FALSE(sightings_->seen(5)); }

TEST_F(FirstSightingsTest, TellWhetherACellIsNew) {
  EXPECT_TRUE(see(5, 0, 2.5));
  EXPECT_FALSE(see(5, 0, 2.75));
  EXPECT_FALSE(see(5, 1, 1.0));  // known, though nobody saw it as early
  EXPECT_TRUE(sightings_->seen(5));
  EXPECT_FALSE(sightings_->seen(6));
}

TEST_F(FirstSightingsTest, ForgetAll) {
  (void)see(5, 1, 2.5);
  clear();
  EXPECT_FALSE(sightings_->seen(5));
  EXPECT_TRUE(see(5, 1, 9.0));
  EXPECT_EQ(sightings_->of(5).time_s, Seconds(9.0));
}

TEST_F(FirstSightingsTest, CreditTheLowestAgentOfTheStepNotTheFirst) {
  (void)see(5, 1, 4.9);
  (void)see(5, 2, 4.2);
  EXPECT_EQ(sightings_->of(5).time_s, Seconds(4.2));
  EXPECT_EQ(sightings_->of(5).agent, 2);
  EXPECT_EQ(sightings_->of(5).credited, 1);
  EXPECT_EQ(sightings_->credited_time_s(5), Seconds(4.9));
}

TEST_F(FirstSightingsTest, DoNotCreditALaterStep) {
  (void)see(5, 0, 4.2);
  (void)see(5, 2, 5.1);
  EXPECT_EQ(sightings_->of(5).credited, 0);
  EXPECT_EQ(sightings_->of(5).agent, 0);
  EXPECT_EQ(sightings_->of(5).step, 5);
}

TEST_F(FirstSightingsTest, TakeTheCreditAwayWhenAnEarlierStepComesToLight) {
  (void)see(5, 0, 5.1);
  (void)see(5, 2, 4.2);
  EXPECT_EQ(sightings_->of(5).credited, 2);
  EXPECT_EQ(sightings_->credited_time_s(5), Seconds(4.2));
}

TEST_F(FirstSightingsTest, AreWhatALookAtAllTogetherWouldTell) {
  struct Look {
    int agent;
    double time_s;
  };
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> time_s(0.0, 4.0);
  for (int i = 0; i < 5000; ++i) {
    std::vector<Look> looks(1 + random() % 6);
    for (Look& look : looks) {
      look = {static_cast<int>(random() % 4), random() % 4 == 0 ? std::floor(time_s(random)) : time_s(random)};
      look.time_s = std::floor(look.time_s * 65536.0) / 65536.0;  // what both builds can hold
    }
    // Agents one after the other, each in the order of its times.
    std::sort(looks.begin(), looks.end(), [](const Look& a, const Look& b) {
      return a.agent < b.agent || (a.agent == b.agent && a.time_s < b.time_s);
    });
    clear();
    for (const Look& look : looks) {
      (void)see(7, look.agent, look.time_s);
    }
    Look first = looks[0];
    for (const Look& look : looks) {
      if (look.time_s < first.time_s || (look.time_s == first.time_s && look.agent < first.agent)) {
        first = look;
      }
    }
    Look credited{99, 0.0};
    for (const Look& look : looks) {
      if (step_of(Seconds(look.time_s)) == step_of(Seconds(first.time_s)) &&
          (look.agent < credited.agent || (look.agent == credited.agent && look.time_s < credited.time_s))) {
        credited = look;
      }
    }
    const Sighting& s = sightings_->of(7);
    ASSERT_EQ(to_double(s.time_s), first.time_s);
    ASSERT_EQ(s.agent, first.agent);
    ASSERT_EQ(s.credited, credited.agent);
    ASSERT_EQ(to_double(sightings_->credited_time_s(7)), credited.time_s);
  }
}

}  // namespace
}  // namespace ivo::planner
