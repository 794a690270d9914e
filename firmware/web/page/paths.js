// Both plans on the map: which way, how far it has gone, what is left. And the plan before, as a thin grey ghost.
import { agents_of, done_m, stage_of } from "./judge.js";
import { arrows_along, cut } from "./geometry.js";
import { style_of } from "./colours.js";
import { at, corners, map, pixels_per_metre, renderers } from "./map.js";
import { model } from "./model.js";
import { view } from "./view_state.js";

const kArrowEvery_px = 78;
const kArrow_px = 15;
const kNewDone_m = 0.05;

const group = L.layerGroup();
let drawn = {};  // what the lines were drawn from

function line(path, options) {
  return L.polyline(corners(path), {
    renderer: renderers.paths, pane: "paths", interactive: false, smoothFactor: 0, lineJoin: "round", ...options });
}

function draw_path(path, gone_m, style, agent) {
  const [gone, left] = gone_m === null ? [[], path] : cut(path, gone_m);
  const dash = style.dash;
  if (gone.length > 1) group.addLayer(line(gone, { color: style.line, weight: 3, opacity: 0.35, className: `path-gone path-${agent}` }));
  if (left.length > 1) {
    group.addLayer(line(left, { color: "#fff", weight: 8, opacity: 0.85 }));
    group.addLayer(line(left, { color: style.line, weight: 4.5, opacity: 1, dashArray: dash, lineCap: dash ? "butt" : "round", className: `path-left path-${agent}` }));
    const scale = pixels_per_metre();
    const arrows = arrows_along(left, kArrowEvery_px / scale, kArrow_px / scale);
    group.addLayer(L.polygon(arrows.map((arrow) => [corners(arrow)]), {
      renderer: renderers.paths, pane: "paths", interactive: false, smoothFactor: 0, color: "#fff", weight: 1.5,
      fillColor: style.line, fillOpacity: 1, className: `path-arrows path-${agent}` }));
    end_mark(left[left.length - 1], style);
  }
}

function end_mark(place, style) {
  group.addLayer(L.circleMarker(at(place), {
    renderer: renderers.paths, pane: "paths", interactive: false, radius: 5, color: style.line, weight: 3, fillColor: "#fff", fillOpacity: 1 }));
}

function draw_ghost(plan, agents) {
  plan.agents.forEach((path, i) => {
    group.addLayer(line(path.waypoints_m, { color: "#fff", weight: 5, opacity: 0.6 }));
    group.addLayer(line(path.waypoints_m, { color: "#4c5258", weight: 2, dashArray: style_of(agents, i).dash ?? "1 0", className: "path-previous" }));
  });
}

function same(now) {
  const { gone, ...rest } = now;
  if (Object.entries(rest).some(([key, value]) => drawn[key] !== value)) return false;
  return gone.every((value, i) => value === drawn.gone[i] ||
    (value !== null && drawn.gone[i] !== null && Math.abs(value - drawn.gone[i]) < kNewDone_m));
}

export function show_paths() {
  const { plan, previous_plan } = model.documents;
  const agents = agents_of(model);
  const now = {
    plan: view.layers.plan ? plan : null,
    previous: view.layers.previous ? previous_plan : null,
    zoom: map.getZoom(),
    agents,
    stage: stage_of(model),
    gone: (plan?.agents ?? []).map((_, i) => done_m(model, i)),
  };
  if (same(now)) return;
  drawn = now;
  group.clearLayers();
  if (!map.hasLayer(group)) group.addTo(map);
  if (now.previous) draw_ghost(now.previous, agents);
  // The robot's on top: it is the one that is to be watched.
  if (now.plan) [...now.plan.agents.entries()].reverse().forEach(([i, path]) => draw_path(path.waypoints_m, now.gone[i], style_of(agents, i), i));
}
