// Where everybody is. Persons can be put where they really are: by a drag, by a tap, or with the arrow keys.
import { agents_of, has_controller, stage_of } from "./judge.js";
import { initial_of, style_of } from "./colours.js";
import { make } from "./dom.js";
import { at, map, renderers } from "./map.js";
import { model } from "./model.js";
import { on_drag } from "./pointer_drag.js";
import { snapped } from "./geometry.js";
import { tell } from "./tell.js";
import { view, set_view } from "./view_state.js";
import { say } from "./words.js";

const kTellEveryMs = 200;
const kStep_m = 0.5;
const kArrows = { ArrowUp: [0, kStep_m], ArrowDown: [0, -kStep_m], ArrowLeft: [-kStep_m, 0], ArrowRight: [kStep_m, 0] };

const markers = [];
let made_of = "";
let told_at_ms = 0;

/// A person who walks by themselves; of one who is simulated the controller knows the place.
export function is_placed_by_hand(agent) {
  return agent?.kind === "person" && agent.motion === "reported";
}

export function can_be_placed(agent) {
  return is_placed_by_hand(agents_of(model)[agent]) && model.link === "open" && has_controller(model) && stage_of(model) !== "end";
}

export function tell_position(agent, place) {
  const [x_m, y_m] = snapped(place, model.documents.mission.map);
  return tell("position", { agent, x_m, y_m });
}

function make_marker(agent, index) {
  const style = style_of(agents_of(model), index);
  const node = make("div", { class: `agent agent-${agent.kind}`, id: `agent-${index}`, "data-agent": String(index) });
  const pointer = make("span", { class: "agent-heading" });
  const disc = make("span", { class: "agent-disc", text: initial_of(agent) });
  disc.style.backgroundColor = style.line;
  pointer.style.color = style.line;
  node.append(pointer, disc);
  const marker = L.marker(at(agent.start_m), {
    pane: "agents", keyboard: false, interactive: false, icon: L.divIcon({ className: "agent-place", html: node, iconSize: [48, 48] }) });
  const sight = L.circle(at(agent.start_m), {
    renderer: renderers.paths, pane: "paths", interactive: false, radius: agent.sight_radius_m, color: style.line, weight: 1.5,
    opacity: 0.7, fillColor: style.line, fillOpacity: 0.07 });
  marker.addTo(map);
  const entry = { marker, node, pointer, sight, held: false, agent: index };
  if (is_placed_by_hand(agent)) make_movable(entry);
  else node.setAttribute("role", "img");
  return entry;
}

function make_movable(entry) {
  entry.node.tabIndex = 0;
  entry.node.setAttribute("role", "button");
  on_drag(entry.node, {
    start: () => can_be_placed(entry.agent),
    move(place) {
      entry.held = true;
      put(entry, place);
      const now_ms = performance.now();
      if (now_ms - told_at_ms < kTellEveryMs) return;
      told_at_ms = now_ms;
      tell_position(entry.agent, place);
    },
    end(place, has_moved) {
      entry.held = false;
      if (has_moved) tell_position(entry.agent, place);
      else set_view({ tool: view.tool === "position" ? null : "position", tool_agent: entry.agent });
    },
    cancel() { entry.held = false; },
  });
  entry.node.addEventListener("keydown", (event) => {
    const step = kArrows[event.key];
    if (!step || !can_be_placed(entry.agent)) return;
    event.preventDefault();
    event.stopPropagation();
    const state = model.status.agents[entry.agent];
    tell_position(entry.agent, [state.x_m + step[0], state.y_m + step[1]]);
  });
}

function put(entry, place) {
  entry.marker.setLatLng(at(place));
  entry.sight.setLatLng(at(place));
}

function forget_other_mission(agents) {
  const now = JSON.stringify(agents);
  if (now === made_of) return;
  made_of = now;
  for (const { marker, sight } of markers.splice(0)) {
    marker.remove();
    sight.remove();
  }
}

export function show_agents() {
  const agents = agents_of(model);
  forget_other_mission(agents);
  agents.forEach((agent, i) => {
    markers[i] ??= make_marker(agent, i);
    const entry = markers[i];
    const state = model.status?.agents?.[i];
    if (!entry.held) put(entry, state ? [state.x_m, state.y_m] : agent.start_m);
    const heading_rad = agent.kind === "robot" ? model.status?.heading_rad ?? agent.heading_rad : null;
    entry.pointer.hidden = heading_rad === null;
    if (heading_rad !== null) entry.pointer.style.transform = `rotate(${-heading_rad}rad)`;
    const label = say(agent.kind === "robot" ? "agent.robot_here" : "agent.person_here", { name: agent.name });
    if (entry.node.getAttribute("aria-label") !== label) entry.node.setAttribute("aria-label", label);
    const seeing = model.status?.search?.started === true && stage_of(model) === "search";
    if (seeing && !map.hasLayer(entry.sight)) entry.sight.addTo(map);
    if (!seeing && map.hasLayer(entry.sight)) entry.sight.remove();
  });
}
