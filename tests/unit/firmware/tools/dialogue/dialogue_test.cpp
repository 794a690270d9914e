// What people want at a console and what becomes of it, with a real loop on the virtual bus and a clock that is ours.
#include "firmware/tools/dialogue/dialogue.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "firmware/console/console_status.hpp"
#include "firmware/files/json_value.hpp"
#include "firmware/tools/planner_object.hpp"
#include "firmware/tools/run_setup.hpp"
#include "planner/world/distance.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/firmware/files/written_png.hpp"

namespace ivo::firmware {
namespace {

using console::Asks;
using console::Document;
using console::Kind;
using console::Verdict;

// 12 x 12 m of pavement with a building of 2 x 2 m in its middle.
const std::string kText = std::string(R"(format = 1
map = "map.toml"
seed = 3
object = "unknown"
prior = "uniform"
[planner]
spacing_m = 3.0
generations = 3
[[agent]]
name = "IVO"
kind = "robot"
robot = ")") + IVO_SOURCE_DIR +
                          R"(/config/robots/ivo.toml"
start_m = [1.5, 1.5]
sight_radius_m = 2.5
speed_mps = 0.5
[[agent]]
name = "Ana"
kind = "person"
motion = "reported"
start_m = [10.5, 1.5]
sight_radius_m = 2.5
speed_mps = 0.5
preferred = [{ polygon_m = [[7, 7], [11, 7], [11, 11], [7, 11]] }]
)";

std::string map_image() {
  constexpr std::size_t kPixels = 48;
  std::vector<std::uint8_t> rows;
  for (std::size_t row = 0; row < kPixels; ++row) {
    for (std::size_t column = 0; column < kPixels; ++column) {
      const bool built = row >= 20 && row < 28 && column >= 20 && column < 28;
      for (const std::uint8_t value :
           built ? std::array<std::uint8_t, 3>{104, 84, 92} : std::array<std::uint8_t, 3>{214, 210, 202}) {
        rows.push_back(value);
      }
    }
  }
  return written_png(kPixels, kPixels, {}, rows);
}

const Json& at(const Json& json, const std::string& name) {
  for (const auto& [key, value] : json.members) {
    if (key == name) {
      return value;
    }
  }
  static const Json kNone;
  ADD_FAILURE() << "no " << name;
  return kNone;
}

double number(const Json& json) {
  EXPECT_TRUE(json.is_number());
  return json.kind == Json::Kind::kCount ? static_cast<double>(json.count) : json.real;
}

class DialogueTest : public testing::Test {
 protected:
  void SetUp() override { begin(kText); }

  void begin(const std::string& text) {
    folder_.put("map.png", map_image());
    folder_.put("map.toml", "image = 'map.png'\nresolution_m = 0.25\n");
    Result<MissionInputs> read = read_inputs(folder_.put("mission.toml", text));
    ASSERT_TRUE(read.ok()) << read.error().message;
    inputs_ = std::move(read).value();
    ASSERT_TRUE(prepare(the_planner(), inputs_).ok());
    options_.max_speed = true;
    world_ = std::move(RunWorld::open(options_, inputs_.robot)).value();
    LoopSetup setup = loop_setup(inputs_, object_, *world_);
    setup.fault_waits = true;
    loop_ = std::make_unique<ControlLoop>(setup, the_planner(), world_->bus());
    desk_ = std::make_unique<console::ConsoleDesk>(console::BoardRules{.agents = 2, .width_m = 12, .height_m = 12},
                                                   console::Reported{false, true},
                                                   console::DeskHooks{.stop = [this] { loop_->request_stop(); },
                                                                      .pause = [this] { loop_->request_pause(); },
                                                                      .beat = [this] { loop_->beat(); }});
    dialogue_ = std::make_unique<Dialogue>(inputs_, the_planner(), object_, *loop_, *desk_);
    EXPECT_TRUE(dialogue_->keep_areas_at(folder_.path("areas.geojson"), false).ok());
    loop_->open(world_->clock().now());
    observe();
  }
  void cycle() {
    const Instant now = world_->clock().now();
    loop_->cycle({.now = now});
    world_->after_cycle(*loop_);
    world_->clock().sleep_until(now + inputs_.robot.cycle);
  }
  // As a run does.
  void observe() {
    const LoopStatus& status = loop_->status();
    dialogue_->observe(status);
    const bool asks = status.mode == Mode::kAwaitingConsent && status.plan_ready && !dialogue_->preparing();
    console::Status shown = console::status_of(status, 2);
    dialogue_->complete(shown);
    desk_->show(shown, asks ? Asks::kConsent : Asks::kNothing);
    if (const auto answer = desk_->take(Asks::kConsent)) {
      OperatorCommand consent(OperatorCommand::kConsent);
      consent.watched = answer->watched;
      consent.pauses = status.pauses;
      (void)loop_->command(consent);
    }
  }
  /// False when it did not come within so many looks; those while tables are made do not count.
  bool run_until(const std::function<bool()>& wanted, int looks = 20'000) {
    for (; looks > 0 && !wanted(); looks -= loop_->status().preparing ? 0 : 1) {
      for (int i = 0; i < 25; ++i) {
        cycle();
      }
      observe();
    }
    return wanted();
  }
  bool run_until_asked(std::uint32_t plan) {
    return run_until([&] { return shown().asks == Asks::kConsent && shown().plan_number == plan; });
  }
  bool run_until(Mode mode) {
    return run_until([&] { return loop_->status().mode == mode; });
  }
  console::Status shown() const { return desk_->status(); }
  Verdict submit(Kind kind, std::uint32_t argument = 0) {
    return desk_->submit(
        console::Command{.header = {.kind = kind}, .question = shown().question, .argument = argument});
  }
  Verdict put_area(std::uint8_t slot, double x_m, double y_m, double side_m,
                   console::AreaPurpose purpose = console::AreaPurpose::kPreferred, std::uint8_t agent = 1) {
    console::AreaCommand area;
    area.slot = slot;
    area.purpose = purpose;
    area.agent = agent;
    area.corners = 4;
    area.corner[0] = {x_m, y_m};
    area.corner[1] = {x_m + side_m, y_m};
    area.corner[2] = {x_m + side_m, y_m + side_m};
    area.corner[3] = {x_m, y_m + side_m};
    return desk_->submit(area);
  }
  Verdict replan() { return submit(Kind::kReplan, shown().areas_revision); }
  std::string bytes_of(Document document) const {
    const console::DocumentShelf::Copy copy = desk_->documents().at(document);
    return copy.bytes != nullptr ? *copy.bytes : "never put there";
  }
  Json json_of(Document document) const {
    Result<Json> json = parse_json(bytes_of(document), "document", "JSON");
    EXPECT_TRUE(json.ok()) << bytes_of(document);
    return json.ok() ? json.value() : Json();
  }
  void search() {
    ASSERT_TRUE(run_until_asked(1));
    ASSERT_EQ(submit(Kind::kConsent), Verdict::kAccepted);
    ASSERT_TRUE(run_until(Mode::kSearching));
  }
  void search_for(int looks) {
    (void)run_until([] { return false; }, looks);
  }

  ScratchFolder folder_;
  RunOptions options_;
  MissionInputs inputs_;
  SearchObject object_;
  std::unique_ptr<RunWorld> world_;
  std::unique_ptr<ControlLoop> loop_;
  std::unique_ptr<console::ConsoleDesk> desk_;
  std::unique_ptr<Dialogue> dialogue_;
};

TEST_F(DialogueTest, LaysDownEveryDocumentAtTheBeginning) {
  EXPECT_EQ(number(at(at(json_of(Document::kMission), "map"), "width_m")), 12.0);
  EXPECT_EQ(at(json_of(Document::kMission), "agents").elements.size(), 2U);
  EXPECT_EQ(bytes_of(Document::kMap).size(), 48U * 48U);
  EXPECT_EQ(bytes_of(Document::kAerial), "");
  const std::string bytes = bytes_of(Document::kProbability);
  std::vector<float> mass(bytes.size() / sizeof(float));
  std::memcpy(mass.data(), bytes.data(), mass.size() * sizeof(float));
  double sum = 0.0;
  for (const float of_cell : mass) {
    sum += static_cast<double>(of_cell);
  }
  EXPECT_EQ(mass.size(), static_cast<std::size_t>(the_planner().cells().count()));
  EXPECT_NEAR(sum, 1.0, 1e-4);
  EXPECT_EQ(bytes_of(Document::kSearched), std::string((mass.size() + 7) / 8, '\0'));
  for (const Document none : {Document::kPlan, Document::kPreviousPlan, Document::kNotice, Document::kReport}) {
    EXPECT_EQ(bytes_of(none), "");
    EXPECT_EQ(desk_->documents().revision(none), 1U);
  }
  const Json areas = json_of(Document::kAreas);
  ASSERT_EQ(at(areas, "areas").elements.size(), 1U) << "the mission's own";
  EXPECT_EQ(at(at(areas, "areas").elements[0], "purpose").text, "preferred");
  EXPECT_NEAR(number(at(at(areas, "areas").elements[0], "area_m2")), 16.0, 1e-9);
}

TEST_F(DialogueTest, AnInitialPlanLeavesPreferredAreasOutAndTheyStayDrawn) {
  ASSERT_TRUE(run_until_asked(1));
  EXPECT_EQ(shown().with_preferences, 1);
  EXPECT_TRUE(at(json_of(Document::kPlan), "with_preferences").flag);
  const std::string before = bytes_of(Document::kPlan);
  ASSERT_EQ(submit(Kind::kInit), Verdict::kAccepted);
  ASSERT_TRUE(run_until_asked(2));
  EXPECT_EQ(shown().with_preferences, 0);
  EXPECT_FALSE(at(json_of(Document::kPlan), "with_preferences").flag);
  EXPECT_EQ(at(json_of(Document::kPlan), "number").count, 2U);
  EXPECT_TRUE(at(json_of(Document::kPlan), "done").flag);
  EXPECT_EQ(bytes_of(Document::kPreviousPlan), before);
  EXPECT_EQ(at(json_of(Document::kAreas), "areas").elements.size(), 1U);
}

TEST_F(DialogueTest, AReplanHeedsWhatIsDrawnByNow) {
  ASSERT_TRUE(run_until_asked(1));
  ASSERT_EQ(submit(Kind::kRemoveArea, 0), Verdict::kAccepted);
  ASSERT_EQ(put_area(5, 1, 7, 4), Verdict::kAccepted);
  ASSERT_EQ(put_area(6, 7, 1, 2, console::AreaPurpose::kNoGo, 0), Verdict::kAccepted);
  ASSERT_EQ(replan(), Verdict::kAccepted);
  ASSERT_TRUE(run_until_asked(2));
  EXPECT_EQ(shown().with_preferences, 1);
  const AgentSpec& ana = dialogue_->view().inputs.file.mission.agents[1];
  ASSERT_EQ(ana.preferred.size(), 1U);
  EXPECT_EQ(ana.preferred[0][0], (Point{1, 7}));
  for (const Point waypoint : loop_->plan().paths[0].waypoints) {
    EXPECT_FALSE(waypoint.x_m > 7 && waypoint.x_m < 9 && waypoint.y_m > 1 && waypoint.y_m < 3) << "no go";
  }
  EXPECT_EQ(at(json_of(Document::kAreas), "areas").elements.size(), 2U);
  const Json plan = json_of(Document::kPlan);
  EXPECT_EQ(at(plan, "areas_revision").count, shown().areas_revision);
  const Json& agents = at(plan, "agents");
  ASSERT_EQ(agents.elements.size(), 2U);
  EXPECT_GT(number(at(agents.elements[1], "preferred_share")), 0.0);
  EXPECT_EQ(at(agents.elements[0], "preferred_share").kind, Json::Kind::kNull);
}

TEST_F(DialogueTest, ARefusedReplanGoesBackToThePlanBeforeAndSaysWhyByCodeAndSlot) {
  ASSERT_TRUE(run_until_asked(1));
  const std::string before = bytes_of(Document::kPlan);
  const std::uint32_t question = shown().question;
  ASSERT_EQ(put_area(9, 5.5, 5.5, 1), Verdict::kAccepted) << "within the building";
  ASSERT_EQ(replan(), Verdict::kAccepted);
  ASSERT_TRUE(run_until([&] { return !bytes_of(Document::kNotice).empty(); }));
  ASSERT_TRUE(run_until_asked(1));
  EXPECT_GT(shown().question, question) << "asked anew";
  const Json notice = json_of(Document::kNotice);
  EXPECT_EQ(at(notice, "number").count, 1U);
  EXPECT_EQ(at(notice, "code").text, "area_without_mass");
  EXPECT_EQ(at(notice, "agent").count, 1U);
  EXPECT_EQ(at(notice, "slot").count, 9U);
  EXPECT_EQ(bytes_of(Document::kPlan), before);
  EXPECT_EQ(bytes_of(Document::kPreviousPlan), "");
  EXPECT_EQ(dialogue_->view().inputs.file.mission.agents[1].preferred.size(), 1U) << "as that plan heeds them";
  // It can be agreed to as before, and another replan can be wanted.
  ASSERT_EQ(put_area(9, 1, 1, 2, console::AreaPurpose::kNoGo, 0), Verdict::kAccepted) << "where the robot stands";
  ASSERT_EQ(replan(), Verdict::kAccepted);
  ASSERT_TRUE(run_until([&] { return bytes_of(Document::kNotice).find("start_restricted") != std::string::npos; }));
  EXPECT_EQ(at(json_of(Document::kNotice), "number").count, 2U);
  EXPECT_EQ(at(json_of(Document::kNotice), "code").text, "start_restricted");
  EXPECT_EQ(at(json_of(Document::kNotice), "agent").count, 0U);
  EXPECT_EQ(at(json_of(Document::kNotice), "slot").kind, Json::Kind::kNull);
  ASSERT_EQ(submit(Kind::kRemoveArea, 9), Verdict::kAccepted);
  search_for(2);
  ASSERT_TRUE(run_until_asked(1));
  ASSERT_EQ(submit(Kind::kConsent), Verdict::kAccepted);
  EXPECT_TRUE(run_until(Mode::kSearching));
}

TEST_F(DialogueTest, AReplanUnderWayStartsWhereEverybodyIsAndLeavesOutWhatIsSearched) {
  search();
  search_for(200);  // ten seconds
  console::PoseCommand pose;
  pose.agent = 1;
  pose.x_m = 10.5;
  pose.y_m = 8.0;
  ASSERT_EQ(desk_->submit(pose), Verdict::kAccepted);
  search_for(2);
  EXPECT_EQ(shown().agent[1].y_m, 8.0);
  EXPECT_EQ(shown().agent[1].reported, 1U);
  EXPECT_GT(shown().searched_mass, 0.1);
  EXPECT_LT(shown().searched_mass, 0.9);
  ASSERT_EQ(replan(), Verdict::kAccepted);
  ASSERT_TRUE(run_until_asked(2));
  const Point stands = loop_->status().robot.point();
  const planner::Plan& plan = loop_->plan();
  EXPECT_NEAR(plan.paths[0].waypoints[0].x_m, stands.x_m, 0.01);
  EXPECT_NEAR(plan.paths[0].waypoints[0].y_m, stands.y_m, 0.01);
  EXPECT_EQ(plan.paths[1].waypoints[0], (Point{10.5, 8.0}));
  // Where somebody has looked nothing is left; elsewhere is all of it.
  const planner::Planner& planner = dialogue_->view().planner;
  const std::string searched = bytes_of(Document::kSearched);
  double sum = 0.0;
  for (planner::Cell c = 0; c < planner.cells().count(); ++c) {
    const auto i = static_cast<std::size_t>(c);
    const double mass = planner::to_double(planner.belief().mass[i]);
    sum += mass;
    if ((static_cast<unsigned char>(searched[i / 8]) >> (i % 8) & 1U) != 0) {
      ASSERT_EQ(mass, 0.0) << "cell " << c;
    }
  }
  EXPECT_NEAR(sum, 1.0, 1e-6);
  ASSERT_EQ(submit(Kind::kConsent), Verdict::kAccepted);
  ASSERT_TRUE(run_until(Mode::kSearching));
}

// On the way of an agent, well beyond where it starts.
Point ahead(const planner::AgentPath& path) { return path.waypoints[path.waypoints.size() / 2]; }

TEST_F(DialogueTest, NobodySetsOffIntoAnAreaThatWasClosedAfterThePlan) {
  ASSERT_TRUE(run_until_asked(1));
  const Point there = ahead(loop_->plan().paths[0]);
  ASSERT_EQ(put_area(3, there.x_m - 0.2, there.y_m - 0.2, 0.4, console::AreaPurpose::kNoGo, 1), Verdict::kAccepted);
  search_for(2);
  EXPECT_EQ(shown().into_no_go, console::Status::kNobody) << "closed to Ana alone, whose way is another";
  ASSERT_EQ(put_area(3, there.x_m - 0.2, there.y_m - 0.2, 0.4, console::AreaPurpose::kNoGo, 0), Verdict::kAccepted);
  search_for(2);
  EXPECT_EQ(shown().into_no_go, 0);
  EXPECT_EQ(submit(Kind::kAccept, 1), Verdict::kOutdated);
  EXPECT_EQ(submit(Kind::kConsent), Verdict::kOutdated);
  ASSERT_EQ(replan(), Verdict::kAccepted);
  ASSERT_TRUE(run_until_asked(2));
  EXPECT_EQ(shown().into_no_go, console::Status::kNobody);
  EXPECT_EQ(submit(Kind::kConsent), Verdict::kAccepted);
  EXPECT_TRUE(run_until(Mode::kSearching));
}

TEST_F(DialogueTest, AnAreaThatIsOpenedAgainIsNoCauseToWait) {
  ASSERT_TRUE(run_until_asked(1));
  const Point there = ahead(loop_->plan().paths[0]);
  ASSERT_EQ(put_area(3, there.x_m - 0.2, there.y_m - 0.2, 0.4, console::AreaPurpose::kNoGo, 0), Verdict::kAccepted);
  search_for(2);
  ASSERT_EQ(submit(Kind::kConsent), Verdict::kOutdated);
  ASSERT_EQ(submit(Kind::kRemoveArea, 3), Verdict::kAccepted);
  search_for(2);
  EXPECT_EQ(submit(Kind::kConsent), Verdict::kAccepted);
}

TEST_F(DialogueTest, ARobotStandsBeforeAnAreaThatIsClosedAheadOfItAndNotForOneBehindIt) {
  search();
  const Point start = loop_->status().robot.point();
  search_for(100);  // five seconds
  ASSERT_GT(planner::distance_m(start, loop_->status().robot.point()), 1.0);
  ASSERT_EQ(put_area(3, start.x_m - 0.2, start.y_m - 0.2, 0.4, console::AreaPurpose::kNoGo, 0), Verdict::kAccepted);
  search_for(20);
  EXPECT_EQ(loop_->status().mode, Mode::kSearching);
  const Point end = loop_->plan().paths[0].waypoints.span().back();
  ASSERT_EQ(put_area(4, end.x_m - 0.2, end.y_m - 0.2, 0.4, console::AreaPurpose::kNoGo, 0), Verdict::kAccepted);
  ASSERT_TRUE(run_until([&] { return shown().asks == Asks::kConsent; }));
  EXPECT_EQ(loop_->status().pause_cause, PauseCause::kNoGo);
  EXPECT_EQ(submit(Kind::kConsent), Verdict::kOutdated);
}

TEST_F(DialogueTest, ANoticeGoesWithTheNextTry) {
  ASSERT_TRUE(run_until_asked(1));
  ASSERT_EQ(put_area(3, 1, 1, 1, console::AreaPurpose::kNoGo, 0), Verdict::kAccepted);  // where the robot stands
  ASSERT_EQ(replan(), Verdict::kAccepted);
  ASSERT_TRUE(run_until_asked(1));
  EXPECT_EQ(at(json_of(Document::kNotice), "code").text, "start_restricted");
  ASSERT_EQ(submit(Kind::kRemoveArea, 3), Verdict::kAccepted);
  ASSERT_EQ(replan(), Verdict::kAccepted);
  ASSERT_TRUE(run_until_asked(2));
  EXPECT_EQ(bytes_of(Document::kNotice), "");
}

TEST_F(DialogueTest, NothingLeftToSearchIsSaidSo) {
  search();
  std::vector<std::vector<Point>> everywhere(2);
  for (double x_m = 0.5; x_m < 12; x_m += 1) {
    for (double y_m = 0.5; y_m < 12; y_m += 1) {
      everywhere[1].push_back({x_m, y_m});
    }
  }
  dialogue_->take_up(everywhere);
  ASSERT_EQ(submit(Kind::kInit), Verdict::kAccepted);
  ASSERT_TRUE(run_until([&] { return !bytes_of(Document::kNotice).empty(); }));
  EXPECT_EQ(at(json_of(Document::kNotice), "code").text, "nothing_left");
  EXPECT_GT(shown().searched_mass, 0.99);
  EXPECT_LE(shown().searched_mass, 1.0);
  EXPECT_TRUE(run_until_asked(1));
}

TEST_F(DialogueTest, FoundEndsTheRun) {
  search();
  search_for(20);
  ASSERT_EQ(submit(Kind::kFound, 1), Verdict::kAccepted);
  ASSERT_TRUE(run_until(Mode::kDone));
  EXPECT_EQ(loop_->status().search, SearchState::kFound);
  EXPECT_EQ(shown().finder, 1);
  dialogue_->show_report("{}");
  EXPECT_EQ(bytes_of(Document::kReport), "{}");
}

TEST_F(DialogueTest, EnoughTakesTheBestPlanSoFar) {
  std::string text = kText;
  text.replace(text.find("generations = 3"), 15, "generations = 100000");
  begin(text);
  ASSERT_TRUE(run_until([&] { return shown().horizon_s > 0 && !bytes_of(Document::kPlan).empty(); }));
  EXPECT_FALSE(at(json_of(Document::kPlan), "done").flag) << "it is shown while it is made";
  EXPECT_EQ(submit(Kind::kEnough, 7), Verdict::kOutdated);
  ASSERT_EQ(submit(Kind::kEnough, 1), Verdict::kAccepted);
  ASSERT_TRUE(run_until_asked(1));
  EXPECT_TRUE(at(json_of(Document::kPlan), "done").flag);
}

TEST_F(DialogueTest, APlanMayBeAskedForWhileOneIsMade) {
  std::string text = kText;
  text.replace(text.find("generations = 3"), 15, "generations = 100000");
  begin(text);
  search_for(10);
  ASSERT_EQ(loop_->status().mode, Mode::kPlanning);
  ASSERT_EQ(submit(Kind::kInit), Verdict::kAccepted);
  EXPECT_EQ(submit(Kind::kInit), Verdict::kNotNow);
  ASSERT_TRUE(run_until([&] { return shown().plan_number == 2 && shown().preparing == 0; }));
  ASSERT_TRUE(run_until([&] { return shown().horizon_s > 0; }));
  ASSERT_EQ(submit(Kind::kReplan, shown().areas_revision), Verdict::kAccepted);
  ASSERT_TRUE(run_until([&] { return shown().plan_number == 3 && shown().preparing == 0; }));
  ASSERT_TRUE(run_until([&] { return shown().horizon_s > 0; }));
  ASSERT_EQ(submit(Kind::kEnough, 3), Verdict::kAccepted);
  EXPECT_TRUE(run_until_asked(3));
  EXPECT_EQ(bytes_of(Document::kPreviousPlan), "") << "none was planned to its end";
}

TEST_F(DialogueTest, MakesPlanAfterPlanWithTwoPlanners) {
  ASSERT_TRUE(run_until_asked(1));
  for (std::uint32_t number = 2; number < 6; ++number) {
    ASSERT_EQ(number % 2 == 0 ? replan() : submit(Kind::kInit), Verdict::kAccepted);
    ASSERT_TRUE(run_until_asked(number));
    EXPECT_EQ(shown().with_preferences, number % 2 == 0 ? 1 : 0);
    EXPECT_EQ(at(json_of(Document::kPreviousPlan), "number").count, number - 1);
  }
}

}  // namespace
}  // namespace ivo::firmware
