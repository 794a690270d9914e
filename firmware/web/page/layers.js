// What lies over the map, and what its colours mean.
import { by_id, make, on_press, set_attribute, show } from "./dom.js";
import { agents_of } from "./judge.js";
import { badge } from "./search.js";
import { faded } from "./grids.js";
import { make_svg } from "./dom.js";
import { model } from "./model.js";
import { style_of } from "./colours.js";
import { show_layer, view } from "./view_state.js";
import { show_whole, zoom_by } from "./map.js";
import { recall, remember } from "./memory.js";
import { say, say_or } from "./words.js";

const kOver = ["probability", "searched", "plan", "previous", "sensors"];
let open = false;
let drawn = "";

function line_sample(style) {
  const attributes = { d: "M2 8H46", stroke: style.line, "stroke-width": 4.5 };
  if (style.dash) attributes["stroke-dasharray"] = style.dash;
  return make_svg("svg", { class: "line-sample", viewBox: "0 0 48 16", "aria-hidden": "true" },
    make_svg("path", attributes), make_svg("path", { d: "M31 2L43 8 31 14l3-6z", fill: style.line, stroke: "#fff", "stroke-width": 1 }));
}

function show_legend() {
  const agents = agents_of(model);
  const classes = model.documents.mission?.classes ?? [];
  const now = JSON.stringify([agents, classes, document.documentElement.lang]);
  if (now === drawn) return;
  drawn = now;
  by_id("legend").replaceChildren(...agents.map((agent, i) =>
    make("p", {}, badge(agents, i), line_sample(style_of(agents, i)), make("span", { text: `${agent.name} – ${say(`kind.${agent.kind}`)}` }))));
  by_id("class-list").replaceChildren(...classes.map((entry) => {
    const square = make("span", { class: "class-square", "aria-hidden": "true" });
    square.style.backgroundColor = `rgb(${faded(entry.colour).join(" ")})`;
    return make("li", {}, square, make("span", { text: say_or(`class.${entry.name}`, entry.name) }));
  }));
}

export function show_layers() {
  show(by_id("layers"), open);
  set_attribute(document.body, "data-layers", open ? "open" : "closed");
  set_attribute(by_id("layers-button"), "aria-expanded", String(open));
  show(by_id("grounds"), model.documents.mission?.map.aerial === true);
  if (view.layers.ground === "aerial" && model.documents.mission && !model.documents.mission.map.aerial) view.layers.ground = "map";
  if (open) show_legend();
}

for (const name of kOver) {
  const box = by_id(`layer-${name}`);
  const kept = recall(`layer.${name}`);
  if (kept !== null) view.layers[name] = kept === "yes";
  box.checked = view.layers[name];
  box.addEventListener("change", () => {
    remember(`layer.${name}`, box.checked ? "yes" : "no");
    show_layer(name, box.checked);
  });
}
for (const name of ["map", "aerial"]) {
  const choice = by_id(`layer-${name}`);
  choice.checked = view.layers.ground === name;
  choice.addEventListener("change", () => show_layer("ground", name));
}
on_press(by_id("layers-button"), () => {
  open = !open;
  show_layers();
});
addEventListener("keydown", (event) => {
  if (event.key === "Escape" && open) {
    open = false;
    show_layers();
    by_id("layers-button").focus();
  }
});
by_id("map").addEventListener("pointerdown", () => {
  if (!open) return;
  open = false;
  show_layers();
});
on_press(by_id("zoom-in"), () => zoom_by(0.5));
on_press(by_id("zoom-out"), () => zoom_by(-0.5));
on_press(by_id("zoom-whole"), show_whole);
