// Translates fields in errors: servers count the joints of a pose, whereas callers count the numbers that they sent.

/** The count of numbers in a rotation, by the encoding of its pose. */
const widths = { ROTATION_ENCODING_QUATERNION: 4, 2: 4, ROTATION_ENCODING_MATRIX: 9, 3: 9 };

/**
 * Translates a server's `field` in a message that was sent as `request` to {field, joint}. "keyframe.pose.rotations[16]" is joint 16, whose first
 * number is "keyframe.pose.rotations[48]".
 */
export function asSent(field, request) {
  const [, path, joint] = /^(.+)\.rotations\[(\d+)\]$/.exec(field) ?? [];
  if (path === undefined) return { field };
  const pose = path.split(/[.[\]]+/).filter(Boolean).reduce((value, key) => value?.[key], request);
  return { field: `${path}.rotations[${joint * (widths[pose?.encoding] ?? 3)}]`, joint: Number(joint) };
}
