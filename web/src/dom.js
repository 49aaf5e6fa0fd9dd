// Small helpers: elements, numbers as text, arrays as levade packs them.

const SVG = "http://www.w3.org/2000/svg";

export function el(tag, attributes = {}, ...children) {
  return fill(document.createElement(tag), attributes, children);
}

export function svg(tag, attributes = {}, ...children) {
  return fill(document.createElementNS(SVG, tag), attributes, children);
}

function fill(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else node.setAttribute(name, value === true ? "" : value);
  }
  node.append(...children.flat().filter((child) => child !== null && child !== undefined && child !== false));
  return node;
}

// An array of float32 as levade.report.packing packs it -> {data: Float32Array, shape, column(k)}
export function unpack(packed) {
  const data = new Float32Array(Uint8Array.from(atob(packed.data), (letter) => letter.charCodeAt(0)).buffer);
  const columns = packed.shape[1] ?? 1;
  const column = (k) => {
    const values = new Float32Array(packed.shape[0]);
    for (let i = 0; i < values.length; i++) values[i] = data[i * columns + k];
    return values;
  };
  return { data, shape: packed.shape, column };
}

const MINUS = "\u2212";

// Fixed digits, a true minus sign, no "-0.00".
export function fixed(value, digits) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "\u2013";
  const text = Math.abs(value).toFixed(digits);
  return (value < 0 && Number(text) !== 0 ? MINUS : "") + text;
}

export function signed(value, digits) {
  const text = fixed(value, digits);
  return text.startsWith(MINUS) || !(value > 0) ? text : "+" + text;
}

// Significant digits; a power of ten where plain digits would be long.
export function significant(value, digits = 3) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "\u2013";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e-3 && size < 1e5) return (value < 0 ? MINUS : "") + String(Number(size.toPrecision(digits)));
  const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
  return mantissa.replace("-", MINUS) + "\u00d710" + superscript(Number(exponent));
}

export function superscript(number) {
  return String(number).replace(/./g, (c) => (c === "-" ? "\u207b" : "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"[c]));
}

export function degrees(radians, digits = 1) {
  return fixed((radians * 180) / Math.PI, digits) + "\u00b0";
}
