// A drag by finger, pen or mouse alike, that the map below does not take for its own.
import { map, place_of } from "./map.js";

/// Chromium takes a drag that ends at speed for a fling, even of what cannot scroll, and gives no click to a tap while it
/// would last: for 0.7 s after an area was drawn the buttons would be dead.
export function no_fling(node) {
  node.addEventListener("touchmove", (event) => event.preventDefault(), { passive: false });
}

/// `start(place)` false: no drag. `move(place)` on the way, `end(place, moved)` once, `cancel()` instead of it when the
/// system takes the pointer away. Places are [x, y] in metres.
export function on_drag(node, { start = () => true, move, end, cancel = () => {} }) {
  node.style.touchAction = "none";
  no_fling(node);
  for (const type of ["mousedown", "touchstart", "dblclick"]) node.addEventListener(type, (event) => event.stopPropagation());
  node.addEventListener("pointerdown", (event) => {
    if (!event.isPrimary || event.button !== 0 || start(place_of(event)) === false) return;
    event.stopPropagation();
    map.dragging.disable();
    node.setPointerCapture(event.pointerId);
    follow(node, event, { move, end, cancel });
  });
}

const kStill_px = 6;  // a finger that only taps

function follow(node, first, { move, end, cancel }) {
  let has_moved = false;
  const ours = (event) => event.pointerId === first.pointerId;
  const moving = (event) => {
    if (!ours(event)) return;
    has_moved ||= Math.hypot(event.clientX - first.clientX, event.clientY - first.clientY) > kStill_px;
    if (has_moved) move(place_of(event));
  };
  const done = (event) => {
    if (!ours(event)) return;
    node.removeEventListener("pointermove", moving);
    node.removeEventListener("pointerup", done);
    node.removeEventListener("pointercancel", done);
    map.dragging.enable();
    if (event.type === "pointercancel") cancel();
    else end(place_of(event), has_moved);
  };
  node.addEventListener("pointermove", moving);
  node.addEventListener("pointerup", done);
  node.addEventListener("pointercancel", done);
}
