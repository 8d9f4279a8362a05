#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <string>
#include <vector>

#include "model/formats/npz.h"
#include "model/motion/contacts.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Motion in npz files, array by array, and what every writer asks of a motion. Private to this
/// folder.
namespace choreo {

/// Throws Error(kInvalidArgument) for no frames, a frame of another joint count than the skeleton's
/// or with values that are not finite, and contacts of another length.
void RequireWritable(const Skeleton& skeleton, const Motion& motion,
                     const std::vector<Contacts>* contacts = nullptr);

/// Adds root_positions [F, 3], rotations [F, joints, 3], fps, and contacts [F, 4] if they are
/// given. Throws as RequireWritable.
void AddOwnArrays(const Skeleton& skeleton, const Motion& motion,
                  const std::vector<Contacts>* contacts, NpzArchive& npz);
/// The inverse, without contacts. Throws Error(kInvalidArgument) naming the array.
Motion ReadOwnArrays(const Skeleton& skeleton, const NpzArchive& npz);

/// An array as [columns, F], finite; the shape [F, a, b] is accepted where a x b is one of
/// `columns`.
Eigen::MatrixXd NpzRows(const NpzArchive& npz, const std::string& key,
                        std::initializer_list<int64_t> columns);
double NpzNumber(const NpzArchive& npz, const std::string& key);
/// Throws Error(kInvalidArgument, key) unless a rate lies within 1 to 1000 frames a second.
double CheckRate(const std::string& key, double fps);
/// Poses of `joints` joints, of whose rotations the first `known` are those of each column; the
/// others are zero.
Motion MotionOfRows(const Eigen::MatrixXd& positions, const Eigen::MatrixXd& rotations, int known,
                    int joints, double fps, const std::string& key);

}  // namespace choreo
