// A simulated SO-101 for the page: an object as Web Serial's ports are, whose servos speak
// Feetech's protocol byte by byte. It runs in the page, and is given to it as text.
export function simulatedPort(counts, { silent = null, wrongChecksum = null } = {}) {
  const asked = [];
  let reply;
  const sum = (bytes) => ~bytes.slice(2).reduce((a, b) => a + b, 0) & 0xff;
  const state = { opened: null, closed: false, requests: 0, bad: 0 };
  /// The instruction packet at the start of what was asked, if it is whole.
  const packet = () => {
    while (asked.length >= 2 && (asked[0] !== 0xff || asked[1] !== 0xff)) asked.shift();
    if (asked.length < 4 || asked.length < 4 + asked[3]) return null;
    return asked.splice(0, 4 + asked[3]);
  };
  const answer = (bytes) => {
    if (sum(bytes.slice(0, -1)) !== bytes.at(-1)) return void (state.bad += 1);
    const [, , id, , instruction, address, length, ...ids] = bytes;
    if (id !== 0xfe || instruction !== 0x82 || address !== 0x38 || length !== 2) return void (state.bad += 1);
    state.requests += 1;
    for (const servo of ids.slice(0, -1)) {
      if (servo === silent || !(servo in counts)) return;
      const body = [0xff, 0xff, servo, 4, 0, counts[servo] & 0xff, counts[servo] >> 8];
      body.push(servo === wrongChecksum ? 0 : sum(body));
      // A byte at a time: a port gives no packets.
      for (const byte of body) reply.enqueue(new Uint8Array([byte]));
    }
  };
  return {
    state,
    async open({ baudRate }) {
      state.opened = baudRate;
      this.readable = new ReadableStream({ start: (controller) => void (reply = controller) });
      this.writable = new WritableStream({
        write: (chunk) => {
          for (const byte of chunk) {
            asked.push(byte);
            const whole = packet();
            if (whole) answer(whole);
          }
        },
      });
    },
    async close() {
      state.closed = true;
    },
  };
}
