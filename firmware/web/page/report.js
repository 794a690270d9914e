// The end: who found it, in figures.
import { by_id, make, set_text, show } from "./dom.js";
import { agents_of, stage_of } from "./judge.js";
import { end_key } from "./state_words.js";
import { model } from "./model.js";
import { duration, metres, percent, say, seconds } from "./words.js";

const kVibrateMs = [200, 100, 200, 100, 400];
let ended = false;
let drawn = "";

function rows_of(report) {
  const rows = [];
  const row = (name, value) => rows.push([name, value]);
  row(say("report.time"), duration(report?.real_search_time_s ?? model.status.search.time_s));
  const expected_s = report?.plan_score?.expected_time_s ?? model.documents.plan?.score?.expected_time_s;
  if (expected_s !== undefined) row(say("report.expected"), duration(expected_s));
  row(say("report.searched"), percent(model.status.search.searched));
  agents_of(model).forEach((agent, i) => {
    const gone_m = report?.agents?.[i]?.distance_m ?? model.status.agents[i]?.moved_m ?? 0;
    row(say("report.distance", { name: agent.name }), metres(gone_m));
  });
  if (report?.object_m) row(say("report.object"), `${report.object_m.map((value) => metres(value)).join(", ")}`);
  return rows;
}

export function show_report() {
  const is_end = stage_of(model) === "end";
  show(by_id("report"), is_end);
  const news = is_end && !ended;
  ended = is_end;
  if (!is_end) return;
  document.body.dataset.end = end_key(model);
  const report = model.documents.report;
  const rows = rows_of(report);
  const now = JSON.stringify(rows);
  if (now !== drawn) {
    drawn = now;
    by_id("report-rows").replaceChildren(...rows.flatMap(([name, value]) => [make("dt", { text: name }), make("dd", { text: value })]));
  }
  show(by_id("report-file"), Boolean(report));
  if (news) {
    if (navigator.userActivation?.hasBeenActive !== false) navigator.vibrate?.(kVibrateMs);
    const finder = agents_of(model)[model.status.search.finder]?.name ?? "";
    set_text(by_id("loud"), say(`end.${end_key(model)}`, { finder, robot: agents_of(model)[0]?.name ?? "IVO" }));
  }
}
