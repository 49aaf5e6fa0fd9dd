// The scene's packed arrays (levade.report.packing), and poses at any time between those that are kept.

import { Quaternion } from "three";

const ARRAYS = { f4: Float32Array, i2: Int16Array, u2: Uint16Array, u4: Uint32Array };
const UNIT = 32767; // an int16 of this size stands for 1
const scratch = new Quaternion();

export function unpack(packed) {
  const bytes = Uint8Array.from(atob(packed.data), (letter) => letter.charCodeAt(0));
  return new ARRAYS[packed.dtype](bytes.buffer);
}

export function unpackUnit(packed) {
  return Float32Array.from(unpack(packed), (value) => value / UNIT);
}

// Where t is among ascending times: {row, share}, the way from row to row + 1.
export function locate(times, t) {
  const last = times.length - 1;
  if (last < 1 || t <= times[0]) return { row: 0, share: 0 };
  if (t >= times[last]) return { row: last, share: 0 };
  let low = 0;
  let high = last;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= t) low = middle;
    else high = middle;
  }
  return { row: low, share: (t - times[low]) / (times[high] - times[low]) };
}

// Rows of `width` numbers, between two of them on the straight way.
export class Track {
  constructor(values, width) {
    this.values = values;
    this.width = width;
    this.rows = values.length / width;
  }

  at({ row, share }, place, out) {
    const { values, width } = this;
    const size = out.length;
    const here = row * width + place * size;
    const next = Math.min(row + 1, this.rows - 1) * width + place * size;
    for (let i = 0; i < size; i += 1) out[i] = values[here + i] + share * (values[next + i] - values[here + i]);
    return out;
  }
}

// Poses of bodies: position and quaternion tracks. Sets an object's pose at a time.
export class Poses {
  constructor(packed, bodies) {
    this.bodies = bodies;
    this.position = new Track(unpack(packed.position), 3 * bodies);
    this.quaternion = unpackUnit(packed.quaternion);
    this.here = new Float32Array(3);
  }

  apply(where, place, object) {
    const { row, share } = where;
    object.position.fromArray(this.position.at(where, place, this.here));
    const width = 4 * this.bodies;
    const next = Math.min(row + 1, this.position.rows - 1);
    object.quaternion.fromArray(this.quaternion, row * width + 4 * place).normalize();
    if (share > 0) {
      scratch.fromArray(this.quaternion, next * width + 4 * place).normalize();
      object.quaternion.slerp(scratch, share);
    }
  }
}


