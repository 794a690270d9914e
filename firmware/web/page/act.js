// The one thing to do next, always at the same place beside Stop; and why it cannot be done.
import { allow, by_id, on_press, set_attribute, set_text, show } from "./dom.js";
import { areas_are_newer, has_controller, into_no_go, is_old, is_operator, no_start_because, stage_of } from "./judge.js";
import { make_hold } from "./hold.js";
import { model } from "./model.js";
import { tell } from "./tell.js";
import { open_found } from "./search.js";
import { plan_anew, plan_anew_words } from "./asked.js";
import { set_view, view } from "./view_state.js";
import { say } from "./words.js";

const kButtons = ["hold-start", "accept", "plan-anew", "enough", "found", "clear-fault", "take-control"];
const hold = make_hold(by_id("hold-start"), by_id("hold-ring"), () => model.status?.question ?? null, (question) => tell("start", { question }));

/// The id of the button, whether it works, and why not or what it does.
function next_act(now_ms) {
  const stage = stage_of(model);
  const status = model.status;
  const old = is_old(model, now_ms);
  if (view.tool !== null && view.tool !== "position") return { id: null, works: false, why: "" };  // what is drawn comes first
  if (model.link === "open" && status && stage !== "wait" && stage !== "search" && stage !== "end" && !is_operator(model)) {
    return { id: "take-control", works: model.hello?.may_operate === true && !asked_already(), why: watch_words() };
  }
  switch (stage) {
    case "plan": {
      const plan = model.documents.plan;
      const works = !old && !status.plan.preparing && Boolean(plan) && plan.number === status.plan.number;
      return status.mode === "planning" ? { id: "enough", works, why: works ? "" : say("enough.not_yet") } : { id: null, works: false, why: "" };
    }
    case "agree": {
      const led = into_no_go(model);
      if (led) return { id: "plan-anew", works: !old, why: say("start.no_go", { name: led.name }) };
      if (status.plan.accepted) return start_act(now_ms);
      if (areas_are_newer(model) && !status.plan.followed) return { id: "plan-anew", works: !old, why: "" };
      return { id: "accept", works: !old && status.plan.ready, why: old ? say("start.old") : "" };
    }
    case "search": return { id: "found", works: !old && has_controller(model), why: "" };
    case "fault": return { id: "clear-fault", works: !old && status.asks === "clearing", why: status.asks === "clearing" ? "" : say("now.fault_wait") };
    case "end": return { id: null, works: false, why: say("act.end") };
    default: return { id: null, works: false, why: "" };
  }
}

function start_act(now_ms) {
  const why = no_start_because(model, now_ms);
  return { id: "hold-start", works: why === null, why: say(why ?? "start.how") };
}

function asked_already() {
  return model.status.request?.screen === model.hello?.screen;
}

function watch_words() {
  if (model.hello?.may_operate !== true) return say("control.only_watch");
  if (asked_already()) return say("control.asked", { name: model.status.operator?.name ?? "" });
  return model.status.operator ? say("operator.other", { name: model.status.operator.name }) : say("control.free");
}

const kSettleMs = 600;
let swapped_at_ms = -Infinity;

// A button that has just taken another's place was not what the finger went for.
function on_act(id, act) {
  on_press(by_id(id), () => {
    if (performance.now() - swapped_at_ms > kSettleMs) act();
  });
}

export function show_act() {
  const { id, works, why } = next_act(performance.now());
  if ((id ?? "") !== document.body.dataset.act) swapped_at_ms = performance.now();
  for (const each of kButtons) show(by_id(each), each === id);
  if (id !== null) allow(by_id(id), works);
  if (id === "plan-anew") set_text(by_id(id), plan_anew_words());
  if (id === "take-control") set_text(by_id(id), say(model.status.operator ? "control.ask" : "control.take"));
  show(by_id("accept-as-is"), id === "plan-anew" && into_no_go(model) === null && model.status.plan.ready);
  set_text(by_id("act-why"), why);
  set_attribute(by_id("act"), "data-why", why === "" ? "no" : "yes");
  document.body.dataset.act = id ?? "";
  hold.tick();
}

on_act("accept", () => tell("accept", { plan: model.status.plan.number }));
on_press(by_id("accept-as-is"), () => tell("accept", { plan: model.status.plan.number }));
on_act("plan-anew", plan_anew);
on_act("enough", () => tell("enough", { plan: model.status.plan.number }));
on_act("clear-fault", () => tell("clear_fault", { question: model.status.question }));
on_act("take-control", () => tell("control.request"));
function ask_who_found_it() {
  set_view({ tab: "search" });
  open_found();
}
on_act("found", ask_who_found_it);
on_press(by_id("found-too"), ask_who_found_it);
