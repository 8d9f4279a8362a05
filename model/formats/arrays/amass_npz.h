#pragma once

#include <vector>

#include "model/formats/containers/npz.h"
#include "model/formats/reading/motion_reading.h"
#include "model/motion/floor/contacts.h"
#include "model/motion/motion.h"

/// Reads and writes SMPL motion in npz files: the layouts of AMASS, AIST++ and EDGE, and our own
/// arrays.
///
/// | file    | keys                                                   | up | trans           |
/// |---------|--------------------------------------------------------|----|-----------------|
/// | ours    | root_positions [F,3], rotations [F,24,3], fps          | y  | the pelvis      |
/// | AMASS   | poses [F,66, 72, 156 or 165], trans [F,3]              | z  | pelvis minus J0 |
/// | AMASS   | root_orient [F,3], pose_body [F,63], trans             | z  | pelvis minus J0 |
/// | smplx   | global_orient [F,3], body_pose [F,63 or 69], transl    | z  | pelvis minus J0 |
/// | AIST++  | smpl_poses [F,72], smpl_trans, smpl_scaling            | y  | pelvis minus J0 |
/// | EDGE    | smpl_poses [F,72], smpl_trans                          | z  | the pelvis      |
/// | slices  | q [F,72], pos, scale: AIST++ as EDGE cuts it           | y  | pelvis minus J0 |
///
/// Other names of poses are fullpose, full_pose, pose and thetas. Rotations are axis-angle,
/// matrices or 6D (rotation_rows.h). The rate is mocap_framerate, mocap_frame_rate, fps, frame_rate
/// or framerate. J0 is the rest pelvis of SMPL, or of SMPL-X in files with 55 joints or a jaw. Of
/// 52 (SMPL-H) or 55 joints, only the body's 22 are read. Body shape (betas) is ignored: the motion
/// gets the neutral body, which is put on the floor if betas differ.
namespace choreo {

/// The rest position of the neutral body's pelvis in SMPL's own coordinates, metres.
Eigen::Vector3d SmplRestPelvis();
/// The same for SMPL-X.
Eigen::Vector3d SmplXRestPelvis();

/// Converts a pose of our world (Y up, position of the pelvis) to AMASS's (Z up, SMPL's translation
/// in `root_position`). Changes only the root, whose rotation vector then has an angle in [0, 2
/// pi].
Pose ToAmass(const Pose& pose);

/// Reads SMPL's 24 joints at the file's own rate; without one, AIST++ has 60 fps and others 30. If
/// several layouts are present, the first in the table counts. motion_check.h checks all layouts
/// but ours. Throws Error(kInvalidArgument), naming the array and its shape, or the missing keys.
Motion ReadSmplMotion(const NpzArchive& npz, const MotionReading& reading = {});

/// Adds the arrays of a motion of SMPL's skeleton: AMASS's (poses with 52 joints, trans,
/// mocap_framerate, mocap_frame_rate, gender, betas), ours, and `contacts` [F, 4], if given. Throws
/// Error(kInvalidArgument) for a motion without frames, or contacts of another length.
void AddSmplMotion(const Motion& motion, const std::vector<Contacts>* contacts, NpzArchive& npz);

}  // namespace choreo
