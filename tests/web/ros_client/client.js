// client.js PACKAGES URL: npm's roslib at the other end of a WebSocket. Does what each line of its input says and prints what it hears, a
// JSON object a line each.
//
// In:  {"do":"subscribe","topic":T,"type":TYPE,"compression":"cbor","throttle_rate":500}, {"do":"unsubscribe","topic":T},
//      {"do":"publish","topic":T,"type":TYPE,"msg":{}}, {"do":"call","service":S,"type":TYPE,"args":{},"tag":1},
//      {"do":"topics"}, {"do":"services"}, {"do":"type_of","topic":T}, {"do":"send","text":"..."}, {"do":"close"}
// Out: {"event":"connection"}, {"event":"error"}, {"event":"close"}, {"event":"status","status":{}},
//      {"event":"message","topic":T,"msg":{}}: a typed array is {"typed":"Int8Array","values":[]},
//      {"event":"response","tag":1,"ok":true,"values":{}}, {"event":"topics","topics":[],"types":[]},
//      {"event":"services","services":[]}, {"event":"type_of","topic":T,"type":TYPE}

const path = require("path");
const readline = require("readline");
const [packages, url] = process.argv.slice(2);
const ROSLIB = require(path.join(packages, "node_modules", "roslib"));

function plain(key, value) {
  return ArrayBuffer.isView(value) ? { typed: value.constructor.name, values: Array.from(value) } : value;
}

function say(event, fields) {
  process.stdout.write(JSON.stringify({ event, ...fields }, plain) + "\n");
}

const ros = new ROSLIB.Ros();
const subscribed = new Map();
const published = new Map();

ros.on("connection", () => say("connection"));
ros.on("error", (error) => say("error", { text: String(error.message || error) }));
ros.on("close", () => say("close"));
// roslib tells a status that has an id under the id alone.
ros.onAny((name, status) => {
  if (name === "status" || String(name).startsWith("status:")) {
    say("status", { status });
  }
});

const actions = {
  subscribe({ topic, type, compression, throttle_rate }) {
    const heard = new ROSLIB.Topic({ ros, name: topic, messageType: type, compression, throttle_rate });
    heard.subscribe((msg) => say("message", { topic, msg }));
    subscribed.set(topic, heard);
  },
  unsubscribe({ topic }) {
    subscribed.get(topic).unsubscribe();
  },
  publish({ topic, type, msg }) {
    if (!published.has(topic)) {
      published.set(topic, new ROSLIB.Topic({ ros, name: topic, messageType: type }));
    }
    published.get(topic).publish(new ROSLIB.Message(msg));
  },
  call({ service, type, args, tag }) {
    const called = new ROSLIB.Service({ ros, name: service, serviceType: type });
    called.callService(
      new ROSLIB.ServiceRequest(args || {}),
      (values) => say("response", { tag, ok: true, values }),
      (values) => say("response", { tag, ok: false, values }),
    );
  },
  topics() {
    ros.getTopics((all) => say("topics", all));
  },
  services() {
    ros.getServices((services) => say("services", { services }));
  },
  type_of({ topic }) {
    ros.getTopicType(topic, (type) => say("type_of", { topic, type }));
  },
  send({ text }) {
    ros.sendEncodedMessage(text);
  },
  close() {
    ros.close();
  },
};

const lines = readline.createInterface({ input: process.stdin });
lines.on("line", (line) => {
  const command = JSON.parse(line);
  actions[command.do](command);
});
lines.on("close", () => process.exit(0));
ros.connect(url);
