// Handles on the corners of the area that is selected. A rectangle stays one; of a polygon each corner goes its own way.
import { box_of, is_rectangle, is_simple, snapped } from "./geometry.js";
import { make } from "./dom.js";
import { at, map } from "./map.js";
import { model } from "./model.js";
import { on_drag } from "./pointer_drag.js";

let handles = [];
let shown = null;  // { slot, polygon_m }
let then = null;   // what to do with a change
let dragging = false;

const same = (a, b) => Math.abs(a - b) < 1e-6;

function with_corner(polygon, i, place) {
  if (!is_rectangle(polygon)) return polygon.map((corner, k) => (k === i ? place : corner));
  const old = polygon[i];
  return polygon.map((corner, k) => {
    if (k === (i + 2) % 4) return corner;
    return [same(corner[0], old[0]) ? place[0] : corner[0], same(corner[1], old[1]) ? place[1] : corner[1]];
  });
}

function make_handle(i) {
  const node = make("div", { class: "handle", "data-corner": String(i) });
  const marker = L.marker([0, 0], {
    pane: "handles", keyboard: false, interactive: false, icon: L.divIcon({ className: "handle-place", html: node, iconSize: [48, 48] }) });
  marker.addTo(map);
  let before = null;
  on_drag(node, {
    start() {
      before = shown.polygon_m;
      dragging = true;
      return true;
    },
    move(place) {
      const changed = with_corner(before, i, snapped(place, model.documents.mission.map));
      if (is_simple(changed)) then.hold(shown.slot, changed);
    },
    end(place, has_moved) {
      dragging = false;
      if (has_moved) then.drop();
    },
    cancel() {
      dragging = false;
      then.let_go();
    },
  });
  return marker;
}

const kOut_px = 15;

// The place for the finger lies more outside than inside: of a small area something is left to take the whole by.
function lean_out(node, corner, centre) {
  if (!node) return;
  const x = corner[0] - centre[0];
  const y = corner[1] - centre[1];
  const far = Math.hypot(x, y) || 1;
  node.style.setProperty("--out-x", `${(kOut_px * x) / far}px`);
  node.style.setProperty("--out-y", `${(-kOut_px * y) / far}px`);
}

/// Null: none. `actions`: hold(slot, polygon), drop() and let_go().
export function show_handles(area, actions) {
  then = actions;
  const count = area?.polygon_m.length ?? 0;
  if (!dragging && (shown?.slot !== area?.slot || handles.length !== count)) {
    for (const handle of handles) handle.remove();
    handles = Array.from({ length: count }, (_, i) => make_handle(i));
  }
  shown = area;
  if (!area) return;
  const box = box_of(area.polygon_m);
  const centre = [box.x_m + box.width_m / 2, box.y_m + box.height_m / 2];
  area.polygon_m.forEach((corner, i) => {
    handles[i]?.setLatLng(at(corner));
    lean_out(handles[i]?.options.icon.options.html, corner, centre);
  });
}
