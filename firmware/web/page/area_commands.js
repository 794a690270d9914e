// Areas are the controller's: this sends what somebody did to one, and keeps how to undo it.
import { areas_of } from "./judge.js";
import { changed, model } from "./model.js";
import { tell } from "./tell.js";

const kSlots = 32;
const kMostUndone = 100;
const undo_stack = [];  // of functions that send the inverse

function area_in(slot) {
  const area = areas_of(model).find((each) => each.slot === slot);
  return area ? { purpose: area.purpose, agent: area.agent, polygon_m: area.polygon_m } : null;
}

/// Null: all are taken.
export function free_slot() {
  const taken = new Set(areas_of(model).map((area) => area.slot));
  for (let slot = 0; slot < kSlots; slot += 1) {
    if (!taken.has(slot)) return slot;
  }
  return null;
}

function send_area(slot, area) {
  return area === null ? tell("area.remove", { slot }) : tell("area.put", { slot, ...area });
}

/// `area` null: removed. True when it was accepted.
export async function change_area(slot, area) {
  const before = area_in(slot);
  const accepted = await send_area(slot, area);
  if (accepted) {
    undo_stack.push({ slot, before });
    if (undo_stack.length > kMostUndone) undo_stack.shift();
  }
  changed();
  return accepted;
}

export function can_undo() {
  return undo_stack.length > 0;
}

/// The slot that it was about, or null.
export async function undo() {
  const last = undo_stack.pop();
  if (!last) return null;
  if (!(await send_area(last.slot, last.before))) undo_stack.push(last);
  changed();
  return last.slot;
}
