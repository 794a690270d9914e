// How the plan gets better while it is made: the time that it minimises, at each best plan so far.
import { by_id, make_svg } from "./dom.js";
import { model } from "./model.js";

const kWide = 300;
const kHigh = 72;
const kEdge = 6;

let number = null;
let points = [];  // of one plan: its step and its time

function minimised_s(plan) {
  return plan.score?.expected_sub_prior_time_s ?? plan.score?.expected_time_s ?? null;
}

function note(plan) {
  if (plan.number !== number) {
    number = plan.number;
    points = [];
  }
  const time_s = minimised_s(plan);
  if (time_s !== null && points.at(-1)?.step !== plan.generation) points.push({ step: plan.generation, time_s });
}

/// Steps down from left to right, over the whole width of the bar above it.
export function show_progress_line() {
  const { plan } = model.documents;
  const planning = model.status?.mode === "planning";
  if (plan) note(plan);
  const shown = planning && points.length > 0 && number === model.status.plan.number;
  const node = by_id("progress-line");
  node.toggleAttribute("hidden", !shown);
  if (!shown) return;
  const most_s = Math.max(...points.map((point) => point.time_s));
  const least_s = Math.min(...points.map((point) => point.time_s));
  const span_s = Math.max(most_s - least_s, 0.1 * most_s, 0.001);
  const x = (step) => (kWide * step) / Math.max(model.status.plan.generations, 1);
  const y = (time_s) => kEdge + ((most_s - time_s) / span_s) * (kHigh - 2 * kEdge);
  const steps = points.map((point, i) => `${i === 0 ? "M" : "H"}${x(point.step)}${i === 0 ? " " : "V"}${y(point.time_s)}`).join("");
  const end = `H${x(Math.max(model.status.plan.generation, points.at(-1).step))}`;
  const line = `${steps}${end}`;
  if (node.dataset.line === line) return;
  node.dataset.line = line;
  node.replaceChildren(
    make_svg("path", { class: "under", d: `${line}V${kHigh}H${x(points[0].step)}Z` }), make_svg("path", { class: "line", d: line }));
}
