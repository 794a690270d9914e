// While they search: how far everybody is, who has found the object, where a person really is.
import { can_be_placed, is_placed_by_hand } from "./agents.js";
import { agents_of, done_m, has_controller, is_operator, is_unseen, stage_of } from "./judge.js";
import { initial_of, style_of } from "./colours.js";
import { by_id, make, on_press, set_attribute, set_text, show } from "./dom.js";
import { model } from "./model.js";
import { tell } from "./tell.js";
import { set_view, view } from "./view_state.js";
import { duration, metres, number, percent, say } from "./words.js";

let drawn = "";
let choosing = false;
let wake_lock = null;

export function badge(agents, i) {
  const node = make("span", { class: `badge badge-${agents[i].kind}`, text: initial_of(agents[i]), "aria-hidden": "true" });
  node.style.backgroundColor = style_of(agents, i).line;
  return node;
}

function make_rows(agents) {
  by_id("agents").replaceChildren(...agents.map((agent, i) => {
    const bar = make("progress", { max: "1", value: "0", id: `agent-progress-${i}`, class: agent.kind });
    bar.style.color = style_of(agents, i).line;
    return make("li", { id: `agent-row-${i}` }, badge(agents, i),
      make("div", {}, make("p", { class: "agent-name" }, make("strong", { text: agent.name }), make("span", { class: "quiet", text: say(`kind.${agent.kind}`) })),
        bar, make("p", { class: "quiet", id: `agent-words-${i}` })));
  }));
  by_id("found-agents").replaceChildren(...agents.map((agent, i) => {
    const button = make("button", { type: "button", id: `found-${i}` }, badge(agents, i), make("span", { text: agent.name }));
    on_press(button, async () => {
      if (await tell("found", { agent: i })) choosing = false;
    });
    return button;
  }));
  by_id("position-row").replaceChildren(...[...agents.keys()].filter((i) => is_placed_by_hand(agents[i])).map((i) => {
    const button = make("button", { type: "button", id: `position-${i}`, text: say("position", { name: agents[i].name }) });
    on_press(button, () => set_view({ tool: view.tool === "position" ? null : "position", tool_agent: i }));
    return button;
  }));
}

function row_words(agent, i) {
  const path = model.documents.plan?.agents?.[i];
  const state = model.status?.agents?.[i];
  if (!path) return "";
  if (!model.status.search.started) return say("agent.will", { length: metres(path.length_m, 0), time: duration(path.duration_s) });
  const gone_m = done_m(model, i);
  const parts = [state?.path_ended && !is_unseen(model, i) ? say("agent.ended") : gone_m === null ? "" : say("agent.gone", { done: number(gone_m), all: metres(path.length_m, 0) })];
  if (agent.kind === "person") {
    parts.push(state?.report_age_s === null || state?.report_age_s === undefined ? say("agent.assumed") : say("agent.seen", { age: duration(state.report_age_s) }));
  }
  return parts.filter(Boolean).join(" · ");
}

function show_rows() {
  const agents = agents_of(model);
  const now = JSON.stringify([agents, document.documentElement.lang]);
  if (now !== drawn) {
    drawn = now;
    make_rows(agents);
  }
  agents.forEach((agent, i) => {
    const bar = by_id(`agent-progress-${i}`);
    const path = model.documents.plan?.agents?.[i];
    const gone_m = done_m(model, i);
    show(bar, gone_m !== null);
    if (path && gone_m !== null) bar.value = path.length_m > 0 ? gone_m / path.length_m : 1;
    set_attribute(bar, "aria-label", say("agent.progress", { name: agent.name }));
    set_text(by_id(`agent-words-${i}`), row_words(agent, i));
    const place = by_id(`position-${i}`);
    if (place) set_attribute(place, "aria-pressed", String(view.tool === "position" && view.tool_agent === i));
  });
  show(by_id("agents"), agents.length > 0 && stage_of(model) !== "end");
  show(by_id("position-row"), stage_of(model) === "search" && agents.some((_, i) => can_be_placed(i)));
}

export function open_found() {
  choosing = true;
  show_search();
  by_id("found-choice").scrollIntoView({ block: "nearest" });
  by_id("found-0")?.focus();
}

on_press(by_id("found-cancel"), () => {
  choosing = false;
  show_search();
});

export function show_search() {
  const searching = stage_of(model) === "search";
  const paused = model.status?.search?.started === true && ["agree", "plan"].includes(stage_of(model));
  if (!searching && !paused) choosing = false;
  show(by_id("found-too"), paused && model.link === "open" && has_controller(model) && !choosing);
  show(by_id("found-choice"), choosing);
  show_rows();
  keep_awake(searching);
  show(by_id("awake"), searching && is_operator(model) && !navigator.wakeLock);
  if (searching) {
    set_text(by_id("now-text"), say("now.search_text", {
      time: duration(model.status.search.time_s), share: percent(model.status.search.searched) }));
  }
}

// A screen that sleeps sends no beats, and the robot stands.
async function keep_awake(wanted) {
  if (!wanted) {
    wake_lock?.release?.();
    wake_lock = null;
    return;
  }
  if (wake_lock !== null || !navigator.wakeLock || document.visibilityState !== "visible") return;
  wake_lock = {};
  try {
    const lock = await navigator.wakeLock.request("screen");
    wake_lock = lock;
    lock.addEventListener("release", () => { if (wake_lock === lock) wake_lock = null; });
  } catch {
    wake_lock = {};  // not allowed: asked again when somebody comes back to the page, not at every status
  }
}

document.addEventListener("visibilitychange", () => {
  if (wake_lock !== null && !wake_lock.release) wake_lock = null;
});
