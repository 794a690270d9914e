// What follows from the model, without a page: who may do what, how old the data is, what stage the search is in.

import { cut, distance_m } from "./geometry.js";

export const kOldAfterS = 1;
const kBeside_m = 1.0;

export function heard_age_s(model, now_ms) {
  return model.heard_at_ms === null ? Infinity : Math.max(0, (now_ms - model.heard_at_ms) / 1000);
}

/// Of what the page shows about the robot: server and controller are one chain.
export function data_age_s(model, now_ms) {
  const heard_s = heard_age_s(model, now_ms);
  if (model.status === null) return Infinity;
  const controller_s = model.status.controller_age_s ?? 0;
  return heard_s + controller_s;
}

/// What has ended does not change any more: its data cannot be too old.
export function has_ended(model) {
  return model.link === "open" && model.status?.finished === true;
}

export function is_old(model, now_ms) {
  if (has_ended(model)) return heard_age_s(model, now_ms) > kOldAfterS;
  return model.link !== "open" || !has_controller(model) || data_age_s(model, now_ms) > kOldAfterS;
}

export function has_controller(model) {
  return model.status?.controller === "connected" || model.status?.controller === "silent";
}

/// Status 0 is of an earlier connection: its numbers of screens say nothing on this one.
export function is_operator(model) {
  return model.link === "open" && model.hello !== null && model.status?.n > 0 && model.status.operator?.screen === model.hello.screen;
}

export function agents_of(model) {
  return model.documents.mission?.agents ?? [];
}

export function areas_of(model) {
  return model.documents.areas?.areas ?? [];
}

/// plan, agree, search, fault, end; or wait, before anything is known.
export function stage_of(model) {
  const status = model.status;
  if (status === null || status.controller === "none" || status.controller === undefined) return "wait";
  if (status.mode === "fault") return "fault";
  if (status.finished || status.mode === "done" || status.search.state !== "running") return "end";
  if (status.mode === "searching" || status.mode === "pausing" || status.mode === "stopping") return "search";
  if (status.mode === "planning" || (!status.plan.ready && status.mode !== "awaiting consent")) return "plan";
  return "agree";
}

/// The agent whose way ahead leads into an area that was closed after the plan was made; null: nobody's.
export function into_no_go(model) {
  return agents_of(model)[model.status?.plan?.into_no_go ?? -1] ?? null;
}

/// Areas were drawn, changed or removed since the plan was asked for.
export function areas_are_newer(model) {
  const revision = model.documents.plan?.areas_revision;
  return revision !== undefined && model.status?.areas_revision > revision;
}

/// Why nobody can start from this screen now: a key of the words, or null.
export function no_start_because(model, now_ms) {
  const status = model.status;
  if (model.link !== "open" || status === null) return "start.no_server";
  if (status.controller !== "connected") return "start.no_controller";
  if (is_old(model, now_ms)) return "start.old";
  if (!is_operator(model)) return "start.not_operator";
  if (status.stop_held) return "start.stop_held";
  if (status.asks !== "consent") return "start.not_asked";
  if (!status.plan.accepted) return "start.not_accepted";
  if (!status.start_fresh) return "start.not_fresh";
  return null;
}

/// A person whose place is to come from outside, and has not yet: how far on the path nobody can say.
export function is_unseen(model, agent) {
  return agents_of(model)[agent]?.motion === "reported" && (model.status?.agents?.[agent]?.report_age_s ?? null) === null;
}

/// How far an agent has gone on the plan that is shown; null: nobody knows.
export function done_m(model, agent) {
  const { status, documents } = model;
  const plan = documents.plan;
  const state = status?.agents?.[agent];
  const path = plan?.agents?.[agent];
  if (!state || !path || !status.search.started || plan.number !== status.plan.number || !status.plan.ready) return null;
  if (is_unseen(model, agent)) return null;
  if (state.path_ended) return path.length_m;
  // Nobody knows it of a person; what they have gone tells, where it leads to where they are.
  if (!(state.left_m > 0)) {
    const there = cut(path.waypoints_m, state.moved_m)[0].at(-1);
    return distance_m(there, [state.x_m, state.y_m]) < kBeside_m ? Math.min(state.moved_m, path.length_m) : null;
  }
  return Math.min(Math.max(path.length_m - state.left_m, 0), path.length_m);
}
