// Vectors are [x, y, z], quaternions [x, y, z, w], matrices 9 numbers, row by row.

export const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scaled = (a, by) => [a[0] * by, a[1] * by, a[2] * by];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const length = (a) => Math.sqrt(dot(a, a));
export const unit = (a) => scaled(a, 1 / length(a));
export const middle = (a, b) => scaled(add(a, b), 0.5);

/** No turn. */
export const identity = [1, 0, 0, 0, 1, 0, 0, 0, 1];
export const column = (m, i) => [m[i], m[i + 3], m[i + 6]];
export const transposed = (m) => [m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]];
export const turned = (m, v) => [dot(m, v), m[3] * v[0] + m[4] * v[1] + m[5] * v[2], m[6] * v[0] + m[7] * v[1] + m[8] * v[2]];
/** Scales the columns. */
export const stretched = (m, [x, y, z]) => [m[0] * x, m[1] * y, m[2] * z, m[3] * x, m[4] * y, m[5] * z, m[6] * x, m[7] * y, m[8] * z];

export function times(a, b) {
  const out = new Array(9);
  for (let row = 0; row < 9; row += 3) {
    for (let i = 0; i < 3; ++i) out[row + i] = a[row] * b[i] + a[row + 1] * b[i + 3] + a[row + 2] * b[i + 6];
  }
  return out;
}

export function inverse(m) {
  const [a, b, c] = [m.slice(0, 3), m.slice(3, 6), m.slice(6)];
  const columns = [cross(b, c), cross(c, a), cross(a, b)];
  const determinant = dot(a, columns[0]);
  return transposed(columns.flatMap((one) => scaled(one, 1 / determinant)));
}

/** The rotation that is nearest to a matrix: Newton's iteration for its polar part. */
export function nearestRotation(m) {
  let now = m;
  for (let i = 0; i < 50; ++i) {
    const other = transposed(inverse(now));
    const next = now.map((one, at) => (one + other[at]) / 2);
    const change = Math.max(...next.map((one, at) => Math.abs(one - now[at])));
    now = next;
    if (change < 1e-14) break;
  }
  return now;
}

export function fromQuaternion([x, y, z, w]) {
  return [
    1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
    2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
    2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y),
  ];
}

export function toQuaternion(m) {
  const trace = m[0] + m[4] + m[8];
  if (trace > 0) {
    const w = Math.sqrt(trace + 1) / 2;
    return [(m[7] - m[5]) / (4 * w), (m[2] - m[6]) / (4 * w), (m[3] - m[1]) / (4 * w), w];
  }
  // The largest component first: the others are divided by it.
  const i = m[0] > m[4] ? (m[0] > m[8] ? 0 : 2) : m[4] > m[8] ? 1 : 2;
  const [j, k] = [(i + 1) % 3, (i + 2) % 3];
  const largest = Math.sqrt(1 + m[4 * i] - m[4 * j] - m[4 * k]) / 2;
  const out = [0, 0, 0, (m[3 * k + j] - m[3 * j + k]) / (4 * largest)];
  out[i] = largest;
  out[j] = (m[3 * j + i] + m[3 * i + j]) / (4 * largest);
  out[k] = (m[3 * k + i] + m[3 * i + k]) / (4 * largest);
  return out;
}

/** A turn by `angle` about the unit vector `axis`. */
export const about = (axis, angle) => fromQuaternion([...scaled(axis, Math.sin(angle / 2)), Math.cos(angle / 2)]);

/** Of an axis-angle vector. */
export function fromVector(v) {
  const angle = length(v);
  const scale = angle < 1e-8 ? 0.5 : Math.sin(angle / 2) / angle;
  return fromQuaternion([...scaled(v, scale), Math.cos(angle / 2)]);
}

/** The shortest turn from the direction of `a` to that of `b`. */
export function between(a, b) {
  const [from, to] = [unit(a), unit(b)];
  const cosine = dot(from, to);
  if (cosine > -1 + 1e-12) {
    const w = Math.sqrt((1 + cosine) / 2);
    return fromQuaternion([...scaled(cross(from, to), 1 / (2 * w)), w]);
  }
  const across = Math.abs(from[0]) < 0.5 ? [1, 0, 0] : [0, 1, 0];
  return about(unit(cross(from, across)), Math.PI);
}

/** The point `t` of the way from one quaternion to another, 0 to 1, the short way round. */
export function slerp(a, b, t) {
  const cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  const size = Math.abs(cosine);
  let [before, after] = [1 - t, t];
  if (size < 1 - 1e-12) {
    const angle = Math.acos(size);
    before = Math.sin((1 - t) * angle) / Math.sin(angle);
    after = Math.sin(t * angle) / Math.sin(angle);
  }
  if (cosine < 0) after = -after;
  return a.map((one, i) => before * one + after * b[i]);
}
