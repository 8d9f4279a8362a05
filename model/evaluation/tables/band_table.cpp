#include "model/evaluation/tables/band_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "model/metrics/speed_spectrum.h"

namespace choreo {
namespace {

// [kBands, joints], mean over windows, floor and height together.
Eigen::MatrixXd MeanPower(const LivelinessDances& dances, double fps) {
  Eigen::MatrixXd sum;
  int windows = 0;
  const auto length = static_cast<std::ptrdiff_t>(std::lround(2 * fps));
  for (const LivelinessFigures& dance : dances) {
    const JointTrack& track = dance.track;
    for (auto from = track.begin(); track.end() - from >= length; from += length, ++windows) {
      const Eigen::MatrixXd power = SpeedSpectrum(JointTrack(from, from + length), fps);
      if (windows == 0) sum.setZero(kBands, power.cols() / 2);
      for (Eigen::Index joint = 0; joint < sum.cols(); ++joint)
        sum.col(joint) += power.col(2 * joint) + power.col(2 * joint + 1);
    }
  }
  return sum / std::max(1, windows);
}

std::string WithoutSide(const std::string& joint) {
  for (const std::string side : {"left_", "right_"})
    if (joint.starts_with(side)) return joint.substr(side.size());
  return joint;
}

}  // namespace

Table BandTable(const Evaluation& evaluation, const Method& method, const LivelinessDances& real,
                const LivelinessDances& danced) {
  const ModelInfo& model = method.sampler->model();
  Table table =
      evaluation.NewTable("liveliness_bands", "How fast in which band", {"joint"}, &method);
  table.note =
      "Speed over real motion's by frequency, through the same keys; the pelvis in the world, all "
      "else as seen from it.";
  const std::vector<std::string>& joints = model.skeleton.joint_names;
  const Eigen::MatrixXd theirs = MeanPower(real, model.fps);
  const Eigen::MatrixXd ours = MeanPower(danced, model.fps);
  std::vector<std::string> names;
  for (const std::string& joint : joints) {
    const std::string name = WithoutSide(joint);
    if (std::ranges::find(names, name) != names.end()) continue;
    names.push_back(name);
    Eigen::VectorXd above = Eigen::VectorXd::Zero(kBands), below = above;
    for (Eigen::Index j = 0; j < ours.cols(); ++j) {
      if (WithoutSide(joints[j]) != name) continue;
      above += ours.col(j);
      below += theirs.col(j);
    }
    table.AddRow({name});
    for (int band = 0; band < kBands; ++band) {
      char heading[64];
      std::snprintf(heading, sizeof(heading), "%g to %g Hz", kBandEdges[band],
                    kBandEdges[band + 1]);
      table.Put(heading, 2, below[band] > 0 ? std::sqrt(above[band] / below[band]) : NAN);
    }
  }
  return table;
}

}  // namespace choreo
