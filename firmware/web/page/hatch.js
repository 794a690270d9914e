// How areas are filled: hatched in the agent's colour and at the agent's slope, no-go areas crosshatched dark.
import { kNoGo, style_of } from "./colours.js";
import { by_id, make_svg } from "./dom.js";

const kEvery_px = 11;

function pattern(id, style, crossed) {
  const lines = [make_svg("path", { d: `M0 0V${kEvery_px}`, stroke: style.line, "stroke-width": crossed ? 2.4 : 3, "stroke-opacity": crossed ? 0.8 : 0.5 })];
  if (crossed) lines.push(make_svg("path", { d: `M0 0H${kEvery_px}`, stroke: style.line, "stroke-width": 2.4, "stroke-opacity": 0.8 }));
  const ground = make_svg("rect", { width: kEvery_px, height: kEvery_px, fill: crossed ? "#fff" : style.line, "fill-opacity": crossed ? 0.35 : 0.07 });
  return make_svg("pattern", {
    id, width: kEvery_px, height: kEvery_px, patternUnits: "userSpaceOnUse", patternTransform: `rotate(${style.hatch_deg})` }, ground, ...lines);
}

function hatch_id(purpose, agent) {
  return purpose === "no_go" ? "hatch-no-go" : `hatch-${agent}`;
}

/// For a fill. The pattern is made when it is first asked for.
export function hatch_of(agents, purpose, agent) {
  const id = hatch_id(purpose, agent);
  if (!by_id(id)) {
    by_id("patterns").append(purpose === "no_go" ? pattern(id, kNoGo, true) : pattern(id, style_of(agents, agent), false));
  }
  return `url(#${id})`;
}

export function line_of(agents, purpose, agent) {
  return purpose === "no_go" ? kNoGo.line : style_of(agents, agent).line;
}

/// The same as a small square beside words.
export function swatch(agents, purpose, agent) {
  const fill = hatch_of(agents, purpose, agent);
  return make_svg("svg", { class: "swatch", viewBox: "0 0 32 32", "aria-hidden": "true" },
    make_svg("rect", { x: 2, y: 2, width: 28, height: 28, rx: 5, fill, stroke: line_of(agents, purpose, agent), "stroke-width": 3 }));
}
