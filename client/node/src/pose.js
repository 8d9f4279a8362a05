/** The body of `skeleton` standing at rest, where and however `rotations` ({joint name: [x, y, z] in radians}) turn it. */
export function pose(skeleton, rotations = {}, { x = 0, z = 0 } = {}) {
  return {
    root_position: { x, y: skeleton.pelvis_height, z },
    rotations: skeleton.joint_names.flatMap((joint) => rotations[joint] ?? [0, 0, 0]),
  };
}
