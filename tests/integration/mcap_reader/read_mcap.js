// read_mcap.js PACKAGES FILE: what npm's @mcap/core reads of a file, as JSON: its records one after the other, and its summary where it has one.

const fs = require("fs");
const path = require("path");
const [packages, file] = process.argv.slice(2);
const { McapIndexedReader, McapStreamReader } = require(path.join(packages, "node_modules", "@mcap/core"));

function plain(key, value) {
  return typeof value === "bigint" ? Number(value) : value instanceof Map ? Object.fromEntries(value) : value;
}

async function summary(bytes) {
  const readable = { size: async () => BigInt(bytes.length), read: async (at, size) => bytes.subarray(Number(at), Number(at + size)) };
  const reader = await McapIndexedReader.Initialize({ readable });
  let read = 0;
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    read += message.data.length > 0 ? 1 : 0;
  }
  return { statistics: reader.statistics, chunks: reader.chunkIndexes.length, read, topics: [...reader.channelsById.values()].map((channel) => channel.topic) };
}

async function main() {
  const bytes = fs.readFileSync(file);
  const reader = new McapStreamReader({ validateCrcs: true });
  reader.append(bytes);
  const schemas = new Map();
  const channels = new Map();
  const topics = {};
  for (let record; (record = reader.nextRecord()); ) {
    if (record.type === "Schema") {
      schemas.set(record.id, { name: record.name, encoding: record.encoding, schema: JSON.parse(Buffer.from(record.data).toString()) });
    } else if (record.type === "Channel") {
      channels.set(record.id, record.topic);
      topics[record.topic] = topics[record.topic] ?? { ...schemas.get(record.schemaId), messageEncoding: record.messageEncoding, times: [], messages: [] };
    } else if (record.type === "Message") {
      const topic = topics[channels.get(record.channelId)];
      topic.times.push(Number(record.logTime));
      topic.messages.push(JSON.parse(Buffer.from(record.data).toString()));
    }
  }
  const whole = reader.done();
  console.log(JSON.stringify({ whole, topics, summary: whole ? await summary(bytes) : null }, plain));
}

main();
