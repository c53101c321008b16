// Torques as bars: for each joint a row in which the effects' parts are stacked to both sides, and
// a line at the sum.
import { EFFECTS } from "./state.js";
import { digits, inMemory } from "./words.js";

const ROW = 30;

/// Whether a torque is above a joint's limit; it may have none.
export const isBeyond = (torque, limit) => limit > 0 && Math.abs(torque) > limit;

export class Bars {
  constructor(canvas) {
    this.canvas = canvas;
    this.scale = 1;
  }

  /// Draws the torques of joints; those beyond its limit in another colour.
  draw(joints, computed, colour) {
    const canvas = this.canvas;
    const width = canvas.parentElement.clientWidth;
    const height = joints.length * ROW + 18;
    const ratio = Math.min(2, devicePixelRatio);
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
      canvas.style.height = `${height}px`;
    }
    const context = inMemory(canvas);
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    const label = Math.min(130, width * 0.28);
    const value = 64;
    const middle = label + (width - label - value) / 2;
    const half = (width - label - value) / 2 - 4;
    this.fit(computed);
    const x = (torque) => middle + (torque / this.scale) * half;
    context.font = "13px system-ui, sans-serif";
    context.textBaseline = "middle";
    joints.forEach(({ name, torque: limit }, joint) => {
      const y = joint * ROW + ROW / 2;
      context.fillStyle = colour("track");
      context.fillRect(label, y - 9, 2 * half + 8, 18);
      let [left, right] = [0, 0];
      EFFECTS.forEach(({ name: effect }, number) => {
        const part = computed.parts[number][joint];
        if (!part) return;
        context.fillStyle = colour(effect);
        if (part > 0) {
          context.fillRect(x(right), y - 9, Math.max(0.5, x(right + part) - x(right)), 18);
          right += part;
        } else {
          context.fillRect(x(left + part), y - 9, Math.max(0.5, x(left) - x(left + part)), 18);
          left += part;
        }
      });
      const sum = computed.single[joint];
      context.fillStyle = colour(isBeyond(sum, limit) ? "wrong" : "text");
      context.fillRect(x(sum) - 1.5, y - 12, 3, 24);
      context.textAlign = "left";
      context.fillText(name, 0, y, label - 8);
      context.textAlign = "right";
      context.fillText(digits(sum), width - 2, y);
    });
    context.strokeStyle = colour("muted");
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(middle, 0);
    context.lineTo(middle, joints.length * ROW);
    context.stroke();
    context.fillStyle = colour("muted");
    context.font = "12px system-ui, sans-serif";
    const y = joints.length * ROW + 8;
    context.textAlign = "center";
    for (const torque of [-this.scale, 0, this.scale]) {
      context.textAlign = torque < 0 ? "left" : torque > 0 ? "right" : "center";
      context.fillText(digits(torque, 2), x(torque), y);
    }
  }

  /// A scale of 1, 2 or 5 times a power of ten that all bars fit in; it shrinks late, so that it
  /// does not flicker.
  fit({ parts, single }) {
    let most = 1e-6;
    single.forEach((sum, joint) => {
      const of = parts.map((part) => part[joint]);
      const right = of.filter((x) => x > 0).reduce((a, b) => a + b, 0);
      const left = -of.filter((x) => x < 0).reduce((a, b) => a + b, 0);
      most = Math.max(most, right, left, Math.abs(sum));
    });
    if (most > this.scale || most < this.scale / 6) {
      const power = 10 ** Math.floor(Math.log10(most));
      this.scale = [1, 2, 5, 10].map((k) => k * power).find((k) => k >= most * 1.05) ?? 10 * power;
    }
  }
}
