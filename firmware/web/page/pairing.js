// The first screen of a device that the robot does not know: six digits, and a name for this screen.
import { by_id, set_text, show } from "./dom.js";
import { model } from "./model.js";
import { connect } from "./socket.js";
import { recall, remember } from "./memory.js";
import { say } from "./words.js";

let shown = false;

function fault_words(reply) {
  if (reply.error === "wrong_code") return say(reply.left === 1 ? "pairing.wrong_last" : "pairing.wrong", { left: reply.left });
  if (reply.error === "locked") return say("pairing.locked", { wait: reply.wait_s });
  if (reply.error === "foreign_host" || reply.error === "foreign_origin") return say("pairing.foreign", { host: location.host });
  return say("pairing.failed");
}

async function pair() {
  const code = by_id("pairing-code").value.replace(/\D/g, "");
  const name = by_id("pairing-name").value.trim() || say("pairing.some_screen");
  if (code.length !== 6) return set_text(by_id("pairing-fault"), say("pairing.six"));
  remember("name", name);
  try {
    const reply = await fetch("/pair", { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify({ code, name }) });
    if (reply.ok) {
      set_text(by_id("pairing-fault"), "");
      connect();
      return;
    }
    set_text(by_id("pairing-fault"), fault_words(await reply.json().catch(() => ({}))));
  } catch {
    set_text(by_id("pairing-fault"), say("verdict.lost"));
  }
  by_id("pairing-code").select();
}

export function show_pairing() {
  const wanted = model.link === "unpaired" || (shown && model.link === "closed");
  if (wanted === shown) return;
  shown = wanted;
  show(by_id("pairing"), shown);
  // What lies behind is out of reach meanwhile; there is no robot behind it that could be stopped.
  for (const id of ["stop-place", "head", "map-frame", "panel", "act"]) by_id(id).inert = shown;
  if (!shown) return;
  by_id("pairing-name").value = recall("name") ?? "";
  by_id("pairing-code").value = "";
  by_id("pairing-code").focus();
}

by_id("pairing-form").addEventListener("submit", (event) => {
  event.preventDefault();
  pair();
});
