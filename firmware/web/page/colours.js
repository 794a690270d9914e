// The paper's colours: the robot red, the person green; further persons in hues that are told from both, and each agent
// with a dash and a hatch of its own, for eyes and light in which colours fail.

const kRobot = { line: "#c4122a", dash: null, hatch_deg: 45 };
const kPersons = [
  { line: "#00703c", dash: "14 7", hatch_deg: -45 },
  { line: "#1b4fa0", dash: "3 8", hatch_deg: 90 },
  { line: "#8a4300", dash: "18 6 3 6", hatch_deg: 0 },
  { line: "#6b2a8f", dash: "8 4 8 10", hatch_deg: 20 },
];
export const kNoGo = { line: "#26282c", hatch_deg: 45 };

/// `agents` of the mission; `index` null: everybody.
export function style_of(agents, index) {
  if (index === null || !agents[index]) return kNoGo;
  if (agents[index].kind === "robot") return kRobot;
  const persons = agents.slice(0, index).filter((agent) => agent.kind !== "robot").length;
  return kPersons[persons % kPersons.length];
}

export function initial_of(agent) {
  return (agent?.name ?? "?").slice(0, 1).toUpperCase();
}
