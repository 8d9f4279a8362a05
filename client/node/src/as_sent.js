// Translates fields in errors: servers count the joints of a pose, whereas callers count the numbers that they sent.

/** The count of numbers in a rotation, by the encoding of its pose. */
const widths = { ROTATION_ENCODING_QUATERNION: 4, 2: 4, ROTATION_ENCODING_MATRIX: 9, 3: 9 };

const widthAt = (path, request) => widths[path.split(/[.[\]]+/).filter(Boolean).reduce((value, key) => value?.[key], request)?.encoding] ?? 3;

/** The joint of a number in a message's rotations, such as "keyframe.pose.rotations[48]": 16. Undefined for other fields. */
export function jointAt(field, request) {
  const [, path, number] = /^(.+)\.rotations\[(\d+)\]$/.exec(field) ?? [];
  return path && Math.floor(number / widthAt(path, request));
}

/**
 * Translates a server's `field` in a message that was sent as `request` to {field, joint}. "keyframe.pose.rotations[16]" is joint 16, whose first
 * number is "keyframe.pose.rotations[48]".
 */
export function asSent(field, request) {
  const [, path, joint] = /^(.+)\.rotations\[(\d+)\]$/.exec(field) ?? [];
  if (path === undefined) return { field };
  return { field: `${path}.rotations[${joint * widthAt(path, request)}]`, joint: Number(joint) };
}
