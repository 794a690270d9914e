// A button that acts only when it is held: by finger, mouse, or Enter and Space. Let go, left, or asked about something else,
// it does nothing.
import { allowed } from "./dom.js";

const kHoldMs = 1500;
const kLongestFrameMs = 100;

/// `what()` names the question; `act(question)` when it was held for as long as that, and the question is the same.
/// `tick()` is to be called whenever the question may have changed.
export function make_hold(button, ring, what, act) {
  let held_ms = null;
  let last_ms = 0;
  let question = null;
  let frame = 0;

  function show_share(share) {
    ring.style.strokeDashoffset = String(1 - share);
    button.classList.toggle("held", share > 0);
  }

  function begin() {
    if (held_ms !== null || !allowed(button)) return;
    held_ms = 0;
    last_ms = performance.now();
    question = what();
    frame = requestAnimationFrame(grow);
  }

  function cancel() {
    held_ms = null;
    cancelAnimationFrame(frame);
    show_share(0);
  }

  function grow(now_ms) {
    if (held_ms === null) return;
    if (!allowed(button) || what() !== question) return cancel();
    // A page that hung for a while does not count that as held.
    held_ms += Math.min(Math.max(now_ms - last_ms, 0), kLongestFrameMs);
    last_ms = Math.max(now_ms, last_ms);
    const share = held_ms / kHoldMs;
    if (share < 1) {
      show_share(Math.max(share, 0.01));
      frame = requestAnimationFrame(grow);
      return;
    }
    cancel();
    act(question);
  }

  button.addEventListener("pointerdown", (event) => {
    if (!event.isPrimary || event.button !== 0) return;
    begin();
  });
  for (const type of ["pointerup", "pointerleave", "pointercancel", "blur"]) button.addEventListener(type, cancel);
  const is_key = (event) => event.key === " " || event.key === "Enter";
  button.addEventListener("keydown", (event) => {
    if (!is_key(event)) return;
    event.preventDefault();
    if (!event.repeat) begin();
  });
  button.addEventListener("keyup", (event) => {
    if (is_key(event)) cancel();
  });
  button.addEventListener("contextmenu", (event) => event.preventDefault());
  addEventListener("blur", cancel);
  document.addEventListener("visibilitychange", cancel);

  return {
    tick() {
      if (held_ms !== null && (!allowed(button) || what() !== question)) cancel();
    },
  };
}
