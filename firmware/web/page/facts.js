// The plan in figures, beside those of the plan before.
import { by_id, make } from "./dom.js";
import { share_inside } from "./geometry.js";
import { agents_of, areas_of } from "./judge.js";
import { model } from "./model.js";
import { metres, percent, say, seconds } from "./words.js";

let drawn_from = [];

/// A plan for what is left is not compared with one for the whole.
function previous_plan() {
  return model.status?.search?.started ? null : model.documents.previous_plan;
}

/// In the areas as they are drawn now: so both plans are measured alike, and one can see what a new area would change.
function preferred_share(plan, agent) {
  const mine = areas_of(model).filter((area) => area.purpose === "preferred" && area.agent === agent).map((area) => area.polygon_m);
  const path = plan?.agents?.[agent]?.waypoints_m;
  return path && mine.length > 0 ? share_inside(path, mine) : null;
}

function rows_of(plan, agents) {
  const rows = [];
  const row = (id, name, value_of) => rows.push({ id, name, now: value_of(plan), before: value_of(previous_plan()) });
  const or_none = (value, words) => (value === null || value === undefined ? "–" : words(value));
  row("et", say("facts.et"), (each) => or_none(each?.score?.expected_time_s, (value) => seconds(value, 1)));
  if (plan.with_preferences) row("est", say("facts.est"), (each) => or_none(each?.score?.expected_sub_prior_time_s, (value) => seconds(value, 1)));
  agents.forEach((agent, i) => {
    row(`distance-${i}`, say("facts.distance", { name: agent.name }), (each) => or_none(each?.agents?.[i]?.length_m, metres));
    if (agent.kind !== "person") return;
    row(`preferred-${i}`, say("facts.preferred", { name: agent.name }), (each) => or_none(preferred_share(each, i), percent));
  });
  row("gap", say("facts.gap"), (each) => or_none(each?.gap, percent));
  return rows;
}

/// `shown` false: nothing is compared now.
export function show_facts(shown) {
  const plan = model.documents.plan;
  by_id("facts").hidden = !shown || !plan;
  if (!shown || !plan) return;
  const previous = previous_plan();
  const from = [plan, previous, model.documents.areas, model.documents.mission, document.documentElement.lang];
  if (from.every((each, i) => each === drawn_from[i])) return;
  drawn_from = from;
  const rows = rows_of(plan, agents_of(model));
  by_id("facts").classList.toggle("alone", !previous);
  by_id("facts-before").hidden = !previous;
  by_id("facts-rows").replaceChildren(...rows.map((row) => {
    const cells = [make("th", { scope: "row", text: row.name }), make("td", { class: "figure", text: row.now })];
    if (previous) cells.push(make("td", { class: "figure before", text: row.before }));
    return make("tr", { id: `fact-${row.id}` }, ...cells);
  }));
}
