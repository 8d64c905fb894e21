// read_mcap.mjs FILE: reads an MCAP file by Foxglove's own readers, whole, with all check sums; see scripts/read_mcap.
import fs from "node:fs/promises";
import { createRequire } from "node:module";

const require = createRequire(import.meta.url);
const { McapIndexedReader, McapStreamReader } = require("@mcap/core");
const { parse } = require("@foxglove/rosmsg");
const { MessageReader } = require("@foxglove/rosmsg2-serialization");
const { ZstdModule } = { ZstdModule: require("@foxglove/wasm-zstd") };

await ZstdModule.isLoaded;
const decompressHandlers = { zstd: (data, size) => ZstdModule.decompress(data, Number(size)) };
const file = await fs.open(process.argv[2]);
const size = (await file.stat()).size;
const readable = {
  size: async () => BigInt(size),
  read: async (offset, length) => {
    const bytes = new Uint8Array(Number(length));
    await file.read(bytes, 0, Number(length), Number(offset));
    return bytes;
  },
};

const brief = (key, value) => {
  if (typeof value === "bigint") return value.toString();
  if (ArrayBuffer.isView(value)) return value.length > 12 ? `${value.length} numbers` : Array.from(value);
  if (Array.isArray(value) && value.length > 12) return `${value.length} items`;
  return value;
};

const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
const topics = new Map();
for await (const message of reader.readMessages({ validateCrcs: true })) {
  const channel = reader.channelsById.get(message.channelId);
  const schema = reader.schemasById.get(channel.schemaId);
  const topic = topics.get(channel.topic) ?? { type: schema.name, count: 0, schema };
  if (topic.count === 0) {
    const definition = parse(new TextDecoder().decode(schema.data), { ros2: true });
    topic.first = new MessageReader(definition).readMessage(message.data);
  }
  ++topic.count;
  topics.set(channel.topic, topic);
}
for (const [name, topic] of topics) console.log(name, topic.type, topic.count, JSON.stringify(topic.first, brief));

// Once more without the index, as a stream.
const stream = new McapStreamReader({ decompressHandlers, validateCrcs: true });
let messages = 0;
stream.append(await fs.readFile(process.argv[2]));
for (let record; (record = stream.nextRecord()); ) messages += record.type === "Message" ? 1 : 0;
console.log("messages in the stream:", messages, "statistics:", reader.statistics.messageCount.toString());
await file.close();
