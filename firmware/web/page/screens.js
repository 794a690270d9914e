// Who watches and who holds the controls; what was refused.
import { allow, by_id, make, on_press, set_text, show } from "./dom.js";
import { is_operator } from "./judge.js";
import { model } from "./model.js";
import { note_held } from "./regain.js";
import { tell } from "./tell.js";
import { number, say, say_or } from "./words.js";

const kRefused = ["malformed", "too_large", "out_of_order", "replayed", "too_often", "not_allowed", "not_fresh", "no_controller", "by_controller", "foreign_origin",
  "foreign_host", "not_paired", "wrong_code"];
const kAnswerWithinMs = 10_000;  // then the server gives them
let asked_at_ms = null;
let drawn_screens = "";
let drawn_details = "";

function show_request() {
  const request = model.status?.request;
  const mine = is_operator(model) && Boolean(request);
  show(by_id("request"), mine);
  asked_at_ms = mine ? asked_at_ms ?? performance.now() : null;
  if (!mine) return;
  set_text(by_id("request-text"), say("request", { name: request.name }));
  set_text(by_id("request-left"), say("request.left", { left: Math.max(0, Math.ceil((kAnswerWithinMs - (performance.now() - asked_at_ms)) / 1000)) }));
}

function show_control() {
  const operator = model.status?.operator;
  const holds = is_operator(model);
  set_text(by_id("control-text"), holds ? say("control.you") : operator ? say("control.other", { name: operator.name }) : say("control.free"));
  show(by_id("control-request"), !holds);
  show(by_id("control-release"), holds);
  const asked = model.status?.request?.screen === model.hello?.screen && model.hello !== null;
  set_text(by_id("control-request"), say(asked ? "control.asked_short" : operator ? "control.ask" : "control.take"));
  allow(by_id("control-request"), model.link === "open" && model.hello?.may_operate === true && !asked);
}

function show_screens() {
  const screens = model.status?.screens ?? [];
  const now = JSON.stringify([screens, model.status?.operator?.screen, model.hello?.screen, document.documentElement.lang]);
  set_text(by_id("screens-count"), screens.length > 1 ? String(screens.length) : "");
  if (now === drawn_screens) return;
  drawn_screens = now;
  by_id("screen-list").replaceChildren(...screens.map((screen) => {
    const marks = [];
    if (screen.screen === model.hello?.screen) marks.push(say("screens.this"));
    if (screen.screen === model.status.operator?.screen) marks.push(say("screens.controls"));
    else if (screen.kind !== "ros") marks.push(say("screens.watches"));
    if (screen.kind === "ros") marks.push(say("screens.ros"));
    return make("li", { "data-screen": String(screen.screen) }, make("strong", { text: screen.name }), make("span", { class: "quiet", text: marks.join(" · ") }));
  }));
}

function rows(pairs) {
  return pairs.flatMap(([name, value, id]) => [make("dt", { text: name }), make("dd", { text: value, id })]);
}

function show_details() {
  if (!by_id("details").open || !model.status) return;
  const { refused = {}, time_s, mode, plan, areas_revision, question } = model.status;
  const counts = kRefused.filter((key) => key in refused).map((key) => [say(`refused.${key}`), number(refused[key]), `refused-${key}`]);
  const others = [[say("details.mode"), say_or(`mode.${mode}`, mode), "detail-mode"], [say("details.plan"), String(plan.number), "detail-plan"],
    [say("details.areas"), String(areas_revision), "detail-areas"], [say("details.question"), String(question), "detail-question"],
    [say("details.time"), number(time_s), "detail-time"]];
  const now = JSON.stringify([counts, others]);
  if (now === drawn_details) return;
  drawn_details = now;
  by_id("refused-rows").replaceChildren(...rows(counts));
  by_id("detail-rows").replaceChildren(...rows(others));
}

export function show_who() {
  show_request();
  show_control();
  show_screens();
  show_details();
}

on_press(by_id("control-request"), () => tell("control.request"));
on_press(by_id("control-release"), async () => {
  if (await tell("control.release")) note_held(false);
});
on_press(by_id("control-give"), () => tell("control.give"));
on_press(by_id("control-keep"), () => tell("control.keep"));
