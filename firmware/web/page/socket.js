// The one connection to the server: opens it, opens it again, numbers what is sent and hands each answer to who asked.
import { model, take, take_link } from "./model.js";

const kFirstWaitMs = 250;
const kLongestWaitMs = 2000;
const kDeafAfterMs = 3000;  // the server speaks twice a second
const kLookMs = 500;

let socket = null;
let sequence = 0;
let wait_ms = kFirstWaitMs;
let heard_at_ms = 0;
let timer = 0;
const kSeenWith = ["beat", "start"];  // say which status was drawn last: so it shows how long they were on their way
const waiting = new Map();  // by sequence number: who waits for the verdict

function address() {
  return `${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/session`;
}

export function connect() {
  clearTimeout(timer);
  if (socket !== null) return;
  let opened = false;
  const mine = new WebSocket(address(), "ivo-console");
  socket = mine;
  sequence = 0;
  heard_at_ms = performance.now();
  mine.onopen = () => {
    opened = true;
    heard_at_ms = performance.now();
    wait_ms = kFirstWaitMs;
    take_link("open");
  };
  mine.onmessage = (event) => {
    heard_at_ms = performance.now();
    hear(event.data);
  };
  mine.onclose = () => closed(mine, opened);
}

function hear(text) {
  let message;
  try {
    message = JSON.parse(text);
  } catch {
    return;
  }
  if (message.type === "answer") {
    waiting.get(message.seq)?.(message.verdict);
    waiting.delete(message.seq);
    return;
  }
  take(message);
}

async function closed(mine, opened) {
  if (socket !== mine) return;
  socket = null;
  for (const answer of waiting.values()) answer("lost");
  waiting.clear();
  take_link("closed");
  // The browser does not say why it was refused; another request does.
  if (!opened && (await is_unpaired())) {
    take_link("unpaired");
    return;
  }
  clearTimeout(timer);
  timer = setTimeout(connect, wait_ms);
  wait_ms = Math.min(2 * wait_ms, kLongestWaitMs);
}

async function is_unpaired() {
  try {
    const reply = await fetch("/areas.geojson", { cache: "no-store" });
    return reply.status === 401 || reply.status === 403;
  } catch {
    return false;
  }
}

/// To the server; the verdict in the end, "lost" when none comes.
export function send(action, keys = {}) {
  if (socket === null || socket.readyState !== WebSocket.OPEN) return Promise.resolve("lost");
  sequence += 1;
  const number = sequence;
  const seen = kSeenWith.includes(action) ? { seen: model.drawn } : {};
  socket.send(JSON.stringify({ seq: number, do: action, ...keys, ...seen }));
  return new Promise((answer) => waiting.set(number, answer));
}

// A connection that died in silence, or in a sleep, would otherwise be waited for until the system gives up.
function look() {
  if (socket === null || performance.now() - heard_at_ms < kDeafAfterMs) return;
  const mine = socket;
  mine.onmessage = null;
  mine.close();
  closed(mine, true);
}

export function keep_connected() {
  connect();
  setInterval(look, kLookMs);
  addEventListener("online", connect);
  document.addEventListener("visibilitychange", () => {
    if (document.visibilityState === "visible") {
      wait_ms = kFirstWaitMs;
      if (socket === null) connect();
    }
  });
}
