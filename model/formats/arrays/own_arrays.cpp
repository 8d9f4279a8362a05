#include "model/formats/arrays/own_arrays.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "model/core/error.h"
#include "model/core/joined.h"
#include "model/core/rounded.h"
#include "model/core/text/printable.h"

namespace choreo {

void RequireWritable(const Skeleton& skeleton, const Motion& motion,
                     const std::vector<Contacts>* contacts) {
  if (motion.frames.empty())
    throw InvalidArgument("motion.frames", "0 frames, at least 1 is needed");
  if (contacts != nullptr && contacts->size() != motion.frames.size()) {
    throw InvalidArgument("contacts", std::to_string(contacts->size()) +
                                          " frames, the motion has " +
                                          std::to_string(motion.frames.size()));
  }
  for (size_t frame = 0; frame < motion.frames.size(); ++frame) {
    const Pose& pose = motion.frames[frame];
    const auto field = [&] { return "motion.frames[" + std::to_string(frame) + "]"; };
    if (pose.rotations.cols() != skeleton.joints()) {
      throw InvalidArgument(field() + ".rotations", std::to_string(pose.rotations.cols()) +
                                                        " joints, the skeleton has " +
                                                        std::to_string(skeleton.joints()));
    }
    if (!pose.root_position.allFinite() || !pose.rotations.allFinite())
      throw InvalidArgument(field(), "holds values that are not finite");
  }
}

void AddOwnArrays(const Skeleton& skeleton, const Motion& motion,
                  const std::vector<Contacts>* contacts, NpzArchive& npz) {
  RequireWritable(skeleton, motion, contacts);
  const auto frames = static_cast<int64_t>(motion.frames.size());
  std::vector<double> roots, rotations;
  for (const Pose& pose : motion.frames) {
    roots.insert(roots.end(), pose.root_position.begin(), pose.root_position.end());
    rotations.insert(rotations.end(), pose.rotations.data(),
                     pose.rotations.data() + pose.rotations.size());
  }
  npz.SetArray("root_positions", {{frames, 3}, std::move(roots)});
  npz.SetArray("rotations", {{frames, skeleton.joints(), 3}, std::move(rotations)});
  npz.SetArray("fps", {{}, std::vector<double>{motion.fps}});
  if (contacts == nullptr) return;
  std::vector<float> values;
  for (const Contacts& row : *contacts) values.insert(values.end(), row.begin(), row.end());
  npz.SetArray("contacts", {{frames, 4}, std::move(values)});
}

Motion ReadOwnArrays(const Skeleton& skeleton, const NpzArchive& npz) {
  const int joints = skeleton.joints();
  return MotionOfRows(NpzRows(npz, "root_positions", {3}), NpzRows(npz, "rotations", {3 * joints}),
                      joints, CheckRate("fps", NpzNumber(npz, "fps")), "rotations");
}

void RequireFinite(const Eigen::Ref<const Eigen::MatrixXd>& rows, const std::string& key) {
  for (Eigen::Index frame = 0; frame < rows.cols(); ++frame) {
    if (rows.col(frame).allFinite()) continue;
    throw InvalidArgument(key, "holds values that are not finite, first in frame " +
                                   std::to_string(frame) + " of " + std::to_string(rows.cols()) +
                                   ": leave such frames out, or fill them");
  }
}

Eigen::MatrixXd NpzRows(const NpzArchive& npz, const std::string& key,
                        std::initializer_list<int64_t> columns) {
  NpyArray array = npz.Array(key);
  const std::vector<int64_t> stated = array.shape;
  const auto width_of = [&] {
    int64_t width = array.shape.size() >= 2 ? 1 : 0;
    for (size_t i = 1; i < array.shape.size(); ++i) width *= array.shape[i];
    return width;
  };
  const auto has_width = [&] {
    return std::find(columns.begin(), columns.end(), width_of()) != columns.end();
  };
  // A batch of one, or one frame.
  if (!has_width() && array.shape.size() == 3 && array.shape[0] == 1)
    array.shape.erase(array.shape.begin());
  if (array.shape.size() == 1) array.shape.insert(array.shape.begin(), 1);
  const int64_t width = width_of();
  if (!has_width() || array.shape.size() > 3) {
    const auto text = [](int64_t size) { return std::to_string(size); };
    throw InvalidArgument(key, "has the shape [" + Joined(stated, text) + "], expected [frames, " +
                                   Joined(columns, text, " or ") + "]");
  }
  const std::vector<double> values = array.As<double>();
  Eigen::MatrixXd rows = Eigen::Map<const Eigen::MatrixXd>(values.data(), width, array.shape[0]);
  RequireFinite(rows, key);
  return rows;
}

double NpzNumber(const NpzArchive& npz, const std::string& key) {
  if (npz.IsText(key)) {
    const std::string text = npz.Text(key);
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size())
      throw InvalidArgument(key, '"' + Printable(text) + "\" is not a number");
    return number;
  }
  const NpyArray array = npz.Array(key);
  if (array.size() != 1) throw InvalidArgument(key, "is not one number");
  return array.As<double>()[0];
}

double CheckRate(const std::string& key, double fps) {
  if (fps >= kMinFileFps && fps <= kMaxFileFps) return fps;
  throw InvalidArgument(key, std::to_string(fps) + ", must be " + Rounded(kMinFileFps) + " to " +
                                 Rounded(kMaxFileFps) + " frames a second");
}

Motion MotionOfRows(const Eigen::MatrixXd& positions, const Eigen::MatrixXd& rotations, int joints,
                    double fps, const std::string& key) {
  if (positions.cols() != rotations.cols()) {
    throw InvalidArgument(key, std::to_string(rotations.cols()) + " frames, but there are " +
                                   std::to_string(positions.cols()) + " root positions");
  }
  const Eigen::Index known = rotations.rows() / 3;
  Motion motion{.fps = fps, .frames = {}};
  for (Eigen::Index frame = 0; frame < positions.cols(); ++frame) {
    Pose pose{positions.col(frame), Eigen::Matrix3Xd::Zero(3, joints)};
    pose.rotations.leftCols(known) =
        Eigen::Map<const Eigen::Matrix3Xd>(rotations.col(frame).data(), 3, known);
    motion.frames.push_back(std::move(pose));
  }
  return motion;
}

}  // namespace choreo
