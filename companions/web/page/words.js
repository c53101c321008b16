// Numbers and elements as the page writes them.

export const by = (id) => document.getElementById(id);

/// A number with so many digits, in powers of ten where it is very small or large.
export function digits(x, count = 3) {
  if (x === null || x === undefined || !Number.isFinite(x)) return "–";
  if (x === 0) return "0";
  const size = Math.abs(x);
  if (size < 1e-3 || size >= 1e5) {
    const [head, power] = x.toExponential(count - 1).split("e");
    return `${head.replace("-", "−")}·10${[...String(Number(power))].map((c) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[c] ?? "⁻").join("")}`;
  }
  const places = Math.max(0, count - 1 - Math.floor(Math.log10(size)));
  return x.toFixed(places).replace("-", "−");
}

/// A number of cycles or bytes.
export const grouped = (x) => String(Math.round(x)).replace(/\B(?=(\d{3})+$)/g, ",").replace("-", "−");

/// An element with attributes and children.
export function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key === "on") Object.entries(value).forEach(([event, listener]) => made.addEventListener(event, listener));
    else if (value === true) made.setAttribute(key, "");
    else if (value !== false && value !== null && value !== undefined) made.setAttribute(key, value);
  }
  made.append(...children);
  return made;
}

/// The text of an element, written only if it changes.
export function write(to, text) {
  if (to.textContent !== text) to.textContent = text;
}

/// The colours of the present theme.
export function colours() {
  const style = getComputedStyle(document.documentElement);
  return (name) => style.getPropertyValue(`--${name}`).trim();
}

/// The context of a canvas that the processor draws: small pictures that change in every frame are
/// slower in textures, and ten times as slow where software stands in for a graphics processor.
export const inMemory = (canvas) => canvas.getContext("2d", { willReadFrequently: true });
