// What the page says, in the language of this screen. Every sentence is in words_en.js and words_es.js.
import { recall, remember } from "./memory.js";
import { words as en } from "./words_en.js";
import { words as es } from "./words_es.js";

const kLanguages = { en, es };
export const language_names = { en: "English", es: "Español" };

let language = first_language();

function first_language() {
  const wanted = [recall("language"), ...(navigator.languages ?? [navigator.language ?? "en"])];
  for (const name of wanted) {
    const code = (name ?? "").slice(0, 2).toLowerCase();
    if (code in kLanguages) return code;
  }
  return "en";
}

export function language_now() {
  return language;
}

export function other_language() {
  return language === "en" ? "es" : "en";
}

export function choose_language(code) {
  language = code;
  remember("language", code);
  say_page();
}

/// `{name}` in a sentence stands for `values.name`.
export function say(key, values = {}) {
  const sentence = kLanguages[language][key] ?? en[key] ?? key;
  return sentence.replace(/\{(\w+)\}/g, (all, name) => values[name] ?? all);
}

/// What comes with an English text of its own, in case that this page has none for it.
export function say_or(key, text) {
  return key in kLanguages[language] ? say(key) : text;
}

export function number(value, digits = 0) {
  return new Intl.NumberFormat(language, { minimumFractionDigits: digits, maximumFractionDigits: digits }).format(value);
}

export function percent(share) {
  return say("unit.percent", { value: number(100 * share) });
}

export function metres(value_m, digits = 1) {
  return say("unit.metres", { value: number(value_m, digits) });
}

export function seconds(value_s, digits = 0) {
  return say("unit.seconds", { value: number(value_s, digits) });
}

/// Minutes and seconds when it is long.
export function duration(value_s) {
  if (value_s < 100) return seconds(value_s);
  const whole = Math.round(value_s);
  return say("unit.minutes", { minutes: number(Math.floor(whole / 60)), seconds: String(whole % 60).padStart(2, "0") });
}

/// Everything on the page that has a sentence of its own.
export function say_page() {
  document.documentElement.lang = language;
  document.title = say("title");
  for (const node of document.querySelectorAll("[data-say]")) node.textContent = say(node.dataset.say);
  for (const node of document.querySelectorAll("[data-say-label]")) {
    node.setAttribute("aria-label", say(node.dataset.sayLabel));
  }
}
