// Who held the controls before a reload or a lost network takes them again, as long as nobody else did. That moves nothing: a
// robot that has stopped meanwhile waits to be started anew.
import { is_operator } from "./judge.js";
import { model } from "./model.js";
import { send } from "./socket.js";

const kKey = "ivo.held_controls";  // of this tab, gone with it
const kGhostMs = 2500;             // after which the server counts a lost connection as gone

// Connections are told apart by their hello: a server that begins anew gives the same numbers again.
let asked_by = null;  // the connection that has asked already
let known_at_ms = 0;
let known = null;

function held() {
  try {
    return sessionStorage.getItem(kKey) === "yes";
  } catch {
    return false;
  }
}

export function note_held(value) {
  try {
    sessionStorage.setItem(kKey, value ? "yes" : "no");
  } catch {
    // Without storage they are taken by hand.
  }
}

export function regain_controls() {
  const { hello, status, link } = model;
  if (link !== "open" || hello === null || status === null || status.n === 0) return;  // 0: of an earlier connection
  if (known !== hello) {
    known = hello;
    known_at_ms = performance.now();
  }
  if (is_operator(model)) {
    asked_by = hello;
    note_held(true);
    return;
  }
  if (!held() || asked_by === hello || hello.may_operate !== true) {
    // On the same connection they were given away.
    if (asked_by === hello && status.operator !== null) note_held(false);
    return;
  }
  const ghost = status.operator !== null && status.operator.name === hello.name && !status.screens.some((each) => each.screen === status.operator.screen);
  if (status.operator !== null && !ghost) {
    // Somebody else has chosen to take them. Of the same name it may be this screen's connection that is not known to be lost yet.
    if (status.operator.name !== hello.name) note_held(false);
    return;
  }
  if (ghost && performance.now() - known_at_ms < kGhostMs) return;
  asked_by = hello;
  send("control.request");
}
