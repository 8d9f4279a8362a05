#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <string>
#include <vector>

#include "model/formats/containers/npz.h"
#include "model/motion/floor/contacts.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"
#include "model/motion/skeleton_motion.h"

/// Reads and writes motions of any skeleton in npz files, and checks the input of all writers.
/// Motions of SMPL's skeleton are written by amass_npz.h, so that SMPL's tools can read them.
namespace choreo {

/// Throws Error(kInvalidArgument) for no frames, a frame of another joint count than the skeleton's
/// or with values that are not finite, and contacts of another length.
void RequireWritable(const Skeleton& skeleton, const Motion& motion,
                     const std::vector<Contacts>* contacts = nullptr);

/// Adds root_positions [F, 3] of joint 0, metres, Y up; rotations [F, joints, 3], axis-angle,
/// local; fps; and contacts [F, 4], if given. Throws what RequireWritable throws.
void AddOwnArrays(const Skeleton& skeleton, const Motion& motion,
                  const std::vector<Contacts>* contacts, NpzArchive& npz);
/// The inverse, without contacts. Throws Error(kInvalidArgument), naming the array.
Motion ReadOwnArrays(const Skeleton& skeleton, const NpzArchive& npz);

/// Throws Error(kInvalidArgument, key), which names the frame, if values [columns, F] are not
/// finite.
void RequireFinite(const Eigen::Ref<const Eigen::MatrixXd>& rows, const std::string& key);

/// Returns a finite array as [columns, F]. Also accepts the shapes [F, a, b] if a * b is one of
/// `columns`, [1, F, a], and [a] for a single frame.
Eigen::MatrixXd NpzRows(const NpzArchive& npz, const std::string& key,
                        std::initializer_list<int64_t> columns);
/// Returns a number, which may be stored as text.
double NpzNumber(const NpzArchive& npz, const std::string& key);
inline constexpr double kMinFileFps = 1, kMaxFileFps = 1000;
/// Returns the rate, frames per second. Throws Error(kInvalidArgument, key) unless it is within
/// these limits.
double CheckRate(const std::string& key, double fps);
/// Makes a motion of `joints` joints from columns of positions and rotation vectors. Missing joints
/// do not rotate.
Motion MotionOfRows(const Eigen::MatrixXd& positions, const Eigen::MatrixXd& rotations, int joints,
                    double fps, const std::string& key);

}  // namespace choreo
