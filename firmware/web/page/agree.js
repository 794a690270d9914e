// What is to be agreed now: where the plan stands, what it asks, and why the robot stands.
import { allow, by_id, on_press, set_attribute, set_text, show } from "./dom.js";
import { advice_of, fault_words } from "./state_words.js";
import { agents_of, has_controller, is_operator, stage_of } from "./judge.js";
import { model } from "./model.js";
import { show_asked } from "./asked.js";
import { show_facts } from "./facts.js";
import { show_progress_line } from "./progress_line.js";
import { tell } from "./tell.js";
import { number, say } from "./words.js";

function show_progress() {
  const { mode, plan } = model.status ?? {};
  const planning = mode === "planning";
  show(by_id("progress"), planning);
  show_progress_line();
  if (!planning) return;
  const bar = by_id("progress-bar");
  if (plan.preparing || !(plan.generations > 0)) bar.removeAttribute("value");
  else bar.value = plan.generation / plan.generations;
  set_attribute(bar, "aria-label", say("progress.label"));
  set_text(by_id("progress-text"), plan.preparing ? say("progress.preparing") :
    say("progress.step", { done: number(plan.generation), all: number(plan.generations) }));
}

function cause_words(status) {
  if (status?.taken_up) return "taken_up";
  const cause = status?.pause_cause ?? "none";
  // A plan that nobody has followed yet is why it stands now, whatever stopped it before.
  return cause !== "none" && status.plan.ready && !status.plan.followed ? "replan" : cause;
}

function show_pause() {
  const status = model.status;
  const stands = status?.search?.started && stage_of(model) !== "search" && stage_of(model) !== "end";
  const cause = cause_words(status);
  const shown = Boolean(stands) && cause !== "none" && stage_of(model) !== "fault";
  show(by_id("pause"), shown);
  if (shown) set_text(by_id("pause-text"), say(`pause.${cause}`));
}

// For who mends it; the sentence above says where to look.
function show_fault_detail(stage) {
  const detail = stage === "fault" ? (model.status?.fault ?? "") : "";
  show(by_id("fault-detail"), detail !== "");
  set_text(by_id("fault-detail"), detail);
}

export function show_agree() {
  const stage = stage_of(model);
  if (document.body.dataset.stage !== stage) by_id("page-search").scrollTop = 0;
  set_attribute(document.body, "data-stage", stage);
  set_attribute(document.body, "data-started", model.status?.search?.started && stage !== "end" ? "yes" : "no");
  const [title, text] = advice_of(model);
  const values = {
    robot: agents_of(model)[0]?.name ?? "IVO",
    person: agents_of(model).find((agent) => agent.kind === "person")?.name ?? say("somebody"),
    finder: agents_of(model)[model.status?.search?.finder]?.name ?? "",
    number: model.status?.plan?.number ?? "",
    fault: fault_words(model, say),
  };
  const news = say(title, values);
  if (by_id("now-title").textContent !== news) by_id("page-search").scrollTop = 0;
  set_text(by_id("now-title"), news);
  set_text(by_id("now-text"), say(text, values));
  show_fault_detail(stage);
  show_progress();
  show_pause();
  show_facts(stage === "plan" || stage === "agree");
  show(by_id("again"), stage === "agree" || stage === "search");
  show(by_id("end"), stage !== "end" && stage !== "wait" && is_operator(model));
  allow(by_id("end-run"), model.link === "open" && has_controller(model));
  show_asked();
}

on_press(by_id("end-run"), () => tell("end"));
