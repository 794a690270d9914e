// Three pages of the panel, one shown; on phones the panel folds away.
import { by_id, set_attribute, set_text, show } from "./dom.js";
import { areas_of, stage_of } from "./judge.js";
import { model } from "./model.js";
import { set_view, view } from "./view_state.js";

const kTabs = ["search", "areas", "screens"];
let folded = false;
let last_stage = "wait";

export function show_tabs() {
  const stage = stage_of(model);
  // The end is news for everybody.
  if (stage === "end" && last_stage !== "end") {
    view.tab = "search";
    folded = false;
  }
  last_stage = stage;
  for (const name of kTabs) {
    const chosen = view.tab === name;
    set_attribute(by_id(`tab-${name}`), "aria-selected", String(chosen));
    by_id(`tab-${name}`).tabIndex = chosen ? 0 : -1;
    show(by_id(`page-${name}`), chosen);
  }
  set_attribute(document.body, "data-tab", view.tab);
  set_attribute(document.body, "data-folded", folded || view.tool !== null ? "yes" : "no");
  set_attribute(by_id("sheet"), "aria-expanded", String(!folded));
  const count = areas_of(model).length;
  set_text(by_id("areas-count"), count > 0 ? String(count) : "");
}

function choose(name) {
  folded = false;
  set_view({ tab: name, selected: null, tool: null });
}

for (const name of kTabs) by_id(`tab-${name}`).addEventListener("click", () => choose(name));
by_id("tabs").addEventListener("keydown", (event) => {
  const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
  if (!step) return;
  const next = kTabs[(kTabs.indexOf(view.tab) + step + kTabs.length) % kTabs.length];
  choose(next);
  by_id(`tab-${next}`).focus();
});
by_id("sheet").addEventListener("click", () => {
  folded = !folded;
  set_view({});
});
