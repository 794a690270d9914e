// The newest state, as the server said it. Only what the server says changes it; views read it and keep nothing of it.

const kLookMs = 250;  // ages grow without anything being said

export const model = {
  link: "connecting",  // connecting, open, closed, unpaired
  heard_at_ms: null,
  hello: null,
  connection: 0,   // how often somebody has said hello
  status: null,
  drawn: 0,        // the number of the newest status that is drawn, on this connection; 0: none
  documents: {},  // by name: the value
  grids: {},      // by name: the revision
  layers: {},     // by name: the message, with when it came
};

const watchers = [];
let asked = false;

/// `view(model)` once a frame, when anything has changed.
export function watch(view) {
  watchers.push(view);
}

export function changed() {
  if (asked) return;
  asked = true;
  requestAnimationFrame(() => {
    asked = false;
    for (const view of watchers) view(model);
    model.drawn = model.status?.n ?? 0;
  });
}

export function take_link(link) {
  model.link = link;
  changed();
}

export function take(message) {
  model.heard_at_ms = performance.now();
  switch (message.type) {
    case "hello":
      model.hello = message;
      model.connection += 1;
      if (model.status !== null) model.status = { ...model.status, n: 0 };
      model.drawn = 0;
      // What an earlier connection said may not hold any more.
      model.documents = {};
      model.grids = {};
      model.layers = {};
      break;
    case "status":
      model.status = message;
      break;
    case "document":
      model.documents[message.name] = message.value;
      break;
    case "grid":
      model.grids[message.name] = message.revision;
      break;
    case "layer":
      model.layers[message.name] = { ...message, came_at_ms: model.heard_at_ms };
      break;
    default:
      return;
  }
  changed();
}

export function keep_looking() {
  setInterval(changed, kLookMs);
}
