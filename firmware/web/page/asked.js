// What the next plan will be asked, in words, before it is sent; and the two buttons that send it.
import { agents_of, areas_of, has_controller, is_operator } from "./judge.js";
import { allow, by_id, make, on_press, set_text } from "./dom.js";
import { model } from "./model.js";
import { set_view } from "./view_state.js";
import { tell } from "./tell.js";
import { percent, say } from "./words.js";

let drawn = "";

/// A sentence for each agent that would rather search somewhere, and for what nobody may enter.
function sentences() {
  const agents = agents_of(model);
  const areas = areas_of(model);
  const said = [];
  agents.forEach((agent, i) => {
    const mine = areas.filter((area) => area.purpose === "preferred" && area.agent === i);
    if (mine.length === 0) return;
    const share = mine.reduce((sum, area) => sum + area.share, 0);
    said.push(say(mine.length === 1 ? "asked.prefers_one" : "asked.prefers", { name: agent.name, count: mine.length, share: percent(Math.min(share, 1)) }));
  });
  const closed = areas.filter((area) => area.purpose === "no_go");
  const everybody = closed.filter((area) => area.agent === null).length;
  if (everybody > 0) said.push(say(everybody === 1 ? "asked.no_go_one" : "asked.no_go", { count: everybody }));
  agents.forEach((agent, i) => {
    const count = closed.filter((area) => area.agent === i).length;
    if (count > 0) said.push(say("asked.no_go_agent", { name: agent.name, count }));
  });
  return said.length > 0 ? said : [say("asked.nothing")];
}

function why_not() {
  if (!is_operator(model)) return say("start.not_operator");
  if (!has_controller(model) || model.link !== "open") return say("start.no_controller");
  const preferred = areas_of(model).some((area) => area.purpose === "preferred");
  return preferred ? "" : say("again.no_areas");
}

export function show_asked() {
  const said = sentences();
  const now = JSON.stringify(said);
  if (now !== drawn) {
    drawn = now;
    for (const id of ["asked", "asked-areas"]) by_id(id).replaceChildren(...said.map((text) => make("li", { text })));
  }
  const why = why_not();
  const may = is_operator(model) && has_controller(model) && model.link === "open" && !model.status.finished;
  for (const id of ["replan", "replan-areas"]) allow(by_id(id), may && why === "");
  allow(by_id("init"), may);
  set_text(by_id("again-why"), why);
  set_text(by_id("replan-why"), why);
  // While the robot moves, a new plan means that it stops first: the button says so.
  const moving = model.status?.mode === "searching";
  for (const id of ["replan", "replan-areas"]) set_text(by_id(id), say(moving ? "again.replan_moving" : "again.replan"));
  set_text(by_id("init"), say(moving ? "again.init_moving" : "again.init"));
}

async function replan() {
  if (await tell("replan", { areas_revision: model.status.areas_revision })) set_view({ tab: "search", selected: null, tool: null });
}

const is_wished = () => areas_of(model).some((area) => area.purpose === "preferred");

/// The plan that fits the areas as they are drawn.
export function plan_anew() {
  return is_wished() ? replan() : tell("init");
}

export function plan_anew_words() {
  return say(is_wished() ? "again.replan" : "again.anew");
}

on_press(by_id("replan"), replan);
on_press(by_id("replan-areas"), replan);
on_press(by_id("init"), () => tell("init"));
