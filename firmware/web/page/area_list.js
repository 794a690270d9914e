// The list of areas, and how to make one: for whom, by hand or by numbers.
import { can_undo, change_area, keep_undo, undo } from "./area_commands.js";
import { may_change_areas } from "./areas.js";
import { agents_of, areas_of, is_operator } from "./judge.js";
import { allow, by_id, make, on_press, set_text, show } from "./dom.js";
import { area_m2, box_of } from "./geometry.js";
import { model } from "./model.js";
import { purpose_words, purposes } from "./purpose.js";
import { set_view, view } from "./view_state.js";
import { swatch } from "./hatch.js";
import { metres, number, percent, say } from "./words.js";

let drawn_list = "";
let drawn_choice = "";

export function size_words(area) {
  const box = box_of(area.polygon_m);
  const sizes = say("areas.size", { width: number(box.width_m, 1), height: metres(box.height_m) });
  const share = area.purpose === "preferred" ? say("areas.share", { share: percent(area.share) }) : "";
  return [sizes, say("unit.square_metres", { value: number(area.area_m2 ?? area_m2(area.polygon_m)) }), share].filter(Boolean).join(" · ");
}

function make_row(area, agents) {
  const words = purpose_words(agents, area);
  const select = make("button", { type: "button", class: "area-row", id: `area-${area.slot}`, "data-slot": String(area.slot), "aria-pressed": String(view.selected === area.slot) },
    swatch(agents, area.purpose, area.agent),
    make("span", { class: "area-words" }, make("strong", { text: words }), make("span", { class: "quiet", text: size_words(area) })));
  select.addEventListener("click", () => set_view({ selected: view.selected === area.slot ? null : area.slot, tool: null }));
  const remove = make("button", { type: "button", class: "plain icon", id: `area-remove-${area.slot}`, "aria-label": say("areas.remove", { words }), "data-slot": String(area.slot) });
  remove.append(make("span", { class: "icon-bin", "aria-hidden": "true" }));
  allow(remove, may_change_areas());
  on_press(remove, () => {
    if (view.selected === area.slot) set_view({ selected: null });
    change_area(area.slot, null);
  });
  return make("li", {}, select, remove);
}

function show_list() {
  const agents = agents_of(model);
  const areas = areas_of(model);
  const now = JSON.stringify([areas, agents.length, view.selected, may_change_areas(), document.documentElement.lang]);
  if (now === drawn_list) return;
  drawn_list = now;
  const focused = document.activeElement?.id;
  by_id("area-list").replaceChildren(...areas.map((area) => make_row(area, agents)));
  if (focused?.startsWith("area-")) by_id(focused)?.focus();
  show(by_id("areas-none"), areas.length === 0);
}

function show_choice() {
  const agents = agents_of(model);
  if (view.purpose === null && agents.length > 0) view.purpose = purposes(agents)[0];
  const offered = purposes(agents).slice(0, agents.length + 1);  // no-go for one agent is in the form
  const now = JSON.stringify([offered, document.documentElement.lang]);
  if (now !== drawn_choice) {
    drawn_choice = now;
    by_id("purposes").replaceChildren(...offered.map((text) => make_choice(text, agents)));
  }
  for (const input of by_id("purposes").querySelectorAll("input")) {
    input.checked = input.value === view.purpose;
    input.parentElement.classList.toggle("chosen", input.checked);
  }
}

function make_choice(text, agents) {
  const [kind, agent] = text.split(":");
  const area = { purpose: kind === "prefer" ? "preferred" : "no_go", agent: agent === "" ? null : Number(agent) };
  const input = make("input", { type: "radio", name: "purpose", value: text, id: `purpose-${text.replace(":", "-")}` });
  input.addEventListener("change", () => set_view({ purpose: text }));
  const words = area.purpose === "preferred" ? agents[area.agent].name : say("purpose.no_go_short");
  return make("label", { class: "choice" }, input, swatch(agents, area.purpose, area.agent), make("span", { text: words }));
}

export function show_area_list() {
  keep_undo();
  show_choice();
  show_list();
  const may = may_change_areas();
  for (const tool of ["rectangle", "polygon"]) {
    allow(by_id(`draw-${tool}`), may);
    by_id(`draw-${tool}`).setAttribute("aria-pressed", String(view.tool === tool));
  }
  allow(by_id("area-numbers"), may);
  allow(by_id("undo"), may && can_undo());
  show(by_id("areas-locked"), !may);
  set_text(by_id("areas-locked"), say(is_operator(model) ? "areas.ended" : "areas.watching"));
}

for (const tool of ["rectangle", "polygon"]) {
  on_press(by_id(`draw-${tool}`), () => set_view({ tool: view.tool === tool ? null : tool, selected: null }));
}
on_press(by_id("undo"), undo);
addEventListener("keydown", (event) => {
  const typing = event.target instanceof HTMLInputElement && event.target.type !== "radio";
  if ((event.ctrlKey || event.metaKey) && event.key === "z" && !typing && may_change_areas() && can_undo()) {
    event.preventDefault();
    undo();
  }
});

