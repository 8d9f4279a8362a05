#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <string>
#include <vector>

#include "model/formats/npz.h"
#include "model/motion/contacts.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"
#include "model/motion/skeleton_motion.h"

/// Motion of any skeleton in npz files, array by array, and what every writer asks of a motion.
/// What has SMPL's skeleton is written as amass_npz.h says, so that SMPL's tools can read it.
namespace choreo {

/// Throws Error(kInvalidArgument) for no frames, a frame of another joint count than the skeleton's
/// or with values that are not finite, and contacts of another length.
void RequireWritable(const Skeleton& skeleton, const Motion& motion,
                     const std::vector<Contacts>* contacts = nullptr);

/// Adds root_positions [F, 3] of joint 0, metres, Y up; rotations [F, joints, 3], axis-angle,
/// local; fps; and contacts [F, 4] if they are given. Throws as RequireWritable.
void AddOwnArrays(const Skeleton& skeleton, const Motion& motion,
                  const std::vector<Contacts>* contacts, NpzArchive& npz);
/// The inverse, without contacts. Throws Error(kInvalidArgument) naming the array.
Motion ReadOwnArrays(const Skeleton& skeleton, const NpzArchive& npz);

/// An array as [columns, F], finite; the shape [F, a, b] is accepted where a x b is one of
/// `columns`, and [1, F, a] or, of a single frame, [a].
Eigen::MatrixXd NpzRows(const NpzArchive& npz, const std::string& key,
                        std::initializer_list<int64_t> columns);
/// A number, or a text that is one.
double NpzNumber(const NpzArchive& npz, const std::string& key);
inline constexpr double kMinFileFps = 1, kMaxFileFps = 1000;
/// Throws Error(kInvalidArgument, key) unless a rate lies within these, frames a second.
double CheckRate(const std::string& key, double fps);
/// Poses of `joints` joints, whose rotations are those of each column and zero beyond.
Motion MotionOfRows(const Eigen::MatrixXd& positions, const Eigen::MatrixXd& rotations, int joints,
                    double fps, const std::string& key);

}  // namespace choreo
