// The tab "Real arm": positions of an SO-101 over Web Serial. The library makes the request and
// reads the replies.
import { state } from "./state.js";
import { by, element, write } from "./words.js";

const SPEED = 1_000_000;
const SERVOS = 6;
/// The bytes of a reply to a read of two, and how long all replies may take, ms.
const REPLY = 8;
const PATIENCE = 100;

const serial = { port: null, reader: null, stop: false };

/// Whatever is at hand within the time: a promise that does not lose what the reader gives later.
function within(promise, time) {
  let timer;
  const late = new Promise((done) => (timer = setTimeout(() => done({ late: true }), time)));
  return Promise.race([promise, late]).finally(() => clearTimeout(timer));
}

/// Asks the servos once: their positions in rad.
async function ask(port) {
  const request = state.library.call({ op: "ask_servos" });
  const writer = port.writable.getWriter();
  try {
    await writer.write(new Uint8Array(request));
  } finally {
    writer.releaseLock();
  }
  const bytes = [];
  const end = performance.now() + PATIENCE;
  while (bytes.length < SERVOS * REPLY && performance.now() < end) {
    serial.pending ??= serial.reader.read();
    const chunk = await within(serial.pending, end - performance.now());
    if (chunk.late) break;
    serial.pending = null;
    if (chunk.done) throw new Error("the port was closed");
    bytes.push(...chunk.value);
  }
  return state.library.call({ op: "servo_positions", bytes });
}

/// Opens a port and shows the arm's positions until it is stopped.
export async function connect(port) {
  serial.stop = false;
  await port.open({ baudRate: SPEED });
  serial.port = port;
  serial.reader = port.readable.getReader();
  serial.pending = null;
  by("disconnect").disabled = false;
  by("connect").disabled = true;
  if (state.robot.key !== "so101") state.select("so101");
  let lost = 0;
  try {
    while (!serial.stop) {
      try {
        const q = await ask(port);
        lost = 0;
        state.measured = q;
        by("positions").replaceChildren(...q.map((x, i) => element("li", {}, `${state.robot.about.joints[i]?.name ?? i}: ${x.toFixed(4).replace("-", "−")} rad`)));
        write(by("serial-state"), "Reading six servos.");
      } catch (error) {
        lost += 1;
        write(by("serial-state"), `${error.message}.`);
        if (lost > 20) break;
      }
      await new Promise((done) => setTimeout(done, 20));
    }
  } finally {
    await serial.reader.cancel().catch(() => {});
    serial.reader.releaseLock();
    await port.close().catch(() => {});
    state.measured = null;
    by("disconnect").disabled = true;
    by("connect").disabled = false;
    if (lost > 20) write(by("serial-state"), `${by("serial-state").textContent} Stopped after 20 requests without a reply.`);
  }
}

/// A frame: the measured arm and the torques that gravity takes there.
export function serialFrame() {
  if (!state.measured) return;
  state.q = state.measured.map((x, i) => x);
  state.qd = state.q.map(() => 0);
  state.qdd = state.q.map(() => 0);
}

export function startSerial() {
  const there = "serial" in navigator;
  by("connect").disabled = !there;
  by("no-serial").hidden = there;
  by("connect").addEventListener("click", async () => {
    write(by("serial-state"), "Choose the arm's port in the browser's list; where the list is empty, no arm is plugged in.");
    try {
      await connect(await navigator.serial.requestPort());
    } catch (error) {
      write(by("serial-state"), `No arm: ${error.message}`);
    }
  });
  by("disconnect").addEventListener("click", () => (serial.stop = true));
}
