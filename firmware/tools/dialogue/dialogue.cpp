#include "firmware/tools/dialogue/dialogue.hpp"

#include <algorithm>
#include <chrono>

#include "firmware/tools/dialogue/kept_areas.hpp"
#include "firmware/tools/dialogue/no_go_ahead.hpp"
#include "firmware/tools/dialogue/path_place.hpp"
#include "firmware/tools/dialogue/plan_notice.hpp"

namespace ivo::firmware {
namespace {

using console::Document;
using console::Kind;

constexpr Duration kSearchedEvery = std::chrono::milliseconds(400);
constexpr Duration kLookAheadEvery = std::chrono::milliseconds(100);
constexpr Duration kAreasAgain = std::chrono::seconds(1);  // where they could not be written

bool moves(Mode mode) { return permissions(mode).may_move; }
bool ends(Mode mode) { return mode == Mode::kStopping || mode == Mode::kDone || mode == Mode::kFault; }

}  // namespace

Dialogue::Dialogue(MissionInputs& inputs, planner::Planner& planner, const SearchObject& object, ControlLoop& loop,
                   console::ConsoleDesk& desk)
    : inputs_(inputs),
      loop_(loop),
      desk_(desk),
      second_(make_planner()),
      planners_{&planner, second_.get()},
      views_{RunView{{inputs, planner}, object}, RunView{{inputs, *second_}, object}},
      searched_(planner.cells(), planner.belief()) {
  heeded_.preferred = planner.belief().has_sub_priors;
  console::DocumentShelf& shelf = desk.documents();
  (void)shelf.put(Document::kMission, mission_text(view()));
  (void)shelf.put(Document::kMap, map_bytes(inputs.map));
  (void)shelf.put(Document::kAerial, inputs.map.aerial);
  (void)shelf.put(Document::kProbability, probability_bytes(planner));
  (void)shelf.put(Document::kSearched, searched_bytes(planner.cells(), searched_.cells()));
  for (const Document none : {Document::kPlan, Document::kPreviousPlan, Document::kNotice, Document::kReport}) {
    (void)shelf.put(none, {});
  }
}

Result<void> Dialogue::keep_areas_at(const std::string& path, bool taken_up) {
  areas_path_ = path;
  const Result<bool> drawn = taken_up ? draw_kept_areas(path, inputs_.file.mission, desk_) : Result<bool>(false);
  if (!drawn) {
    return drawn.error();
  }
  if (!drawn.value() && !draw(inputs_.file.mission, desk_)) {
    return Error{inputs_.file.path + ": has more areas than can be drawn at a console, " +
                 std::to_string(console::kAreaSlots) + "; expected fewer, or no --console"};
  }
  heeded_.revision = desk_.areas().revision();
  return {};
}

void Dialogue::take_up(const std::vector<std::vector<Point>>& tracks) {
  for (std::size_t m = 0; m < tracks.size(); ++m) {
    for (const Point place : tracks[m]) {
      searched_.look(planners_[current_]->cells(), place, inputs_.file.mission.agents[m].sight_radius_m);
    }
  }
}

void Dialogue::observe(const LoopStatus& status) {
  take_poses();
  take_requests();
  go_on(status);
  look(status);
  follow_persons(status);
  look_ahead(status);
  lay_down(status);
}

void Dialogue::take_poses() {
  for (const console::PoseCommand& pose : desk_.poses()) {
    OperatorCommand report(OperatorCommand::kReport);
    report.agent = pose.agent;
    report.place = {pose.x_m, pose.y_m};
    (void)loop_.command(report);
  }
}

void Dialogue::take_requests() {
  for (const console::DeskRequest& request : desk_.requests()) {
    if (request.kind == Kind::kEnough) {
      (void)loop_.command(OperatorCommand::kEnough);
    } else if (request.kind == Kind::kFound) {
      OperatorCommand found(OperatorCommand::kFound);
      found.agent = static_cast<std::uint8_t>(request.argument);
      (void)loop_.command(found);
    } else if (step_ == Step::kIdle && loop_.command(OperatorCommand::kPlanAnew)) {
      to_be_heeded_.preferred = request.kind == Kind::kReplan;
      step_ = Step::kHalting;
    }
  }
}

void Dialogue::go_on(const LoopStatus& status) {
  switch (step_) {
    case Step::kHalting:
      // A robot in fault brakes by itself: it stands when its power is off.
      if (status.preparing && !moves(status.mode) && (status.mode != Mode::kFault || status.power_off)) {
        prepare(status);
      } else if (!status.preparing && ends(status.mode)) {  // it was too late for another plan
        step_ = Step::kIdle;
      }
      break;
    case Step::kPreparing:
      if (maker_.done() || made_) {
        made_ = true;
        maker_.refusal() ? refuse(maker_.refusal()) : hand_over();
      }
      break;
    case Step::kHandedOver:
      if (status.plan_number != plan_before_) {
        current_ = 1 - current_;
        heeded_ = to_be_heeded_;
        heeded_.preferred = heeded_.preferred && planners_[current_]->belief().has_sub_priors;
        along_m_ = {};
        step_ = Step::kIdle;
      }
      break;
    case Step::kIdle:
      if (status.preparing) {  // what it waits for does not come
        (void)loop_.command(OperatorCommand::kPlanAsBefore);
      }
      break;
  }
  plan_before_ = status.plan_number;
}

// Who has set off starts from where they are, and what was searched is not searched again.
void Dialogue::prepare(const LoopStatus& status) {
  Mission& mission = inputs_.file.mission;
  (void)desk_.documents().put(Document::kNotice, {});  // of an earlier try
  agents_before_ = mission.agents;
  const console::AreaBoard board = desk_.areas();
  to_be_heeded_.revision = board.revision();
  mission.agents = agents_with(mission.agents, board, to_be_heeded_.preferred, slots_);
  planner::SearchProblem problem = inputs_.problem();
  problem.sub_priors = {};
  if (status.search_started) {
    problem.searched = &searched_.cells();
    for (std::size_t m = 0; m < problem.agents.size(); ++m) {
      problem.agents[m].body.start = status.tracks[m].position;
    }
  }
  maker_.begin(spare(), problem);
  step_ = Step::kPreparing;
}

void Dialogue::hand_over() {
  OperatorCommand with(OperatorCommand::kPlanWith);
  with.planner = &spare();
  if (loop_.command(with)) {
    step_ = Step::kHandedOver;
    made_ = false;
  }
}

void Dialogue::refuse(const planner::Refusal& refusal) {
  if (!loop_.command(OperatorCommand::kPlanAsBefore)) {
    return;  // again in the next turn
  }
  made_ = false;
  const PlanNotice notice = notice_of(refusal, inputs_, slots_);
  (void)desk_.documents().put(Document::kNotice, notice_text(notice, ++notices_));
  inputs_.file.mission.agents = agents_before_;
  step_ = Step::kIdle;
}

// The robot's is the loop's to say.
void Dialogue::follow_persons(const LoopStatus& status) {
  const ShownPlan& shown = loop_.shown_plan();
  for (std::size_t m = 1; shown.ready && m < shown.plan.paths.size(); ++m) {
    const planner::AgentPath& path = shown.plan.paths[m];
    if (status.search_started) {
      const AgentTrack& track = status.tracks[m];
      // Of a search that is taken up nobody has followed the way so far.
      const double walked_m = std::clamp(track.moved_m - track.before_m - 1.0, 0.0, path.length_m);
      const double before_m = along_m_[m] > 0.0 ? along_m_[m] : walked_m;
      along_m_[m] = along_path(path.waypoints.span(), track.position, before_m);
    }
    left_m_[m] = std::max(0.0, path.length_m - along_m_[m]);
  }
}

// An area that was closed after the plan was made is not driven into: the robot stands until there is another plan.
void Dialogue::look_ahead(const LoopStatus& status) {
  const ShownPlan& shown = loop_.shown_plan();
  const PlanMark mark{shown.number, shown.generation, shown.ready};
  const console::AreaBoard board = desk_.areas();
  const bool new_one = board.revision() != areas_ahead_ || !(mark == plan_ahead_);
  if (!new_one && status.at - looked_ahead_at_ < kLookAheadEvery) {
    return;
  }
  areas_ahead_ = board.revision();
  plan_ahead_ = mark;
  looked_ahead_at_ = status.at;
  into_no_go_.reset();
  for (std::size_t m = 0; shown.ready && m < shown.plan.paths.size() && !into_no_go_; ++m) {
    const planner::AgentPath& path = shown.plan.paths[m];
    const bool on_it = status.search_started && (m > 0 || status.way_of_plan == shown.number);
    const double left_m = !on_it ? path.length_m : m == 0 ? status.distance_left_m : left_m_[m];
    if (leads_into_no_go(path, left_m, board, static_cast<std::uint8_t>(m))) {
      into_no_go_ = static_cast<std::uint8_t>(m);
    }
  }
  if (into_no_go_ == 0 && status.mode == Mode::kSearching) {
    loop_.request_pause(PauseCause::kNoGo);
  }
}

void Dialogue::look(const LoopStatus& status) {
  if (!status.search_started || status.search != SearchState::kRunning) {
    return;
  }
  for (std::size_t m = 0; m < inputs_.file.mission.agents.size(); ++m) {
    const AgentSpec& agent = inputs_.file.mission.agents[m];
    const bool present =
        agent.kind == AgentKind::kRobot || agent.motion == PersonMotion::kSimulated || status.report_age[m].has_value();
    if (present) {
      searched_.look(planners_[current_]->cells(), status.tracks[m].position, agent.sight_radius_m);
    }
  }
}

void Dialogue::lay_down(const LoopStatus& status) {
  console::DocumentShelf& shelf = desk_.documents();
  const planner::Planner& planner = *planners_[current_];
  if (const console::AreaBoard board = desk_.areas(); board.revision() != areas_shown_) {
    areas_shown_ = board.revision();
    (void)shelf.put(Document::kAreas, areas_text(board, planner.cells(), searched_));
  }
  if (areas_kept_ != areas_shown_ && (areas_tried_ != areas_shown_ || status.at - areas_tried_at_ >= kAreasAgain)) {
    areas_tried_ = areas_shown_;
    areas_tried_at_ = status.at;
    const Result<void> kept = keep_areas(areas_path_, desk_.areas(), inputs_.file.mission);
    failure_ = kept ? std::nullopt : std::optional(kept.error());
    areas_kept_ = kept ? areas_shown_ : areas_kept_;
  }
  const bool due = status.at - searched_shown_at_ >= kSearchedEvery || status.finished;
  if (searched_.count() != searched_shown_ && due) {
    searched_shown_ = searched_.count();
    searched_shown_at_ = status.at;
    (void)shelf.put(Document::kSearched, searched_bytes(planner.cells(), searched_.cells()));
  }
  if (step_ != Step::kHandedOver) {
    lay_down_plan();
  }
}

void Dialogue::lay_down_plan() {
  const ShownPlan& shown = loop_.shown_plan();
  const PlanMark mark{shown.number, shown.generation, shown.ready};
  if (shown.number == 0 || mark == plan_shown_) {
    return;
  }
  console::DocumentShelf& shelf = desk_.documents();
  if (mark.number != plan_shown_.number && !plan_ready_.empty()) {
    (void)shelf.put(Document::kPreviousPlan, plan_ready_);
  }
  plan_shown_ = mark;
  std::string text = plan_text(view(), shown, heeded_);
  if (mark.ready) {
    plan_ready_ = text;
  }
  (void)shelf.put(Document::kPlan, std::move(text));
}

void Dialogue::complete(console::Status& status) const {
  status.preparing = preparing() ? 1 : status.preparing;
  status.with_preferences = heeded_.preferred ? 1 : 0;
  status.into_no_go = into_no_go_.value_or(console::Status::kNobody);
  status.searched_mass = std::min(1.0, searched_.mass());
  for (std::size_t m = 1; m < along_m_.size(); ++m) {
    status.agent[m].left_m = left_m_[m];
  }
}

}  // namespace ivo::firmware
