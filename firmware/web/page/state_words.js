// What the robot does, and what somebody may do now, in words: which sentence fits the model. The sentences themselves are in
// words_en.js and words_es.js.
import { agents_of, areas_are_newer, has_ended, into_no_go, is_operator, stage_of } from "./judge.js";

/// A key of the words, what stands in the sentence, and its tone: calm, busy, moving, warn, bad.
export function state_words(model) {
  const status = model.status;
  const values = { robot: agents_of(model)[0]?.name ?? "IVO" };
  const words = (key, tone) => ({ key: `state.${key}`, values, tone });
  if (model.link === "unpaired") return words("unpaired", "warn");
  if (model.link !== "open") return words(model.heard_at_ms === null ? "connecting" : "no_server", "bad");
  if (status === null) return words("connecting", "warn");
  if (has_ended(model)) return words(end_key(model), "calm");
  if (status.controller === "none") return words("none", "warn");
  if (status.controller === "absent") return words("absent", "bad");
  if (status.controller === "silent") return words("silent", "bad");
  if (status.stop_held) return words("stop_held", "bad");
  if (status.mode === "fault") return words("fault", "bad");
  if (status.mode === "stopping" || status.mode === "pausing") return words("stopping", "warn");
  if (stage_of(model) === "end") return words(end_key(model), "calm");
  switch (status.mode) {
    case "planning": return words(status.plan.preparing ? "preparing" : "planning", "busy");
    case "starting": return words("starting", "busy");
    case "searching": return words("searching", "moving");
    default: break;
  }
  if (status.taken_up) return words("taken_up", "warn");
  if (status.search.started) return words(status.pause_cause === "beat_lost" ? "beat_lost" : "paused", "warn");
  return words(status.plan.accepted ? "ready" : "awaiting", "calm");
}

/// What is wrong, as far as somebody beside the robot can see it.
export function fault_words(model, say) {
  const { fault_kind: kind, fault_wheel: wheel } = model.status ?? {};
  if (!kind || kind === "none") return "";
  return say(`fault.${kind}`, { wheel: say(`wheel.${wheel ?? "some"}`) });
}

/// found_by_robot, found_by_person, paths_ended, stopped or ended.
export function end_key(model) {
  const { search, stop_cause } = model.status;
  if (search.state === "found") return agents_of(model)[search.finder]?.kind === "person" ? "found_by_person" : "found_by_robot";
  if (search.state === "paths_ended") return "paths_ended";
  return stop_cause === "no_consent" ? "no_consent" : "ended";
}

/// Title and advice of the panel: two keys.
export function advice_of(model) {
  const status = model.status;
  const stage = stage_of(model);
  const watching = !is_operator(model);
  if (stage !== "wait" && model.link !== "open") return ["now.lost", "now.lost_text"];
  if (status?.controller === "absent" && stage !== "end") return ["now.absent", "now.absent_text"];
  switch (stage) {
    case "wait": return ["now.wait", "now.wait_text"];
    case "fault": return ["now.fault", status.asks === "clearing" ? "now.fault_text" : "now.fault_wait"];
    case "end": return [`end.${end_key(model)}`, `end.${end_key(model)}_text`];
    case "plan": return [status.plan.with_preferences ? "now.plan_with" : "now.plan_free", status.plan.preparing ? "now.preparing_text" : "now.plan_text"];
    case "search": return ["now.search", "now.search_text"];
    default: break;
  }
  const resumed = status.search.started;
  if (into_no_go(model) !== null) return [resumed ? "now.paused" : "now.no_go", watching ? "now.watch_agree" : "now.no_go_text"];
  if (status.plan.accepted) {
    const text = watching ? (status.operator ? "now.watch_start" : "now.free_start") : resumed ? "now.go_on_text" : "now.accepted_text";
    return [resumed ? "now.paused" : "now.accepted", text];
  }
  if (resumed && !watching && status.plan.followed) return ["now.paused", "now.again_text"];
  if (areas_are_newer(model)) return ["now.areas_newer", watching ? "now.watch_agree" : "now.areas_newer_text"];
  const title = status.plan.with_preferences ? "now.agree_with" : "now.agree_free";
  if (watching) return [title, status.operator ? "now.watch_agree" : "now.free_agree"];
  return [title, "now.agree_text"];
}
