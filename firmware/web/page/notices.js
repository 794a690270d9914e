// What happened by itself or could not be done, as the controller says it. Each stays until somebody has read it.
import { agents_of, areas_of } from "./judge.js";
import { by_id, on_press, set_text, show } from "./dom.js";
import { changed, model } from "./model.js";
import { purpose_words } from "./purpose.js";
import { say, say_or } from "./words.js";

let read = null;  // number of the notice that was closed

export function show_notice() {
  const notice = model.documents.notice;
  if (!notice) read = null;
  const shown = Boolean(notice) && notice.number !== read;
  show(by_id("notice"), shown);
  if (!shown) return;
  const agents = agents_of(model);
  const area = areas_of(model).find((each) => each.slot === notice.slot);
  const words = say_or(`notice.${notice.code}`, notice.text)
    .replaceAll("{name}", agents[notice.agent]?.name ?? say("somebody"))
    .replaceAll("{area}", area ? purpose_words(agents, area) : say("notice.an_area"));
  set_text(by_id("notice-text"), words);
  by_id("notice").dataset.code = notice.code;
}

on_press(by_id("notice-close"), () => {
  read = model.documents.notice?.number ?? null;
  changed();
});
