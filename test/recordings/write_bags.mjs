// Writes the test bags into bags/ with the MCAP and CDR writers of others; README.md says how to run it.
import { CdrWriter, EncapsulationKind } from "@foxglove/cdr";
import { ros2humble } from "@foxglove/rosmsg-msgs-common";
import { MessageWriter } from "@foxglove/rosmsg2-serialization";
import { McapWriter } from "@mcap/core";
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";

const folder = new URL("./bags/", import.meta.url).pathname;
rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });

// A definition and all that it refers to, as the serialiser wants them.
function definitions(name) {
  const list = [];
  const visit = (type) => {
    if (list.some((d) => d.name === type)) return;
    const definition = ros2humble[type];
    list.push({ name: type, definitions: definition.definitions });
    for (const field of definition.definitions) if (field.isComplex) visit(field.type);
  };
  visit(name);
  return list;
}
const writers = {};
function encoded(type, message) {
  writers[type] ??= new MessageWriter(definitions(type));
  return writers[type].writeMessage(message);
}

// The run, known to the tests by the same formulas: sample i of the wheels at i / 50 s, of the truth at i / 25 s. Stamps
// of the headers; the log is 3 ms later.
const START_S = 1700000000;
let samples = 60;
const stampOf = (ns) => ({ sec: START_S + Math.floor(ns / 1e9), nanosec: ns % 1e9 });
const header = (ns, frame_id) => ({ stamp: stampOf(ns), frame_id });
const logged = (ns) => BigInt(START_S) * 1000000000n + BigInt(ns) + 3000000n;
const wheels = (i) => ({ left: 0.25 * i, right: 0.5 * i });
const truth = (i) => ({ x: 0.01 * i, y: -0.02 * i, heading: 0.03 * i });
const pose = (i) => ({
  position: { x: truth(i).x, y: truth(i).y, z: 0.125 },
  orientation: { x: 0, y: 0, z: Math.sin(truth(i).heading / 2), w: Math.cos(truth(i).heading / 2) },
});
const covariance = Array.from({ length: 36 }, (_, i) => i);
const twist = (i) => ({ linear: { x: 0.2 + 0.001 * i, y: 0, z: 0 }, angular: { x: 0, y: 0, z: -0.01 * i } });

const jointState = (ns, i) => ({
  header: header(ns, ""),
  name: ["arm_joint", "wheel_right_joint", "wheel_left_joint"], // odd lengths: alignment matters
  position: [0.5, wheels(i).right, wheels(i).left],
  velocity: [],
  effort: [0, 0, 0],
});
const transform = (ns, i, parent, child) => ({
  header: header(ns, parent),
  child_frame_id: child,
  transform: {
    translation: { x: truth(i).x, y: truth(i).y, z: 0 },
    rotation: pose(i).orientation,
  },
});

// [topic, type, log time, bytes] in the order in which they are written
function run(extra = []) {
  const messages = [];
  for (let i = 0; i < samples; ++i) {
    const ns = i * 20000000;
    messages.push(["/joint_states", "sensor_msgs/JointState", ns, jointState(ns, i)]);
    if (i % 2 === 0) {
      messages.push(["/mocap/pose", "geometry_msgs/PoseStamped", ns, { header: header(ns, "world"), pose: pose(i / 2) }]);
      messages.push(["/cmd_vel", "geometry_msgs/Twist", ns, twist(i / 2)]);
    }
    for (const more of extra) more(messages, ns, i);
  }
  return messages.map(([topic, type, ns, message]) => [topic, type, logged(ns), encoded(type, message)]);
}

// Every type, and topics that are not plain.
const allTypes = () => run([
  (m, ns, i) => {
    if (i % 2 !== 0) return;
    const k = i / 2;
    m.push(["/odom", "nav_msgs/Odometry", ns, {
      header: header(ns, "odom"), child_frame_id: "base_link",
      pose: { pose: pose(k), covariance }, twist: { twist: twist(k), covariance },
    }]);
    m.push(["/tracked", "geometry_msgs/PoseWithCovarianceStamped", ns,
      { header: header(ns, "map"), pose: { pose: pose(k), covariance } }]);
    m.push(["/vicon/robot", "geometry_msgs/TransformStamped", ns, transform(ns, k, "vicon", "robot")]);
    m.push(["/tf", "tf2_msgs/TFMessage", ns, { transforms: [
      transform(ns, 2 * k, "odom", "base_link"), transform(ns, k, "world", "marker_body"),
    ] }]);
    m.push(["/teleop", "geometry_msgs/TwistStamped", ns, { header: header(ns, ""), twist: twist(k) }]);
    m.push(["/goal_pose", "geometry_msgs/PoseStamped", ns, { header: header(ns, "map"), pose: pose(0) }]);
  },
]);

// The truth as a navigating robot has it: map to odom by the localisation at 5 Hz, odom to base_footprint by the wheels at
// 50 Hz, base_footprint to base_link once, on /tf_static. The wheels' heading and place drift in proportion to time, the
// localisation takes it back, so that the product is the truth of the formulas at each stamp.
const planar = (x, y, heading) => ({ x, y, heading });
const times = (a, b) => planar(a.x + Math.cos(a.heading) * b.x - Math.sin(a.heading) * b.y,
  a.y + Math.sin(a.heading) * b.x + Math.cos(a.heading) * b.y, a.heading + b.heading);
const inverse = (a) => planar(-Math.cos(a.heading) * a.x - Math.sin(a.heading) * a.y,
  Math.sin(a.heading) * a.x - Math.cos(a.heading) * a.y, -a.heading);
const FOOTPRINT_TO_LINK = planar(0.1, 0.05, 0.2);
const mapToOdom = (s) => planar(1 + 0.5 * s, -2 + 0.25 * s, 0.3 + 0.4 * s);
const transformOf = (ns, parent, child, p) => ({
  header: header(ns, parent), child_frame_id: child,
  transform: { translation: { x: p.x, y: p.y, z: 0 },
    rotation: { x: 0, y: 0, z: Math.sin(p.heading / 2), w: Math.cos(p.heading / 2) } },
});
const chained = () => {
  const messages = run([
    (m, ns, i) => {
      if (i === 0)
        m.push(["/tf_static", "tf2_msgs/TFMessage", ns, { transforms: [
          transformOf(ns, "base_footprint", "base_link", FOOTPRINT_TO_LINK),
          transformOf(ns, "base_link", "laser", planar(0.2, 0, 0)),
        ] }]);
      const map = mapToOdom(ns / 1e9), t = truth(i / 2);
      const footprint = times(planar(t.x, t.y, t.heading), inverse(FOOTPRINT_TO_LINK));
      m.push(["/tf", "tf2_msgs/TFMessage", ns,
        { transforms: [transformOf(ns, "odom", "base_footprint", times(inverse(map), footprint))] }]);
      if (i % 10 === 0)
        m.push(["/tf", "tf2_msgs/TFMessage", ns, { transforms: [transformOf(ns, "map", "odom", map)] }]);
    },
  ]);
  return messages.filter(([topic]) => topic !== "/mocap/pose");
};

class Bytes {
  parts = [];
  size = 0n;
  position() { return this.size; }
  async write(bytes) {
    this.parts.push(Uint8Array.from(bytes));
    this.size += BigInt(bytes.byteLength);
  }
}

async function mcap(name, messages, options = {}) {
  const writable = new Bytes();
  const writer = new McapWriter({ writable, chunkSize: 4096, ...options });
  await writer.start({ profile: "ros2", library: "test" });
  const channels = new Map();
  for (const [topic, type, time, data] of messages) {
    if (!channels.has(topic)) {
      const schemaId = await writer.registerSchema({
        name: type.replace("/", "/msg/"), encoding: "ros2msg", data: new TextEncoder().encode("# " + type),
      });
      channels.set(topic, await writer.registerChannel(
        { schemaId, topic, messageEncoding: "cdr", metadata: new Map([["offered_qos_profiles", ""]]) }));
    }
    await writer.addMessage({ channelId: channels.get(topic), sequence: 0, logTime: time, publishTime: time, data });
  }
  await writer.end();
  writeFileSync(folder + name, Buffer.concat(writable.parts));
}

const packed = (compression, program, args) => ({
  compressChunk: (input) => ({ compression, compressedData: execFileSync(program, args, { input }) }),
});

// The same numbers with the most significant byte first, field by field.
function bigEndian() {
  const start = () => new CdrWriter({ kind: EncapsulationKind.CDR_BE });
  const stamp = (w, ns, frame) => {
    w.int32(stampOf(ns).sec);
    w.uint32(stampOf(ns).nanosec);
    w.string(frame);
  };
  return run().map(([topic, type, time], index) => {
    const w = start();
    const ns = Number(time - logged(0));
    const i = Math.round(ns / 20000000);
    if (topic === "/joint_states") {
      const m = jointState(ns, i);
      stamp(w, ns, "");
      w.sequenceLength(m.name.length);
      for (const name of m.name) w.string(name);
      for (const list of [m.position, m.velocity, m.effort]) w.float64Array(list, true);
    } else if (topic === "/mocap/pose") {
      const { position: p, orientation: q } = pose(i / 2);
      stamp(w, ns, "world");
      for (const v of [p.x, p.y, p.z, q.x, q.y, q.z, q.w]) w.float64(v);
    } else {
      const t = twist(i / 2);
      for (const v of [t.linear.x, 0, 0, 0, 0, t.angular.z]) w.float64(v);
    }
    return [topic, type, time, w.data];
  });
}

await mcap("plain.mcap", run(), { useChunks: false });
await mcap("chunks.mcap", run());
await mcap("zstd.mcap", run(), packed("zstd", "zstd", ["-q", "-c"]));
await mcap("lz4.mcap", run(), packed("lz4", "lz4", ["-q", "-c"]));
await mcap("no_index.mcap", run(), {
  useStatistics: false, useSummaryOffsets: false, repeatSchemas: false, repeatChannels: false,
  useMessageIndex: false, useChunkIndex: false, useAttachmentIndex: false, useMetadataIndex: false,
});
await mcap("big_endian.mcap", bigEndian());
await mcap("tf_chain.mcap", chained());
await mcap("every_type.mcap", allTypes(), packed("zstd", "zstd", ["-q", "-c"]));

// The same without checksums, so that a fuzzer's changes get past them: those of chunks, and the one over all data.
function withoutChecksums(file) {
  const bytes = Buffer.from(file);
  for (let at = 8; at + 9 <= bytes.length; ) {
    const opcode = bytes[at];
    const size = Number(bytes.readBigUInt64LE(at + 1));
    if (opcode === 0x06) bytes.writeUInt32LE(0, at + 9 + 24);
    if (opcode === 0x0f) bytes.writeUInt32LE(0, at + 9);
    at += 9 + size;
    if (opcode === 0x02) break;
  }
  return bytes;
}

// For write_db3.py, which knows SQLite: the messages as they are.
const plain = (messages) => messages.map(([topic, type, time, data]) =>
  ({ topic, type: type.replace("/", "/msg/"), time: time.toString(), data: Buffer.from(data).toString("base64") }));
execFileSync("python3", [new URL("./write_db3.py", import.meta.url).pathname, folder],
  { input: JSON.stringify(plain(run())), stdio: ["pipe", "inherit", "inherit"] });

// What rosbag2 makes of them with compression_mode FILE.
mkdirSync(folder + "packed");
for (const name of ["two_files_0.db3", "two_files_1.db3"])
  execFileSync("zstd", ["-q", "-19", folder + "two_files/" + name, "-o", folder + "packed/" + name.replace("two_files", "packed") + ".zstd"]);
execFileSync("zstd", ["-q", "-19", folder + "plain.mcap", "-o", folder + "packed.mcap.zstd"]);

// Seeds of the fuzzers: three samples of everything.
samples = 3;
const seeds = new URL("../fuzz/seeds/", import.meta.url).pathname;
for (const name of ["mcap", "packed", "sqlite", "messages"]) {
  rmSync(seeds + name, { recursive: true, force: true });
  mkdirSync(seeds + name, { recursive: true });
}
const few = run(), fewOfAll = allTypes(), fewChained = chained();
await mcap("small.mcap", few, { useChunks: false });
await mcap("small_chunks.mcap", few, { chunkSize: 500 });
await mcap("small_zstd.mcap", few, packed("zstd", "zstd", ["-q", "-c"]));
await mcap("small_lz4.mcap", few, packed("lz4", "lz4", ["-q", "-c"]));
await mcap("small_all.mcap", fewOfAll, { chunkSize: 2000 });
await mcap("small_chain.mcap", fewChained, { useChunks: false });
for (const name of ["small", "small_chunks", "small_zstd", "small_lz4", "small_all", "small_chain"]) {
  writeFileSync(seeds + "mcap/" + name + ".mcap", withoutChecksums(readFileSync(folder + name + ".mcap")));
  rmSync(folder + name + ".mcap");
}
execFileSync("zstd", ["-q", seeds + "mcap/small.mcap", "-o", seeds + "packed/small.mcap.zstd"]);
execFileSync("python3", [new URL("./write_db3.py", import.meta.url).pathname, seeds + "sqlite", "512"],
  { input: JSON.stringify(plain(few)), stdio: ["pipe", "inherit", "inherit"] });
// the type's number as in fuzz_messages.cpp, then the message
const types = ["nav_msgs/Odometry", "geometry_msgs/PoseStamped", "geometry_msgs/PoseWithCovarianceStamped",
  "geometry_msgs/TransformStamped", "tf2_msgs/TFMessage", "geometry_msgs/Twist", "geometry_msgs/TwistStamped",
  "sensor_msgs/JointState"];
for (const [topic, type, , data] of [...fewOfAll].reverse())
  writeFileSync(seeds + "messages/" + types.indexOf(type) + "_little", Buffer.concat([Buffer.from([types.indexOf(type)]), data]));
for (const [topic, type, , data] of bigEndian())
  writeFileSync(seeds + "messages/" + types.indexOf(type) + "_big", Buffer.concat([Buffer.from([types.indexOf(type)]), data]));
