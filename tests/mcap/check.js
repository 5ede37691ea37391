// Reads an MCAP file by its index and as a stream, and compares each message with the recording.
import assert from "node:assert/strict";
import fs from "node:fs";
import {McapIndexedReader, McapStreamReader} from "@mcap/core";

const [recording, log] = process.argv.slice(2);
const [header, ...frames] = fs.readFileSync(recording, "utf8").trim().split("\n").map(JSON.parse);
const bytes = fs.readFileSync(log);
const sides = ["left", "right"];
const decoder = new TextDecoder();

const vector = ([x, y, z]) => ({x, y, z});
const pose = (n) => ({
  position: vector(n),
  orientation: {x: n[3], y: n[4], z: n[5], w: n[6]},
});

/** The messages of a frame, by topic. */
function expected(frame) {
  const messages = new Map();
  const add = (topic, content) => messages.set(topic, {
    timestamp: {sec: Math.floor(frame.t / 1e9), nsec: frame.t % 1e9},
    frame_id: "world",
    ...content,
  });
  for (const side of sides) {
    const hand = frame[side];
    if (!hand) continue;
    add(`/hands/${side}/joints`, {poses: hand.joints.map(pose)});
    add(`/hands/${side}/state`, {
      confidence: hand.confidence,
      radii: hand.joints.map((joint) => joint[7]),
      status: hand.status,
    });
    const contacts = Object.entries(hand.contact).map(([part, contact]) => ({
      part,
      point: vector(contact.point),
      normal: vector(contact.normal),
      depth: contact.depth,
    }));
    add(`/hands/${side}/contacts`, {contacts});
  }
  if (frame.head) add("/head", {pose: pose(frame.head)});
  return messages;
}

function check(messages, channels) {
  const byTime = Map.groupBy ? Map.groupBy(messages, (m) => m.logTime) : groups(messages);
  assert.equal(byTime.size, frames.length);
  for (const frame of frames) {
    const found = new Map(byTime.get(BigInt(frame.t)).map((message) => [
      channels.get(message.channelId).topic, JSON.parse(decoder.decode(message.data)),
    ]));
    assert.deepEqual(found, expected(frame));
  }
}

function groups(messages) {
  const byTime = new Map();
  for (const message of messages) {
    byTime.set(message.logTime, [...(byTime.get(message.logTime) ?? []), message]);
  }
  return byTime;
}

const reader = await McapIndexedReader.Initialize({
  readable: {
    size: async () => BigInt(bytes.length),
    read: async (offset, size) => bytes.subarray(Number(offset), Number(offset + size)),
  },
});
const indexed = [];
for await (const message of reader.readMessages()) indexed.push(message);
check(indexed, reader.channelsById);
assert.equal(Number(reader.statistics.messageCount), indexed.length);
assert.ok(reader.chunkIndexes.length > 1);

const schemas = [...reader.schemasById.values()].map((schema) => {
  assert.equal(schema.encoding, "jsonschema");
  assert.equal(JSON.parse(decoder.decode(schema.data)).title, schema.name);
  return schema.name;
});
assert.deepEqual(schemas, [
  "foxglove.PosesInFrame", "foxglove.PoseInFrame", "nade.HandState", "nade.Contacts",
]);
for await (const metadata of reader.readMetadata({name: "nade-recording"})) {
  assert.equal(metadata.metadata.get("source"), header.source);
  assert.equal(metadata.metadata.get("method"), header.method);
}

const stream = new McapStreamReader({validateCrcs: true});
stream.append(bytes);
const streamed = [];
const channels = new Map();
for (let record = stream.nextRecord(); record; record = stream.nextRecord()) {
  if (record.type === "Channel") channels.set(record.id, record);
  if (record.type === "Message") streamed.push(record);
}
assert.ok(stream.done());
check(streamed, channels);
console.log(`${log}: ${indexed.length} messages of ${frames.length} frames as recorded`);
