// write_mcap.mjs NODE_MODULES BUNDLE OUT [none|zstd|lz4] [OPTION...]: writes an MCAP file by Foxglove's own writer
// from what bundle_file.py wrote. Options: chunk=BYTES, no-summary, no-chunks, no-message-index, ros1, cdr (writes
// only the serialised messages: length in four bytes, then the message).
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";

const [modules, bundle, out, compression = "none", ...options] = process.argv.slice(2);
const require = createRequire(path.join(path.resolve(modules), "x.js"));
const { McapWriter } = require("@mcap/core");
const { MessageWriter } = require("@foxglove/rosmsg2-serialization");
const { ros2humble } = require("@foxglove/rosmsg-msgs-common");
const { stringify } = require("@foxglove/rosmsg");
const has = (name) => options.includes(name);
const chunkSize = Number((options.find((o) => o.startsWith("chunk=")) ?? "chunk=786432").slice(6));

const data = fs.readFileSync(bundle + ".bin");
const lines = fs.readFileSync(bundle + ".jsonl", "utf8").trim().split("\n").map((line) => JSON.parse(line));
const definitions = JSON.parse(fs.readFileSync(bundle + ".definitions.json", "utf8"));

// The definition of a type and of all that it is made of.
function closure(type, seen = new Map()) {
  if (seen.has(type)) return seen;
  seen.set(type, ros2humble[type]);
  for (const field of ros2humble[type].definitions) {
    if (field.isComplex) closure(field.type, seen);
  }
  return seen;
}

function withBytes(value) {
  if (Array.isArray(value)) return value.map(withBytes);
  if (value === null || typeof value !== "object") return value;
  if ("$bytes" in value) return data.subarray(value.$bytes[0], value.$bytes[0] + value.$bytes[1]);
  return Object.fromEntries(Object.entries(value).map(([k, v]) => [k, withBytes(v)]));
}

const long = (type) => type.replace("/", "/msg/");
function writerOf(type) {
  const list = [...closure(type).values()].map((d, i) => (i === 0 ? { ...d, name: undefined } : d));
  return new MessageWriter(list);
}

class FileWriter {
  constructor(file) { this.fd = fs.openSync(file, "w"); this.at = 0n; }
  async write(buffer) { fs.writeSync(this.fd, buffer); this.at += BigInt(buffer.byteLength); }
  position() { return this.at; }
}

async function compressor() {
  if (compression === "none") return undefined;
  if (compression === "lz4") {
    return (chunk) => ({ compression: "lz4", compressedData: execFileSync("lz4", ["-c"], { input: chunk, maxBuffer: 1 << 28 }) });
  }
  const zstd = require("@foxglove/wasm-zstd");
  await zstd.isLoaded;
  return (chunk) => ({ compression: "zstd", compressedData: zstd.compress(chunk, 3) });
}

const writers = new Map();
function serialise(line) {
  if (has("ros1")) return data.subarray(line.ros1[0], line.ros1[0] + line.ros1[1]);
  if (!writers.has(line.type)) writers.set(line.type, writerOf(line.type));
  return writers.get(line.type).writeMessage(withBytes(line.fields));
}

if (has("cdr")) {
  const fd = fs.openSync(out, "w");
  for (const line of lines) {
    const bytes = serialise(line);
    const size = Buffer.alloc(4);
    size.writeUInt32LE(bytes.byteLength);
    fs.writeSync(fd, size);
    fs.writeSync(fd, bytes);
  }
} else {
  const summary = !has("no-summary");
  const writer = new McapWriter({
    writable: new FileWriter(out), chunkSize, compressChunk: await compressor(), useChunks: !has("no-chunks"),
    useStatistics: summary, useSummaryOffsets: summary, repeatSchemas: summary, repeatChannels: summary,
    useChunkIndex: summary, useMessageIndex: !has("no-message-index"),
  });
  await writer.start({ profile: has("ros1") ? "ros1" : "ros2", library: "" });
  const channels = new Map();
  for (const line of lines) {
    if (!channels.has(line.topic)) {
      const text = has("ros1") ? definitions[line.type]
        : [...closure(line.type)].map(([name, d], i) => (i === 0 ? "" : `${"=".repeat(80)}\nMSG: ${name}\n`) + stringify([{ definitions: d.definitions }])).join("\n");
      const schemaId = await writer.registerSchema({
        name: has("ros1") ? line.type : long(line.type), encoding: has("ros1") ? "ros1msg" : "ros2msg",
        data: new TextEncoder().encode(text) });
      channels.set(line.topic, await writer.registerChannel({
        schemaId, topic: line.topic, messageEncoding: has("ros1") ? "ros1" : "cdr", metadata: new Map() }));
    }
    await writer.addMessage({ channelId: channels.get(line.topic), sequence: 0, logTime: BigInt(line.time),
      publishTime: BigInt(line.time), data: serialise(line) });
  }
  await writer.end();
}
