#include "model/formats/arrays/rotation_rows.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "model/core/error.h"
#include "model/core/joined.h"
#include "model/core/numbers/quantile.h"
#include "model/formats/arrays/own_arrays.h"
#include "model/motion/rotation.h"
#include "model/motion/skeleton.h"

namespace choreo {
namespace {

constexpr double kNoRotation = 0.05;  // deviation of a matrix times its transpose from identity
constexpr double kNoSixD = 0.5;       // mean Skew; networks deviate far less

/// An array as frames of values.
struct Rows {
  std::vector<int64_t> shape;  ///< as in the file
  int64_t frames = 0, width = 0;
  int64_t last = 0, last_but_one = 0;  ///< last two extents, 0 if missing
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
  RequireFinite(rows.values, key);
  return rows;
}

[[noreturn]] void RefuseShape(const std::string& key, const Rows& rows,
                              const std::vector<int64_t>& joints) {
  const std::string shape = Joined(rows.shape, [](int64_t size) { return std::to_string(size); });
  const std::string widths = Joined(
      joints, [](int64_t count) { return std::to_string(3 * count); }, " or ");
  throw InvalidArgument(key, "has the shape [" + shape + "], expected [frames, " + widths +
                                 "], or matrices, 6D or quaternions of as many joints");
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
            "is not a rotation matrix");
      }
      turns.col(frame).segment<3>(3 * joint) = LogMap(NearestRotation(matrix));
    }
  }
  return turns;
}

using SixD = Eigen::Matrix<double, 6, 1>;

// The deviation of six numbers from two orthonormal vectors. `step`: the distance between a
// vector's numbers.
double Skew(const SixD& six, Eigen::Index step) {
  const Eigen::Index next = step == 1 ? 3 : 1;
  const Eigen::Vector3d a = six(Eigen::seqN(0, 3, step)), b = six(Eigen::seqN(next, 3, step));
  return std::abs(a.dot(b)) + std::abs(a.squaredNorm() - 1) + std::abs(b.squaredNorm() - 1);
}

// Converts 6D. Consecutive vectors may be rows or columns; interleaved ones, as in [.., 3, 2], are
// columns.
Eigen::MatrixXd FromSixD(const Rows& rows, const std::string& key) {
  Eigen::MatrixXd turns(rows.width / 2, rows.frames);
  double in_turn = 0, mixed = 0;
  for (Eigen::Index at = 0; at + 6 <= rows.values.size(); at += 6) {
    const SixD six = Eigen::Map<const SixD>(rows.values.data() + at);
    in_turn += Skew(six, 1);
    mixed += Skew(six, 2);
  }
  const bool is_mixed = mixed < in_turn;
  if (6 * std::min(mixed, in_turn) > kNoSixD * static_cast<double>(rows.values.size())) {
    throw InvalidArgument(key,
                          "are not rotations in 6D, whose vectors are of length 1 and at right "
                          "angles: were they normalised? Undo that");
  }
  for (Eigen::Index frame = 0; frame < rows.values.cols(); ++frame) {
    for (Eigen::Index joint = 0; joint < rows.width / 6; ++joint) {
      try {
        SixD six = rows.values.col(frame).segment<6>(6 * joint);
        if (is_mixed) six = SixD{six[0], six[2], six[4], six[1], six[3], six[5]};
        const Eigen::Matrix3d matrix = MatrixFromSixD(six);
        turns.col(frame).segment<3>(3 * joint) =
            LogMap(is_mixed ? matrix : Eigen::Matrix3d(matrix.transpose()));
      } catch (const Error&) {
        throw InvalidArgument(
            key + "[" + std::to_string(frame) + "][" + std::to_string(joint) + "]",
            "is not a rotation in 6D");
      }
    }
  }
  if (is_mixed) return turns;
  // The sum of the hinges' bends, negative for backwards. `first`: the array's first joint of the
  // body.
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

// Converts quaternions. The real part is first or last, whichever is larger, because joints turn by
// less than half a turn.
Eigen::MatrixXd FromQuaternions(const Rows& rows, const std::string& key) {
  double first = 0, last = 0;
  for (Eigen::Index at = 0; at + 4 <= rows.values.size(); at += 4) {
    first += std::abs(rows.values.data()[at]);
    last += std::abs(rows.values.data()[at + 3]);
  }
  Eigen::MatrixXd turns(rows.width / 4 * 3, rows.frames);
  for (Eigen::Index frame = 0; frame < rows.values.cols(); ++frame) {
    for (Eigen::Index joint = 0; joint < rows.width / 4; ++joint) {
      const Eigen::Vector4d q = rows.values.col(frame).segment<4>(4 * joint);
      if (!(std::abs(q.norm() - 1) < kNoRotation)) {
        throw InvalidArgument(
            key + "[" + std::to_string(frame) + "][" + std::to_string(joint) + "]",
            "is not a quaternion of length 1");
      }
      const Eigen::Quaterniond turn = first > last ? Eigen::Quaterniond(q[0], q[1], q[2], q[3])
                                                   : Eigen::Quaterniond(q[3], q[0], q[1], q[2]);
      turns.col(frame).segment<3>(3 * joint) = LogMap(turn.normalized().toRotationMatrix());
    }
  }
  return turns;
}

bool IsWidthOf(int64_t width, int64_t values, const std::vector<int64_t>& joints) {
  return width % values == 0 && std::ranges::find(joints, width / values) != joints.end();
}

}  // namespace

bool AreRotations(int64_t width, const std::vector<int64_t>& joints) {
  return std::ranges::any_of(std::initializer_list<int64_t>{3, 4, 6, 9}, [&](int64_t values) {
    // The root alone does not show where a quaternion's real part is.
    return width != 4 && IsWidthOf(width, values, joints);
  });
}

RotationRows ReadRotationRows(const NpzArchive& npz, const std::string& key,
                              const std::vector<int64_t>& joints) {
  const auto is_width_of = [&](int64_t width, int64_t values) {
    return IsWidthOf(width, values, joints);
  };
  const auto is_quaternions = [&](int64_t width) { return width > 4 && is_width_of(width, 4); };
  const Rows rows = ReadRows(npz, key, [&](int64_t width) { return AreRotations(width, joints); });
  const bool says_matrices = rows.last == 9 || (rows.last == 3 && rows.last_but_one == 3);
  if (is_width_of(rows.width, 9) && (says_matrices || !is_width_of(rows.width, 3)))
    return {FromMatrices(rows, key)};
  if (is_width_of(rows.width, 6) && (rows.last == 6 || !is_width_of(rows.width, 3)))
    return {FromSixD(rows, key)};
  if (is_quaternions(rows.width) && (rows.last == 4 || !is_width_of(rows.width, 3)))
    return {FromQuaternions(rows, key)};
  if (!is_width_of(rows.width, 3)) RefuseShape(key, rows, joints);
  return {rows.values, true};
}

void ToRadians(const std::string& key, const MotionReading& reading, RotationRows* rows) {
  constexpr double kTwiceRound = 4 * M_PI;
  if (!rows->are_vectors) {
    if (reading.angles.empty()) return;
    throw InvalidArgument("--angles", "is for rotation vectors, which its " + key + " are not");
  }
  std::vector<double> first, most;  // of each frame
  for (const auto& frame : rows->turns.colwise()) {
    const Eigen::VectorXd angles =
        Eigen::Map<const Eigen::Matrix3Xd>(frame.data(), 3, frame.size() / 3).colwise().norm();
    first.push_back(angles[0]);
    most.push_back(angles.tail(angles.size() - 1).maxCoeff());
  }
  const double middle = most.empty() ? 0 : Median(std::move(most));
  const bool found = middle > kTwiceRound && middle < kTwiceRound * kDegrees;
  if (reading.angles.empty() ? found : reading.angles == "degrees") rows->turns /= kDegrees;
  if (!reading.angles.empty()) return;
  if (found) {
    reading.Note("its " + key +
                 " are read as degrees, not radians; --angles radians overrides that");
  } else if (!first.empty() && Median(std::move(first)) > kTwiceRound) {
    reading.Note("its root alone turns by more than two whole turns: its " + key +
                 " are read as radians, --angles degrees overrides that");
  }
}

}  // namespace choreo
