// Rotations as axis-angle vectors, [x, y, z] in radians.

export const radians = (degrees) => (degrees * Math.PI) / 180;

/** Converts an axis-angle vector to [w, x, y, z]. */
function quaternion(rotation) {
  const angle = Math.hypot(...rotation);
  const scale = angle > 0 ? Math.sin(angle / 2) / angle : 0.5;
  return [Math.cos(angle / 2), ...rotation.map((one) => scale * one)];
}

const product = (a, b) => [
  a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
  a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
  a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
  a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
];

/** The product of rotations, as the shortest axis-angle vector. It applies the last one first. */
export function times(...rotations) {
  const [w, ...axis] = rotations.map(quaternion).reduce(product);
  const sine = Math.hypot(...axis);
  const scale = sine > 0 ? (2 * Math.atan2(sine, Math.abs(w))) / sine : 2;
  return axis.map((one) => (w < 0 ? -scale : scale) * one);
}

/** Rotates a vector. */
export function turned(rotation, vector) {
  const q = quaternion(rotation);
  return product(product(q, [0, ...vector]), [q[0], -q[1], -q[2], -q[3]]).slice(1);
}
