// Areas on the map. The one that is selected can be dragged, and has handles (handles.js).
import { agents_of, areas_of, is_operator } from "./judge.js";
import { change_area } from "./area_commands.js";
import { hatch_of, line_of } from "./hatch.js";
import { show_handles } from "./handles.js";
import { corners, map, renderers } from "./map.js";
import { model } from "./model.js";
import { moved, snapped } from "./geometry.js";
import { on_drag } from "./pointer_drag.js";
import { set_view, view } from "./view_state.js";

const shapes = new Map();  // by slot
let held = null;           // { slot, polygon_m } while somebody drags, until the controller has said it back

export function may_change_areas() {
  return is_operator(model) && model.status?.finished === false;
}

function make_shape(slot) {
  const shape = L.polygon([], { renderer: renderers.areas, pane: "areas", weight: 3, fillOpacity: 1, smoothFactor: 0, lineJoin: "round" });
  shape.addTo(map);
  const node = shape.getElement();
  node.dataset.slot = String(slot);
  node.classList.add("area");
  let from = null;
  let polygon = null;
  on_drag(node, {
    start(place) {
      if (view.tab !== "areas" && view.selected !== slot) return false;
      from = place;
      polygon = areas_of(model).find((each) => each.slot === slot)?.polygon_m ?? null;
      // Only what is selected moves: a map that is pushed around takes no area along.
      return polygon !== null && may_change_areas() && view.selected === slot;
    },
    move(place) { hold(slot, moved(polygon, place[0] - from[0], place[1] - from[1], model.documents.mission.map)); },
    end(place, has_moved) {
      if (has_moved) drop();
    },
    cancel: let_go,
  });
  shape.on("click", (event) => {
    L.DomEvent.stop(event);
    if (view.tool === null) set_view({ selected: slot, tab: "areas" });
  });
  return shape;
}

/// As it is under the finger now.
function hold(slot, polygon_m) {
  held = { slot, polygon_m };
  show_areas();
}

async function drop() {
  const { slot, polygon_m } = held;
  const area = areas_of(model).find((each) => each.slot === slot);
  const mine = held;
  if (area) {
    await change_area(slot, {
      purpose: area.purpose, agent: area.agent, polygon_m: polygon_m.map((corner) => snapped(corner, model.documents.mission.map)) });
  }
  // The document with the change comes before or with the answer; when not, the old place flashes and no more.
  if (held === mine) let_go();
}

function let_go() {
  held = null;
  show_areas();
}

export function show_areas() {
  const agents = agents_of(model);
  const areas = areas_of(model);
  for (const [slot, shape] of shapes) {
    if (areas.some((area) => area.slot === slot)) continue;
    shape.remove();
    shapes.delete(slot);
  }
  for (const area of areas) {
    if (!shapes.has(area.slot)) shapes.set(area.slot, make_shape(area.slot));
    const shape = shapes.get(area.slot);
    const polygon = held?.slot === area.slot ? held.polygon_m : area.polygon_m;
    const selected = view.selected === area.slot && view.tab === "areas";
    const calm = view.tab !== "areas";
    const look = JSON.stringify([polygon, area.purpose, area.agent, selected, calm]);
    if (shape.look === look) continue;
    shape.look = look;
    shape.setLatLngs(corners(polygon));
    shape.setStyle({
      color: line_of(agents, area.purpose, area.agent), fillColor: hatch_of(agents, area.purpose, area.agent), weight: selected ? 5 : 3,
      fillOpacity: calm ? 0.6 : 1, dashArray: area.purpose === "no_go" ? null : "2 7" });
  }
  const chosen = areas.find((area) => area.slot === view.selected);
  const editable = chosen && view.tab === "areas" && view.tool === null && may_change_areas();
  show_handles(editable ? { slot: chosen.slot, polygon_m: held?.slot === chosen.slot ? held.polygon_m : chosen.polygon_m } : null, { hold, drop, let_go });
}
