// Areas are the controller's: this sends what somebody did to one, and keeps how to undo it.
import { areas_of, is_operator } from "./judge.js";
import { changed, model } from "./model.js";
import { tell } from "./tell.js";

const kSlots = 32;
const kMostUndone = 100;
const undo_stack = [];  // each a Map: by slot, what it held before; null: nothing

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
  if (accepted) push(new Map([[slot, before]]));
  changed();
  return accepted;
}

/// What they are now, for note_replaced().
export function all_areas() {
  return new Map(Array.from({ length: kSlots }, (_, slot) => [slot, area_in(slot)]));
}

/// Another way has put others in their place: one step to undo.
export function note_replaced(before) {
  push(before);
  changed();
}

let mission = null;

/// Others may change areas meanwhile, and another mission has others: nothing is undone that somebody else did.
export function keep_undo() {
  const other = mission !== null && model.documents.mission?.name !== mission;
  if ((model.link === "open" && model.status?.n > 0 && !is_operator(model)) || other) undo_stack.length = 0;
  mission = model.documents.mission?.name ?? mission;
}

function push(step) {
  undo_stack.push(step);
  if (undo_stack.length > kMostUndone) undo_stack.shift();
}

export function can_undo() {
  return undo_stack.length > 0;
}

const is_same = (a, b) => JSON.stringify(a) === JSON.stringify(b);

/// False: not, or not wholly. What is left of the step can be undone again.
export async function undo() {
  const step = undo_stack.pop();
  if (!step) return false;
  const left = [...step].filter(([slot, area]) => step.size === 1 || !is_same(area, area_in(slot)));
  const sent = await Promise.all(left.map(([slot, area]) => send_area(slot, area)));
  const failed = left.filter((_, i) => !sent[i]);
  if (failed.length > 0) push(new Map(failed));
  changed();
  return failed.length === 0;
}
