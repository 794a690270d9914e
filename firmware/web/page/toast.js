// A sentence that stays for a few seconds, seen and read aloud.
import { by_id, set_text, show } from "./dom.js";

const kStaysMs = 6000;
let timer = 0;

export function toast(text) {
  const node = by_id("toast");
  set_text(node, text);
  show(node, true);
  clearTimeout(timer);
  timer = setTimeout(() => show(node, false), kStaysMs);
}

/// What it said is settled.
export function clear_toast() {
  show(by_id("toast"), false);
}
