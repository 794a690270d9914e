// Areas as a file: saved from here, or loaded in place of those that are drawn.
import { all_areas, note_replaced } from "./area_commands.js";
import { allow, by_id } from "./dom.js";
import { may_change_areas } from "./areas.js";
import { toast } from "./toast.js";
import { say } from "./words.js";

const input = by_id("areas-load-file");

export function show_area_files() {
  allow(by_id("areas-load"), may_change_areas());
  input.disabled = !may_change_areas();
}

input.addEventListener("change", async () => {
  const file = input.files[0];
  if (!file) return;
  const before = all_areas();
  try {
    const reply = await fetch("/areas.geojson", { method: "PUT", headers: { "Content-Type": "application/geo+json" }, body: await file.text() });
    if (reply.ok) note_replaced(before);
    toast(say(reply.ok ? "areas.loaded" : "areas.not_loaded"));
  } catch {
    toast(say("verdict.lost"));
  }
  input.value = "";
});
