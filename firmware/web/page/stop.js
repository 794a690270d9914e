// Stop: one touch, by anybody, on every screen and at any time. Nothing asks whether it was meant.
import { send } from "./socket.js";
import { allow, by_id } from "./dom.js";
import { has_controller } from "./judge.js";
import { model } from "./model.js";
import { toast } from "./toast.js";
import { say } from "./words.js";

const kAgainMs = 300;
const kTries = 4;

async function stop() {
  toast(say("stop.sent"));
  navigator.vibrate?.(60);
  for (let i = 0; i < kTries; i += 1) {
    const verdict = await send("stop");
    if (verdict === "accepted") return;
    toast(say(`verdict.${verdict}`));
    await new Promise((resolve) => setTimeout(resolve, kAgainMs));
  }
}

// On the way down, not up: the finger may slip off. A click follows for keyboards and screen readers only.
const button = by_id("stop");
let pressed_at_ms = -Infinity;
button.addEventListener("pointerdown", (event) => {
  if (event.button !== 0) return;
  pressed_at_ms = performance.now();
  stop();
});
button.addEventListener("click", () => {
  if (performance.now() - pressed_at_ms > 1000) stop();
});

export function show_stop() {
  allow(button, model.link === "open" && has_controller(model));
}
