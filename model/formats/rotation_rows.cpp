#include "model/formats/rotation_rows.h"

#include <algorithm>
#include <vector>

#include "model/core/error.h"
#include "model/motion/rotation.h"
#include "model/motion/skeleton.h"

namespace choreo {
namespace {

constexpr double kNoRotation = 0.05;  // of a matrix's product with its transpose from 1

/// An array seen as frames of values.
struct Rows {
  std::vector<int64_t> shape;  ///< as stated
  int64_t frames = 0, width = 0;
  int64_t last = 0, last_but_one = 0;  ///< extents, 0 where there is none
  Eigen::MatrixXd values;              ///< [width, frames]
};

Rows ReadRows(const NpzArchive& npz, const std::string& key, const auto& is_width) {
  const NpyArray array = npz.Array(key);
  Rows rows;
  rows.shape = array.shape;
  std::vector<int64_t> shape = array.shape;
  const auto width_from = [&](size_t first) {
    int64_t width = 1;
    for (size_t i = first; i < shape.size(); ++i) width *= shape[i];
    return width;
  };
  // One frame, or a batch of one.
  const bool has_frames = shape.size() > 1 && is_width(width_from(1));
  if (!has_frames && is_width(width_from(0))) {
    shape.insert(shape.begin(), 1);
  } else if (!has_frames && shape.size() > 2 && shape[0] == 1) {
    shape.erase(shape.begin());
  }
  if (shape.size() < 2) return rows;
  rows.width = width_from(1);
  rows.frames = shape[0];
  rows.last = shape.back();
  rows.last_but_one = shape.size() > 2 ? shape[shape.size() - 2] : 0;
  const std::vector<double> values = array.As<double>();
  rows.values = Eigen::Map<const Eigen::MatrixXd>(values.data(), rows.width, rows.frames);
  if (!rows.values.allFinite()) throw InvalidArgument(key, "holds values that are not finite");
  return rows;
}

[[noreturn]] void RefuseShape(const std::string& key, const Rows& rows,
                              const std::vector<int64_t>& joints) {
  std::string shape, wanted;
  for (const int64_t size : rows.shape) shape += (shape.empty() ? "" : ", ") + std::to_string(size);
  for (const int64_t count : joints)
    wanted += (wanted.empty() ? "" : " or ") + std::to_string(3 * count);
  throw InvalidArgument(key, "has the shape [" + shape + "], expected [frames, " + wanted +
                                 "], or matrices or 6D of as many joints");
}

Eigen::MatrixXd FromMatrices(const Rows& rows, const std::string& key) {
  Eigen::MatrixXd turns(rows.width / 3, rows.frames);
  for (Eigen::Index frame = 0; frame < rows.values.cols(); ++frame) {
    for (Eigen::Index joint = 0; joint < rows.width / 9; ++joint) {
      const Eigen::Matrix3d matrix = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(
          rows.values.col(frame).data() + 9 * joint);
      const Eigen::Matrix3d square = matrix * matrix.transpose();
      if (!square.isApprox(Eigen::Matrix3d::Identity(), kNoRotation) || matrix.determinant() < 0) {
        throw InvalidArgument(
            key + "[" + std::to_string(frame) + "][" + std::to_string(joint) + "]",
            "is no rotation matrix");
      }
      turns.col(frame).segment<3>(3 * joint) = LogMap(NearestRotation(matrix));
    }
  }
  return turns;
}

// A matrix by its first two rows; by columns it would be the inverse.
Eigen::MatrixXd FromSixD(const Rows& rows, const std::string& key) {
  Eigen::MatrixXd turns(rows.width / 2, rows.frames);
  for (Eigen::Index frame = 0; frame < rows.values.cols(); ++frame) {
    for (Eigen::Index joint = 0; joint < rows.width / 6; ++joint) {
      try {
        const Eigen::Matrix<double, 6, 1> six = rows.values.col(frame).segment<6>(6 * joint);
        turns.col(frame).segment<3>(3 * joint) = LogMap(MatrixFromSixD(six).transpose());
      } catch (const Error&) {
        throw InvalidArgument(
            key + "[" + std::to_string(frame) + "][" + std::to_string(joint) + "]",
            "is no rotation in 6D");
      }
    }
  }
  // By how much hinges bend, backwards below 0. `first` is that of the body's joints which the
  // array begins with.
  const Skeleton& smpl = Skeleton::Smpl24();
  const Eigen::Index first = rows.width / 6 == 21 || rows.width / 6 == 23 ? 1 : 0;
  double bend = 0;
  for (const Hinge& hinge : Hinges(smpl)) {
    const Eigen::Index row = 3 * (hinge.joint - first);
    if (row < 0 || row + 3 > turns.rows()) continue;
    for (Eigen::Index frame = 0; frame < turns.cols(); ++frame)
      bend += hinge.axis.dot(turns.col(frame).segment<3>(row));
  }
  return bend < 0 ? Eigen::MatrixXd(-turns) : turns;
}

}  // namespace

Eigen::MatrixXd ReadRotationRows(const NpzArchive& npz, const std::string& key,
                                 std::initializer_list<int64_t> joints) {
  const auto is_width_of = [&](int64_t width, int64_t values) {
    return width % values == 0 && std::ranges::find(joints, width / values) != joints.end();
  };
  const Rows rows = ReadRows(npz, key, [&](int64_t width) {
    return is_width_of(width, 3) || is_width_of(width, 6) || is_width_of(width, 9);
  });
  const bool says_matrices = rows.last == 9 || (rows.last == 3 && rows.last_but_one == 3);
  if (is_width_of(rows.width, 9) && (says_matrices || !is_width_of(rows.width, 3)))
    return FromMatrices(rows, key);
  if (is_width_of(rows.width, 6) && (rows.last == 6 || !is_width_of(rows.width, 3)))
    return FromSixD(rows, key);
  if (!is_width_of(rows.width, 3)) RefuseShape(key, rows, joints);
  return rows.values;
}

}  // namespace choreo
