// For whom an area is: "prefer:1" for where agent 1 would rather search, "no_go:" for where nobody may go, "no_go:0" for
// where agent 0 may not.
import { say } from "./words.js";

export function purpose_of(text) {
  const [purpose, agent] = (text ?? "no_go:").split(":");
  return { purpose: purpose === "prefer" ? "preferred" : "no_go", agent: agent === "" ? null : Number(agent) };
}

export function text_of({ purpose, agent }) {
  return `${purpose === "preferred" ? "prefer" : "no_go"}:${agent ?? ""}`;
}

/// Persons first: they are asked what they want.
export function purposes(agents) {
  const order = [...agents.keys()].sort((a, b) => (agents[a].kind === "robot") - (agents[b].kind === "robot"));
  return [...order.map((i) => `prefer:${i}`), "no_go:", ...order.map((i) => `no_go:${i}`)];
}

export function purpose_words(agents, { purpose, agent }) {
  const name = agents[agent]?.name ?? "";
  if (purpose === "preferred") return say("purpose.preferred", { name });
  return agent === null ? say("purpose.no_go") : say("purpose.no_go_one", { name });
}
