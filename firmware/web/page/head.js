// The line above all: what the robot does, in words; how old that is; who holds the controls.
import { by_id, set_attribute, set_text, show } from "./dom.js";
import { agents_of, data_age_s, has_controller, is_old, is_operator, is_over } from "./judge.js";
import { state_words } from "./state_words.js";
import { choose_language, language_names, number, other_language, say } from "./words.js";
import { changed, model } from "./model.js";

const kLanguageButtons = ["language", "language-too", "pairing-language"];

function age_words(age_s) {
  if (!Number.isFinite(age_s)) return say("age.never");
  if (age_s < 60) return say("age.seconds", { value: number(age_s, age_s < 9.95 ? 1 : 0) });
  return say("age.minutes", { value: number(Math.floor(age_s / 60)) });
}

function operator_words() {
  const operator = model.status?.operator;
  if (is_operator(model)) return say("operator.you");
  return operator ? say("operator.other", { name: operator.name }) : say("operator.nobody");
}

function stale_words(now_ms) {
  const age = age_words(data_age_s(model, now_ms));
  const robot = agents_of(model)[0]?.name ?? "IVO";
  if (model.link === "open" && !has_controller(model)) return say(model.status?.controller === "absent" ? "stale.absent" : "stale.none", { age, robot });
  if (model.link !== "open") return say("stale.no_server", { age, robot });
  return say("stale.old", { age, robot });
}

export function show_head() {
  const now_ms = performance.now();
  const state = state_words(model);
  set_text(by_id("state"), say(state.key, state.values));
  set_attribute(by_id("head"), "data-tone", state.tone);
  set_attribute(by_id("head"), "data-state", state.key.slice("state.".length));
  const age_s = data_age_s(model, now_ms);
  const old = is_old(model, now_ms);
  set_text(by_id("link-age"), model.link === "open" && !old ? say("link.now", { age: age_words(age_s) }) : say("link.old", { age: age_words(age_s) }));
  set_text(by_id("link-operator"), model.status && model.link === "open" ? operator_words() : "");
  const stale = old && model.heard_at_ms !== null && model.link !== "unpaired" && !is_over(model);
  set_attribute(document.body, "data-old", stale ? "yes" : "no");
  show(by_id("stale"), stale);
  if (stale) set_text(by_id("stale"), stale_words(now_ms));
  for (const id of kLanguageButtons) {
    set_text(by_id(id), language_names[other_language()]);
    set_attribute(by_id(id), "lang", other_language());
  }
}

for (const id of kLanguageButtons) {
  by_id(id).addEventListener("click", () => {
    choose_language(other_language());
    changed();
  });
}
