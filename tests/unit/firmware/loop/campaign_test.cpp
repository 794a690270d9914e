// A hundred thousand cycles of random faults and operators against a shadow model; and the shadow model against masters
// that do what they must not.
#include "tests/support/campaign.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

namespace ivo::test {
namespace {

constexpr std::uint64_t kSeed = 402'301;
constexpr std::uint64_t kCycles = 300'000;

/// Another life: IVO_CAMPAIGN_SEED.
std::uint64_t seed() {
  const char* const given = std::getenv("IVO_CAMPAIGN_SEED");
  return given == nullptr ? kSeed : std::strtoull(given, nullptr, 10);
}

std::string list(const std::map<std::string, int>& violations) {
  std::string text;
  for (const auto& [rule, count] : violations) {
    text += "  " + rule + ": " + std::to_string(count) + "\n";
  }
  return text;
}

TEST(Campaign, NoFrameBreaksARuleInAHundredThousandCyclesOfRandomFaults) {
  const CampaignFigures figures = Campaign(seed()).run(kCycles);
  std::cout << "seed " << seed() << ": " << figures.cycles << " cycles, " << figures.lives << " lives ("
            << figures.shared_lives << " at 1 kHz), " << figures.frames << " frames sent, set in motion "
            << figures.starts << " times, " << figures.faults << " faults latched for " << figures.reasons.size()
            << " reasons, " << figures.certain_events << " events without doubt, " << figures.pauses
            << " pauses in motion (" << figures.beats_lost << " without a beat), " << figures.new_plans
            << " plans made anew\n";
  EXPECT_TRUE(figures.violations.empty()) << list(figures.violations);
  // It was a hard life, and the robot lived it.
  EXPECT_GE(figures.cycles, 100'000U);
  EXPECT_GE(figures.shared_lives, 10);
  EXPECT_GE(figures.starts, 100);
  EXPECT_GE(figures.faults, 100);
  EXPECT_GE(figures.reasons.size(), 10U);
  EXPECT_GE(figures.pauses, 30);
  EXPECT_GE(figures.beats_lost, 3);
  EXPECT_GE(figures.new_plans, 10);
}

/// A master that does wrong, and the rule that it breaks.
struct Wrong {
  const char* rule;
  ShadowedBus::Plant plant;
  PdoLayout layout = PdoLayout::kOwn;
};

class CampaignShadow : public testing::TestWithParam<Wrong> {};

TEST_P(CampaignShadow, CatchesAMasterThat) {
  const CampaignFigures figures = Campaign(kSeed, GetParam().plant, GetParam().layout).run(20'000);
  EXPECT_TRUE(figures.violations.contains(GetParam().rule)) << list(figures.violations);
}

using Frames = std::vector<hal::CanFrame>;

hal::CanFrame command(int node, std::uint8_t word, std::uint8_t target) {
  return {.id = static_cast<std::uint16_t>(0x200 + node), .size = 6, .data = {word, 0, target, 0, 0, 0}};
}

void for_commands(Frames& frames, const std::function<void(hal::CanFrame&)>& change) {
  for (hal::CanFrame& frame : frames) {
    if (frame.id > 0x200 && frame.id <= 0x204) {
      change(frame);
    }
  }
}

void for_pairs(Frames& frames, const std::function<void(hal::CanFrame&)>& change) {
  for (hal::CanFrame& frame : frames) {
    if (frame.id == 0x301 || frame.id == 0x303) {
      change(frame);
    }
  }
}

bool has_commands(const Frames& frames) {
  return std::any_of(frames.begin(), frames.end(), [](const hal::CanFrame& frame) { return frame.id == 0x201; });
}

INSTANTIATE_TEST_SUITE_P(
    Planted, CampaignShadow,
    testing::Values(
        Wrong{"motion without consent since the last fault or pause",
              [](Frames& frames) { for_commands(frames, [](hal::CanFrame& frame) { frame.data[0] = 0x0F; }); }},
        Wrong{"power for some of four",
              [](Frames& frames) {
                if (has_commands(frames)) {
                  frames.push_back(command(3, 0x0F, 0));
                }
              }},
        Wrong{"a target before all four hold speed",
              [](Frames& frames) { for_commands(frames, [](hal::CanFrame& frame) { frame.data[2] |= 1; }); }},
        Wrong{"a target without power",
              [](Frames& frames) {
                for_commands(frames, [](hal::CanFrame& frame) {
                  if (frame.data[0] != 0x0F) {
                    frame.data[2] = 1;
                  }
                });
              }},
        Wrong{"a fault reset that nobody asked for",
              [count = 0](Frames& frames) mutable {
                for_commands(frames, [&](hal::CanFrame& frame) {
                  if (++count % 1000 == 0) {
                    frame.data[0] = 0x80;
                  }
                });
              }},
        Wrong{"motion in the cycle of a fault",
              [held = Frames()](Frames& frames) mutable {  // everything a cycle late
                if (has_commands(frames)) {
                  std::swap(frames, held);
                }
              }},
        Wrong{"motion while a stop input is pressed",
              [held = Frames()](Frames& frames) mutable {
                if (has_commands(frames)) {
                  std::swap(frames, held);
                }
              }},
        Wrong{"heartbeat though the last commands did not get out",
              [](Frames& frames) { frames.push_back({.id = 0x77F, .size = 1, .data = {0x05}}); }},
        Wrong{"commands without SYNC before them",
              [](Frames& frames) {
                std::erase_if(frames, [](const hal::CanFrame& frame) { return frame.id == 0x080; });
              }},
        Wrong{"commands for some of four",
              [](Frames& frames) {
                std::erase_if(frames, [](const hal::CanFrame& frame) { return frame.id == 0x202; });
              }},
        Wrong{"SDO while the robot moves",
              [](Frames& frames) {
                if (has_commands(frames)) {
                  frames.push_back({.id = 0x603, .size = 8, .data = {0x40, 0x41, 0x60}});
                }
              }},
        Wrong{"motion by SDO",
              [](Frames& frames) {
                frames.push_back({.id = 0x603, .size = 8, .data = {0x23, 0xFF, 0x60, 0, 1}});
              }},
        Wrong{"NMT while the robot moves",
              [](Frames& frames) {
                if (has_commands(frames)) {
                  frames.push_back({.id = 0x000, .size = 2, .data = {0x01, 3}});
                }
              }},
        Wrong{"a jump of the target",
              [count = 0](Frames& frames) mutable {
                for_commands(frames, [&](hal::CanFrame& frame) {
                  if (frame.data[0] == 0x0F && ++count % 400 < 4) {
                    frame.data[4] ^= 0x01;
                  }
                });
              }},
        Wrong{"faster than the search",
              [](Frames& frames) {
                for_commands(frames, [](hal::CanFrame& frame) {
                  if (frame.data[0] == 0x0F) {
                    frame.data[4] = 0x7F;
                    frame.data[5] = 0x00;
                  }
                });
              }},
        Wrong{"faster in a pause",
              [count = 0](Frames& frames) mutable {
                for_commands(frames, [&](hal::CanFrame& frame) {
                  if (frame.data[0] == 0x0F && ++count % 40 < 4) {
                    frame.data[3] ^= 0x08;
                  }
                });
              }},
        Wrong{"motion long after a pause",
              [](Frames& frames) {
                for_commands(frames, [](hal::CanFrame& frame) {
                  const int target = frame.data[2] | frame.data[3] << 8 | frame.data[4] << 16;
                  if (frame.data[0] == 0x0F && frame.data[5] == 0 && target < 6000) {
                    frame.data[2] = 0x70;  // a crawl that is no fault of the wheels
                    frame.data[3] = 0x17;
                  }
                });
              }},
        Wrong{"power for some of four",
              [](Frames& frames) {
                std::erase_if(frames,
                              [](const hal::CanFrame& frame) { return frame.id == 0x203 && frame.data[0] == 0x0F; });
              },
              PdoLayout::kShared},
        Wrong{"a target before all four hold speed",
              [](Frames& frames) { for_pairs(frames, [](hal::CanFrame& frame) { frame.data[4] |= 1; }); },
              PdoLayout::kShared},
        Wrong{"a target without power",
              [](Frames& frames) { for_pairs(frames, [](hal::CanFrame& frame) { frame.data[0] |= 1; }); },
              PdoLayout::kShared},
        Wrong{
            "commands for some of four",
            [](Frames& frames) { std::erase_if(frames, [](const hal::CanFrame& frame) { return frame.id == 0x303; }); },
            PdoLayout::kShared},
        Wrong{"motion in the cycle of a fault",  // the word that stops is never said
              [](Frames& frames) {
                std::erase_if(frames, [](const hal::CanFrame& frame) {
                  return frame.id > 0x200 && frame.id <= 0x204 && frame.data[0] == 0x02;
                });
              },
              PdoLayout::kShared}),
    [](const testing::TestParamInfo<Wrong>& wrong) {
      std::string name = wrong.param.rule;
      name += wrong.param.layout == PdoLayout::kShared ? " shared" : "";
      std::replace_if(
          name.begin(), name.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
      return name;
    });

}  // namespace
}  // namespace ivo::test
