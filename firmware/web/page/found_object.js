// Where the object was, once the report says it: a star, as in the pictures of `ivo`.
import { make, make_svg } from "./dom.js";
import { at, map } from "./map.js";
import { model } from "./model.js";

let marker = null;
let shown = null;

export function show_object() {
  const place = model.documents.report?.object_m ?? null;
  if (JSON.stringify(place) === shown) return;
  shown = JSON.stringify(place);
  marker?.remove();
  marker = null;
  if (!Array.isArray(place)) return;
  const star = make_svg("svg", { viewBox: "0 0 24 24", class: "object-star", "aria-hidden": "true" },
    make_svg("path", { d: "M12 1.8l3.1 6.6 7.2.9-5.3 5 1.4 7.1L12 17.9l-6.4 3.5 1.4-7.1-5.3-5 7.2-.9z" }));
  const icon = L.divIcon({ className: "agent-place", html: make("div", { id: "object-mark" }, star), iconSize: [36, 36] });
  marker = L.marker(at(place), { pane: "agents", interactive: false, keyboard: false, icon }).addTo(map);
}
