// Says to the server that somebody can see this page. Only a frame that was drawn in time says so: a page that hangs, is
// hidden, sleeps or shows old data is no eye on the robot.
// With each goes the number of the status that was drawn last.
import { send } from "./socket.js";

const kPeriodMs = 400;
const kLatestFrameMs = 300;  // after it was asked for

export function keep_beating(is_fresh) {
  let asked_at_ms = 0;
  let pending = false;
  setInterval(() => {
    if (pending || document.visibilityState !== "visible") return;
    pending = true;
    asked_at_ms = performance.now();
    requestAnimationFrame(() => {
      pending = false;
      const late = performance.now() - asked_at_ms > kLatestFrameMs;
      if (!late && document.visibilityState === "visible" && is_fresh()) send("beat");
    });
  }, kPeriodMs);
}
