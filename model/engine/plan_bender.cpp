#include "model/engine/plan_bender.h"

#include <algorithm>
#include <cmath>

#include "model/motion/mirror.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

// As model/flow/planner.cpp has them; the parity test holds both together.
constexpr double kRampFrames = 6;
constexpr float kLeastAlong = 0.25F, kAlongSoftness = 0.1F;
constexpr float kFreeTurn = 0.625F;
constexpr double kResidualSigma = 2;
constexpr double kEaseFrames = 30;
constexpr int kResidualReach = 12;  // frames, where a Gaussian is 1e-8 of its peak

using Row = Eigen::Map<Eigen::RowVectorXf>;

// A mirror's image of a rotation's first two columns: M R M with M = diag(-1, 1, 1).
const Eigen::Matrix<float, 1, 6>& MirrorSigns() {
  static const Eigen::Matrix<float, 1, 6> signs{1, -1, -1, -1, 1, 1};
  return signs;
}

Eigen::Vector3f Unit(const Eigen::Vector3f& v) { return v / std::sqrt(v.squaredNorm() + 1e-12F); }

// The nearest rotation's first two columns, in place.
template <typename SixD>
void Straighten(SixD&& columns) {
  const Eigen::Vector3f b = columns.template tail<3>();
  const Eigen::Vector3f x = Unit(columns.template head<3>());
  columns.template head<3>() = x;
  columns.template tail<3>() = Unit(b - x.dot(b) * x);
}

// A plan's steady walk, that of its second half, is taken out of its first `frames` positions.
void TakeOutWalk(int frames, RowBuffer* positions) {
  const int middle = frames / 2;
  if (frames - 1 == middle) return;
  Eigen::RowVector3f walk = (positions->Part<3>(frames - 1, 0) - positions->Part<3>(middle, 0)) /
                            static_cast<float>(frames - 1 - middle);
  walk.y() = 0;
  for (int frame = 0; frame < frames; ++frame) {
    const double since = frame + 1.0;
    const double eased =
        since < kEaseFrames ? since * since / (2 * kEaseFrames) : since - kEaseFrames / 2;
    positions->Part<3>(frame, 0) -= static_cast<float>(eased) * walk;
  }
}

}  // namespace

PlanBender::PlanBender(const Skeleton& skeleton, int history, double root_turn,
                       const PackedKernels& kernels)
    : joints_(skeleton.joints()),
      history_(history),
      root_turn_(static_cast<float>(root_turn)),
      pairs_(MirrorPairs(skeleton)),
      kernels_(kernels) {}

void PlanBender::Interpolate(const TransitionSpec& spec, const Eigen::Vector3d& root_turn,
                             PackedTransformer::Scratch* network) const {
  const auto history = static_cast<int>(spec.history.size());
  RowBuffer& poses = network->poses;
  const Row mask = network->masks.Part(0, 0, joints_ + 1);
  poses.Resize(static_cast<long>(PackedTransformer::kSides) * (history + spec.frames),
               3 + 6 * joints_);
  const Pose& last = spec.history.back();
  const Pose& goal = spec.target ? spec.target->pose : last;
  for (int t = 0; t < history; ++t) {
    const Pose& pose = spec.history[static_cast<size_t>(t)];
    poses.Part<3>(t, 0) = pose.root_position.cast<float>();
    for (int joint = 0; joint < joints_; ++joint) {
      poses.Part<6>(t, 3 + 6 * joint) =
          SixDFromMatrix(ExpMap(pose.rotations.col(joint))).cast<float>();
    }
  }
  const Eigen::Vector3d move =
      static_cast<double>(mask[joints_]) * (goal.root_position - last.root_position);
  for (int t = 0; t < spec.frames; ++t) {
    const double u = (t + 1.0) / spec.frames;
    poses.Part<3>(history + t, 0) = (last.root_position + u * move).cast<float>();
  }
  for (int joint = 0; joint < joints_; ++joint) {
    Eigen::Vector3d turn =
        joint == 0 ? root_turn
                   : RotationDifference(last.rotations.col(joint), goal.rotations.col(joint));
    turn *= mask[joint];
    // from exp(u turn) = from + sin(u angle) from K + (1 - cos(u angle)) from K^2, K the axis.
    const double angle = turn.norm();
    const Eigen::Vector3d axis = turn / std::max(angle, 1e-12);
    const Eigen::Matrix3d from = ExpMap(last.rotations.col(joint));
    Eigen::Matrix<double, 3, 2> first, second;  // from K, from K^2
    for (int i = 0; i < 2; ++i) {
      const Eigen::Vector3d once = axis.cross(Eigen::Vector3d::Unit(i));
      first.col(i) = from * once;
      second.col(i) = from * axis.cross(once);
    }
    const double step_sine = std::sin(angle / spec.frames),
                 step_cosine = std::cos(angle / spec.frames);
    double sine = 0, cosine = 1;
    for (int t = 0; t < spec.frames; ++t) {
      const double next = sine * step_cosine + cosine * step_sine;
      cosine = cosine * step_cosine - sine * step_sine;
      sine = next;
      auto columns = poses.Part<6>(history + t, 3 + 6 * joint);
      for (int i = 0; i < 2; ++i) {
        columns.segment<3>(3 * i) =
            (from.col(i) + sine * first.col(i) + (1 - cosine) * second.col(i)).cast<float>();
      }
    }
  }
  Mirror(history + spec.frames, network);
}

// Writes the second side from the first.
void PlanBender::Mirror(int rows, PackedTransformer::Scratch* network) const {
  RowBuffer& masks = network->masks;
  for (int joint = 0; joint < joints_; ++joint)
    masks.Row(1)[joint] = masks.Row(0)[pairs_[static_cast<size_t>(joint)]];
  masks.Row(1)[joints_] = masks.Row(0)[joints_];
  RowBuffer& poses = network->poses;
  for (int row = 0; row < rows; ++row) {
    auto position = poses.Part<3>(rows + row, 0);
    position = poses.Part<3>(row, 0);
    position[0] = -position[0];
    for (int joint = 0; joint < joints_; ++joint) {
      const int other = pairs_[static_cast<size_t>(joint)];
      poses.Part<6>(rows + row, 3 + 6 * joint) =
          poses.Part<6>(row, 3 + 6 * other).cwiseProduct(MirrorSigns());
    }
  }
}

// Bends each side's line by what the network adds, and joins the two in the first side's rotations
// and positions.
void PlanBender::Bend(int frames, const PackedTransformer::Scratch& network,
                      const Eigen::VectorXf& pose_std, Scratch* s) const {
  constexpr int kSides = PackedTransformer::kSides;
  const int pose = 3 + 6 * joints_, history = history_;
  s->smooth.Resize(frames, pose);
  s->rotations.Resize(static_cast<long>(kSides) * frames, 6 * joints_);
  s->along.Resize(static_cast<long>(kSides) * frames, 2 * joints_);
  s->positions.Resize(static_cast<long>(kSides) * frames, 3);
  float weights[kResidualReach + 1];
  for (int i = 0; i <= kResidualReach; ++i)
    weights[i] = static_cast<float>(std::exp(-0.5 * std::pow(i / kResidualSigma, 2)));

  const auto line = [&](int side, int frame, int first) {
    return network.poses.Part<3>(side * (history + frames) + history + frame, first);
  };
  for (int side = 0; side < kSides; ++side) {
    const auto mask = network.masks.Part(side, 0, joints_ + 1);
    for (int frame = 0; frame < frames; ++frame) {
      const int row = side * frames + frame;
      auto residual = s->smooth.Part(frame, 0, pose);
      residual.setZero();
      float sum = 0;
      const int from = std::max(0, frame - kResidualReach);
      const int to = std::min(frames - 1, frame + kResidualReach);
      for (int other = from; other <= to; ++other) {
        const float weight = weights[std::abs(other - frame)];
        residual += weight * network.residual.Part(side * frames + other, 0, pose);
        sum += weight;
      }
      residual = residual.cwiseProduct(pose_std.transpose()) / sum;

      // It grows from zero behind the history and, for what the key fixes, shrinks to zero at it.
      const auto from_start = static_cast<float>(std::min((frame + 1) / kRampFrames, 1.0));
      const auto to_key = static_cast<float>(std::min((frames - 1 - frame) / kRampFrames, 1.0));
      const auto ramp = [&](int what) {
        return from_start * (1 - mask[what] + mask[what] * to_key);
      };
      s->positions.Part<3>(row, 0) = line(side, frame, 0) + ramp(joints_) * residual.head<3>();
      float* along = s->along.Row(row);
      const float free = kFreeTurn * root_turn_, soft = root_turn_ - free;
      for (int joint = 0; joint < joints_; ++joint) {
        const float share = ramp(joint);
        for (int i = 0; i < 2; ++i, ++along) {
          const int at = 6 * joint + 3 * i;
          const Eigen::Vector3f column = line(side, frame, 3 + at);
          Eigen::Vector3f turn = share * residual.segment<3>(3 + at);
          if (joint == 0) {
            const float size = std::sqrt(turn.squaredNorm() + 1e-12F);
            if (size >= free) {
              const float bounded = free + soft * std::tanh((size - free) / soft);
              turn *= bounded / size;
            }
          }
          turn += column;
          s->rotations.Part<3>(row, at) = turn;
          *along = (column.dot(turn) - kLeastAlong) / kAlongSoftness;
        }
      }
    }
  }
  // A column's share along the line's own stays positive, softly: docs/decisions.md, 20.
  s->bounded.Resize(1, static_cast<long>(kSides) * frames * 2 * joints_);
  const long count = s->bounded.stride();
  std::copy_n(s->along.Row(0), count, s->bounded.Row(0));
  kernels_.softplus(s->bounded.Row(0), count);
  const float *bounded = s->bounded.Row(0), *along = s->along.Row(0);
  for (int side = 0; side < kSides; ++side) {
    for (int frame = 0; frame < frames; ++frame) {
      for (int joint = 0; joint < joints_; ++joint) {
        auto columns = s->rotations.Part<6>(side * frames + frame, 6 * joint);
        for (int i = 0; i < 2; ++i, ++bounded, ++along) {
          columns.segment<3>(3 * i) +=
              kAlongSoftness * (*bounded - *along) * line(side, frame, 3 + 6 * joint + 3 * i);
        }
        Straighten(columns);
      }
    }
  }
  for (int frame = 0; frame < frames; ++frame) {
    const auto other = s->positions.Part<3>(frames + frame, 0);
    auto position = s->positions.Part<3>(frame, 0);
    position = 0.5F * (position + Eigen::RowVector3f(-other[0], other[1], other[2]));
    for (int joint = 0; joint < joints_; ++joint) {
      auto columns = s->rotations.Part<6>(frame, 6 * joint);
      const int pair = pairs_[static_cast<size_t>(joint)];
      columns += s->rotations.Part<6>(frames + frame, 6 * pair).cwiseProduct(MirrorSigns());
      Straighten(columns);
    }
  }
  if (network.masks.Row(0)[joints_] == 0) TakeOutWalk(frames, &s->positions);
}

}  // namespace choreo
