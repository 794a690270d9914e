// Drawing a new area by hand: a rectangle by a drag, a polygon by taps; and the tap that says where a person is.
import { can_be_placed, tell_position } from "./agents.js";
import { change_area, free_slot } from "./area_commands.js";
import { hatch_of, line_of } from "./hatch.js";
import { agents_of } from "./judge.js";
import { by_id, on_press, set_text, show } from "./dom.js";
import { box_of, distance_m, is_simple, rectangle, snapped } from "./geometry.js";
import { at, corners, map, pixels_per_metre, place_of } from "./map.js";
import { model } from "./model.js";
import { no_fling } from "./pointer_drag.js";
import { purpose_of } from "./purpose.js";
import { set_view, view } from "./view_state.js";
import { clear_toast, toast } from "./toast.js";
import { say } from "./words.js";

const kMostCorners = 64;
const kClose_px = 28;       // of the first corner: a finger's width
const kLeastSide_m = 0.3;

const sheet = by_id("draw");
let places = [];   // corners so far
let from = null;   // first corner of a rectangle
let sketch = null;
let first_mark = null;

function clear() {
  places = [];
  from = null;
  for (const layer of [sketch, first_mark]) layer?.remove();
  sketch = null;
  first_mark = null;
}

function draw_sketch(polygon, closed) {
  const { purpose, agent } = purpose_of(view.purpose);
  const agents = agents_of(model);
  const style = { pane: "areas", interactive: false, color: line_of(agents, purpose, agent), weight: 4, smoothFactor: 0,
    fill: closed, fillColor: hatch_of(agents, purpose, agent), fillOpacity: 1 };
  sketch?.remove();
  sketch = (closed ? L.polygon : L.polyline)(corners(polygon), style).addTo(map);
}

function mark_corners() {
  first_mark?.remove();
  first_mark = L.layerGroup(places.map((place, i) => L.circleMarker(at(place), {
    pane: "handles", interactive: false, radius: i === 0 ? 13 : 7, color: "#16191d", weight: 3, fillColor: i === 0 ? "#ffd84d" : "#fff", fillOpacity: 1,
    className: i === 0 ? "first-corner" : "" }))).addTo(map);
}

async function finish(polygon) {
  const slot = free_slot();
  clear();
  if (slot === null) return toast(say("areas.full"));
  if (!is_simple(polygon)) return toast(say("areas.crossing"));
  clear_toast();
  set_view({ tool: null });
  if (await change_area(slot, { ...purpose_of(view.purpose), polygon_m: polygon })) set_view({ selected: slot });
}

function add_corner(place) {
  const closes = places.length >= 3 && distance_m(place, places[0]) * pixels_per_metre() < kClose_px;
  if (closes) return finish(places.slice());
  if (places.length >= kMostCorners) return toast(say("areas.many_corners"));
  places.push(place);
  draw_sketch(places, places.length > 2);
  mark_corners();
  show_draw();
}

function on_map(event) {
  return snapped(place_of(event), model.documents.mission.map);
}

sheet.addEventListener("pointerdown", (event) => {
  if (!event.isPrimary || event.button !== 0 || view.tool !== "rectangle") return;
  sheet.setPointerCapture(event.pointerId);
  from = on_map(event);
});
sheet.addEventListener("pointermove", (event) => {
  if (event.isPrimary && from !== null) draw_sketch(rectangle(box_of([from, on_map(event)])), true);
});
sheet.addEventListener("pointercancel", clear);
no_fling(sheet);
sheet.addEventListener("pointerup", (event) => {
  if (!event.isPrimary || !model.documents.mission) return;
  if (view.tool === "position") {
    const agent = view.tool_agent;
    set_view({ tool: null });
    if (can_be_placed(agent)) tell_position(agent, on_map(event));
  }
  if (view.tool === "polygon") add_corner(on_map(event));
  if (view.tool === "rectangle" && from !== null) {
    const box = box_of([from, on_map(event)]);
    clear();
    if (Math.min(box.width_m, box.height_m) < kLeastSide_m) return toast(say("areas.drag_more"));
    finish(rectangle(box));
  }
});

on_press(by_id("draw-done"), () => finish(places.slice()));
on_press(by_id("draw-back"), () => {
  places.pop();
  if (places.length === 0) return clear(), show_draw();
  draw_sketch(places, places.length > 2);
  mark_corners();
  show_draw();
});
on_press(by_id("draw-cancel"), () => set_view({ tool: null }));
addEventListener("keydown", (event) => {
  if (event.key === "Escape" && view.tool !== null) set_view({ tool: null });
});

export function show_draw() {
  // Nothing that is drawn now would arrive.
  if (view.tool !== null && model.link !== "open") view.tool = null;
  if (view.tool !== "polygon" && view.tool !== "rectangle" && (sketch || first_mark)) clear();
  document.body.dataset.tool = view.tool ?? "";
  show(sheet, view.tool !== null);
  show(by_id("draw-bar"), view.tool !== null);
  if (view.tool === null) return;
  const name = agents_of(model)[view.tool_agent]?.name ?? "";
  set_text(by_id("draw-hint"), say(`draw.${view.tool}`, { name }));
  show(by_id("draw-done"), view.tool === "polygon" && places.length >= 3);
  show(by_id("draw-back"), view.tool === "polygon" && places.length > 0);
}
