// What this screen shows and holds: nothing of it concerns the robot, and other screens have their own.
import { changed } from "./model.js";

export const view = {
  tab: "search",        // search, areas, screens
  selected: null,       // slot of the area that is being changed
  tool: null,           // null, rectangle, polygon; position
  tool_agent: null,     // whose position
  purpose: null,        // "prefer:1", "no_go": of the next area
  layers: { ground: "map", probability: true, searched: true, plan: true, previous: false, sensors: true },
};

export function set_view(values) {
  Object.assign(view, values);
  changed();
}

export function show_layer(name, value) {
  view.layers[name] = value;
  changed();
}
