// Points that other programs see: what the laser meets, people.
import { at, map, renderers } from "./map.js";
import { model } from "./model.js";
import { view } from "./view_state.js";

const kOldAfter_s = 2;
const kLooks = {
  scan: { radius: 1.8, color: "#004a9e", fillColor: "#004a9e", weight: 0, fillOpacity: 0.9 },
  people: { radius: 9, color: "#00703c", fillColor: "#fff", weight: 3, fillOpacity: 0.6 },
  robot_pose: { radius: 7, color: "#c4122a", fillColor: "#fff", weight: 3, fillOpacity: 0.6 },
};
const groups = {};  // by name: the layer and the message that it shows

export function show_sensors() {
  const now_ms = performance.now();
  for (const [name, look] of Object.entries(kLooks)) {
    const message = model.layers[name];
    const age_s = message ? message.age_s + (now_ms - message.came_at_ms) / 1000 : Infinity;
    const shown = view.layers.sensors && age_s < kOldAfter_s ? message : null;
    groups[name] ??= { group: L.layerGroup().addTo(map), message: null };
    if (groups[name].message === shown) continue;
    groups[name].message = shown;
    groups[name].group.clearLayers();
    for (const place of shown?.points_m ?? []) {
      groups[name].group.addLayer(L.circleMarker(at(place), { renderer: renderers.sensors, pane: "sensors", interactive: false, ...look }));
    }
  }
}
