// SPDX-License-Identifier: Apache-2.0
// Reads a record of RAVE with the reference reader (@mcap/core) and decodes every message with its
// own schema. Usage: node check_mcap.mjs WRITE_SAMPLE_PROGRAM SCRATCH_FOLDER
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import path from "node:path";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import zstd from "@foxglove/wasm-zstd";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";

const STEPS = 400;
const [program, scratch] = process.argv.slice(2);
await zstd.isLoaded;
const decompressHandlers = { zstd: (bytes, size) => zstd.decompress(bytes, Number(size)) };

/** An IReadable over bytes in memory. */
const readable = (bytes) => ({
  size: async () => BigInt(bytes.length),
  read: async (offset, size) => bytes.subarray(Number(offset), Number(offset + size)),
});

/** The decoder of each channel, from the schema that stands in the record. */
function decoders(schemas, channels) {
  const found = new Map();
  for (const channel of channels.values()) {
    assert.equal(channel.messageEncoding, "cdr");
    assert.equal(channel.metadata.get("offered_qos_profiles"), "");
    const schema = schemas.get(channel.schemaId);
    assert.equal(schema.encoding, "ros2msg");
    const text = new TextDecoder().decode(schema.data);
    const reader = new MessageReader(parse(text, { ros2: true }));
    found.set(channel.id, { topic: channel.topic, read: (data) => reader.readMessage(data) });
  }
  return found;
}

async function check_index(bytes) {
  const reader = await McapIndexedReader.Initialize({ readable: readable(bytes), decompressHandlers });
  assert.equal(reader.header.profile, "ros2");
  const decode = decoders(reader.schemasById, reader.channelsById);
  const counts = new Map();
  let last = 0n;
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    assert.ok(message.logTime >= last, "messages in order of time");
    last = message.logTime;
    const channel = decode.get(message.channelId);
    check_content(channel.topic, channel.read(message.data), counts.get(channel.topic) ?? 0);
    counts.set(channel.topic, (counts.get(channel.topic) ?? 0) + 1);
  }
  const statistics = reader.statistics;
  assert.equal(statistics.messageCount, BigInt([...counts.values()].reduce((a, b) => a + b)));
  for (const [id, count] of statistics.channelMessageCounts) {
    assert.equal(count, BigInt(counts.get(decode.get(id).topic)));
  }
  assert.equal(statistics.chunkCount, reader.chunkIndexes.length);
  assert.ok(reader.chunkIndexes.length > 2);
  assert.equal(counts.get("/rave/poses"), STEPS);
  assert.equal(counts.get("/rave/percepts"), STEPS);
  for (const topic of ["/rave/run", "/rave/end", "/rave/commands", "/rave/actuators", "/rave/hash", "/rave/radio", "/rave/events",
    "/rosout", "/tf", "/tf_static", "/anna/laser", "/bert/cmd_vel"]) {
    assert.ok(counts.get(topic) > 0, topic);
  }
  for await (const attachment of reader.readAttachments({ validateCrcs: true })) {
    assert.equal(attachment.name, "scenario.yaml");
    assert.equal(new TextDecoder().decode(attachment.data), "name: sample\nrobots: [anna, bert]\n");
  }
  const names = [];
  for await (const metadata of reader.readMetadata()) names.push(metadata.name);
  assert.deepEqual(names.sort(), ["rave.end", "rave.inputs", "rave.run"]);
  return counts;
}

/** What libs/record/tests/sample_run.hpp records, for message number `index` of a topic. */
function check_content(topic, message, index) {
  if (topic === "/rave/poses") {
    assert.equal(message.step, BigInt(index));
    assert.equal(message.robots.length, 2);
    assert.equal(message.robots[0].x, index / 3);
    assert.equal(message.robots[0].wz, -index);
    assert.equal(message.true_poses.length, index % 2 === 0 ? 1 : 0);
  } else if (topic === "/rave/percepts") {
    assert.deepEqual(message.percepts.map((p) => p.part), [1, 0]);
    const result = message.percepts[1];
    const bytes = message.records.slice(result.offset, result.offset + result.size);
    assert.equal(new Float32Array(bytes.buffer)[0], Math.fround(Math.fround(index) / 7));
  } else if (topic === "/anna/laser") {
    assert.equal(message.header.frame_id, "anna/laser");
    assert.equal(message.ranges.length, 3);
    assert.equal(message.ranges[1], Infinity);
  } else if (topic === "/tf") {
    assert.equal(message.transforms[0].header.frame_id, "world");
    assert.equal(message.transforms[0].child_frame_id, "anna");
    assert.ok(Math.abs(message.transforms[0].transform.rotation.z - Math.sin(0.05)) < 1e-15);
  } else if (topic === "/rosout") {
    assert.equal(message.level, 30);
    assert.equal(message.msg, "low battery");
  } else if (topic === "/bert/cmd_vel") {
    assert.equal(message.angular.z, -0.25);
  } else if (topic === "/rave/run") {
    assert.equal(message.seed, 0xffffffffffffffffn);
    assert.deepEqual(message.robots.map((robot) => robot.name), ["anna", "bert"]);
    assert.deepEqual([...message.sensors[0].bearings_rad], [-0.5, 0, 0.5]);
  } else if (topic === "/rave/end") {
    assert.equal(message.hash, 0x0123456789abcdefn);
  }
}

/** From the front, as one reads a file that is still written or was cut. */
function check_stream(bytes, whole) {
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  reader.append(bytes);
  let messages = 0;
  for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
    if (record.type === "Message") ++messages;
  }
  assert.equal(reader.done(), whole);
  return messages;
}

const folder = mkdtempSync(path.join(scratch, "rave-check-mcap-"));
try {
  const file = path.join(folder, "sample.mcap");
  execFileSync(program, [file, String(STEPS)]);
  const bytes = new Uint8Array(readFileSync(file));
  const counts = await check_index(bytes);
  const messages = [...counts.values()].reduce((a, b) => a + b);
  assert.equal(check_stream(bytes, true), messages);
  const half = check_stream(bytes.subarray(0, Math.floor(bytes.length / 2)), false);
  assert.ok(half > 0 && half < messages);
  console.log(`${messages} messages on ${counts.size} topics read; ${half} from half of the file`);
} finally {
  rmSync(folder, { recursive: true });
}
