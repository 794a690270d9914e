// An area by numbers, for keyboards and for who knows the metres: a new rectangle, or the box of the one that is selected.
import { change_area, free_slot } from "./area_commands.js";
import { may_change_areas } from "./areas.js";
import { agents_of, areas_of } from "./judge.js";
import { allow, by_id, make, on_press, set_text, show } from "./dom.js";
import { box_of, fit_into, rectangle } from "./geometry.js";
import { model } from "./model.js";
import { purpose_of, purpose_words, purposes, text_of } from "./purpose.js";
import { set_view, view } from "./view_state.js";
import { toast } from "./toast.js";
import { number, say } from "./words.js";

const kFields = { x: "x_m", y: "y_m", width: "width_m", height: "height_m" };
const kLeastSide_m = 0.3;
let is_new = false;
let filled = "";
let offered = "";

function field(name) {
  return by_id(`form-${name}`);
}

function selected_area() {
  return areas_of(model).find((area) => area.slot === view.selected) ?? null;
}

function fill(box, purpose) {
  for (const [name, key] of Object.entries(kFields)) field(name).value = (Math.round(box[key] * 100) / 100).toString();
  field("purpose").value = purpose;
}

function read() {
  return Object.fromEntries(Object.entries(kFields).map(([name, key]) => [key, field(name).valueAsNumber]));
}

function fault_of(box, size) {
  if (Object.values(box).some((value) => !Number.isFinite(value))) return say("form.no_number");
  if (Math.min(box.width_m, box.height_m) < kLeastSide_m) return say("form.small", { least: number(kLeastSide_m, 1) });
  const inside = box.x_m >= 0 && box.y_m >= 0 && box.x_m + box.width_m <= size.width_m + 0.005 && box.y_m + box.height_m <= size.height_m + 0.005;
  return inside ? null : say("form.off_map", { width: number(size.width_m, 1), height: number(size.height_m, 1) });
}

async function save() {
  const box = read();
  const fault = fault_of(box, model.documents.mission.map);
  if (fault !== null) return toast(fault);
  const purpose = purpose_of(field("purpose").value);
  const old = selected_area();
  const slot = is_new ? free_slot() : old?.slot ?? null;
  if (slot === null) return toast(say("areas.full"));
  const polygon_m = is_new ? rectangle(box) : fit_into(old.polygon_m, box);
  if (await change_area(slot, { ...purpose, polygon_m })) {
    is_new = false;
    set_view({ selected: slot });
  }
}

function offer_purposes() {
  const agents = agents_of(model);
  const now = JSON.stringify([agents, document.documentElement.lang]);
  if (now === offered) return;
  offered = now;
  const kept = field("purpose").value;
  field("purpose").replaceChildren(...purposes(agents).map((text) =>
    make("option", { value: text, text: purpose_words(agents, purpose_of(text)) })));
  if (kept) field("purpose").value = kept;
}

export function show_area_form() {
  const area = selected_area();
  offer_purposes();
  if (area) is_new = false;
  show(by_id("area-form"), is_new || area !== null);
  set_text(by_id("form-title"), say(is_new ? "form.new" : "form.change"));
  allow(by_id("form-save"), may_change_areas());
  // What somebody is typing stays, until the area itself is another.
  const now = area ? JSON.stringify([area.slot, area.purpose, area.agent, area.polygon_m]) : "";
  if (area && now !== filled) fill(box_of(area.polygon_m), text_of(area));
  filled = now;
}

on_press(by_id("area-numbers"), () => {
  is_new = true;
  set_view({ selected: null, tool: null });
  const { width_m, height_m } = model.documents.mission.map;
  offer_purposes();
  fill({ x_m: Math.round(width_m / 3), y_m: Math.round(height_m / 3), width_m: Math.round(width_m / 4), height_m: Math.round(height_m / 4) }, view.purpose);
  show(by_id("area-form"), true);
  field("x").focus();
});
by_id("area-form").addEventListener("submit", (event) => {
  event.preventDefault();
  save();
});
on_press(by_id("form-cancel"), () => {
  is_new = false;
  set_view({ selected: null });
});
