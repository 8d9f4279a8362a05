#include "model/metrics/critic_families.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <span>

#include "model/core/numbers/quantile.h"
#include "model/metrics/balance.h"
#include "model/metrics/speed_spectrum.h"

namespace choreo {
namespace {

constexpr double kWindowSeconds = 2;
constexpr double kFinest = 0.01;  // m, or m/s: smaller differences are invisible

using Values = std::vector<double>;

// A window of a dance: frames, and their balance.
struct Window {
  std::span<const Eigen::Matrix3Xd> track;
  std::span<const Balance> balance;
  double fps, floor;

  size_t frames() const { return track.size(); }
};

// The ends of limbs that critics use.
struct Limbs {
  std::array<int, 4> feet;
  std::array<int, 2> wrists;
  int head;

  explicit Limbs(const Skeleton& skeleton) : feet(skeleton.feet), head(skeleton.Find("head")) {
    const auto child = [&](int joint) {
      return static_cast<int>(std::ranges::find(skeleton.parents, joint) -
                              skeleton.parents.begin());
    };
    wrists = {child(skeleton.left_elbow), child(skeleton.right_elbow)};
  }
};

Values PerFrame(const Window& window, auto value) {
  Values values;
  for (size_t t = 0; t < window.frames(); ++t) values.push_back(value(t));
  return values;
}
// Speed of a joint in each step, m/s.
Values Speeds(const Window& window, int joint) {
  Values speeds;
  for (size_t t = 1; t < window.frames(); ++t)
    speeds.push_back((window.track[t].col(joint) - window.track[t - 1].col(joint)).norm() *
                     window.fps);
  return speeds;
}
double MeanOf(const Values& values) {
  return Eigen::Map<const Eigen::ArrayXd>(values.data(), std::ssize(values)).mean();
}
void AddQuantiles(const Values& values, std::initializer_list<double> shares, Values* features) {
  for (const double share : shares)
    features->push_back(values.empty() ? 0 : Quantile(values, share));
}
void AddLogQuantiles(const Values& values, std::initializer_list<double> shares, Values* features) {
  for (const double share : shares)
    features->push_back(std::log(std::max(Quantile(values, share), 0.0) + kFinest));
}

Values FloorFeatures(const Window& window) {
  Values features;
  const auto height = [&](size_t t, size_t side) {  // of a foot's lower end
    const Eigen::Matrix<double, 3, 4>& feet = window.balance[t].feet;
    return std::min(feet(1, 2 * side), feet(1, 2 * side + 1)) - window.floor;
  };
  const auto add = [&](auto value) {
    AddLogQuantiles(PerFrame(window, value), {0.1, 0.5, 0.9}, &features);
  };
  add([&](size_t t) { return std::min(height(t, 0), height(t, 1)); });
  add([&](size_t t) { return std::max(height(t, 0), height(t, 1)); });
  add([&](size_t t) { return window.track[t].row(1).minCoeff() - window.floor; });
  features.push_back(MeanOf(PerFrame(
      window, [&](size_t t) { return window.balance[t].foot_height > kSoleHeight ? 1.0 : 0.0; })));
  return features;
}

Values BalanceFeatures(const Window& window) {
  Values centres, points, features;
  for (const Balance& frame : window.balance) {
    if (frame.centre_outside) centres.push_back(std::log(*frame.centre_outside + kFinest));
    if (frame.zmp_outside) points.push_back(std::log(*frame.zmp_outside + kFinest));
  }
  AddQuantiles(centres, {0.5, 0.9}, &features);
  AddQuantiles(points, {0.5, 0.9}, &features);
  const auto rise = [&](size_t t) { return window.balance[t].acceleration.y(); };
  const auto push = [&](size_t t) {
    const Eigen::Vector3d& acceleration = window.balance[t].acceleration;
    return std::hypot(acceleration.x(), acceleration.z());
  };
  AddQuantiles(PerFrame(window, rise), {0.1, 0.5, 0.9}, &features);
  AddLogQuantiles(PerFrame(window, push), {0.5, 0.9}, &features);
  return features;
}

Values ContactFeatures(const Window& window, const Limbs& limbs) {
  const auto down = [&](size_t t, size_t side) {
    return window.balance[t].on_floor[2 * side] || window.balance[t].on_floor[2 * side + 1];
  };
  double both = 0, none = 0, toes = 0, heels = 0, landings = 0;
  Values slides;
  for (size_t t = 0; t < window.frames(); ++t) {
    both += down(t, 0) && down(t, 1);
    none += !down(t, 0) && !down(t, 1);
    for (const size_t side : {0, 1}) {
      const auto& on_floor = window.balance[t].on_floor;
      toes += !on_floor[2 * side] && on_floor[2 * side + 1];
      heels += on_floor[2 * side] && !on_floor[2 * side + 1];
      if (t == 0) continue;
      landings += down(t, side) && !down(t - 1, side);
      for (const size_t joint : {2 * side, 2 * side + 1}) {
        if (!on_floor[joint] || !window.balance[t - 1].on_floor[joint]) continue;
        const Eigen::Vector3d step =
            window.track[t].col(limbs.feet[joint]) - window.track[t - 1].col(limbs.feet[joint]);
        slides.push_back(std::log(std::hypot(step.x(), step.z()) * window.fps + kFinest));
      }
    }
  }
  const auto frames = static_cast<double>(window.frames());
  Values features = {both / frames, none / frames, toes / frames, heels / frames, landings};
  AddQuantiles(slides, {0.1, 0.5, 0.9}, &features);
  return features;
}

// Combines left and right, because a dance and its mirror image are equivalent.
Values SpectrumFeatures(const Window& window, const Limbs& limbs) {
  const Eigen::MatrixXd power =
      SpeedSpectrum({window.track.begin(), window.track.end()}, window.fps);
  Values features;
  for (const size_t end : {0, 1}) {  // ankle, toes
    for (const int along : {0, 1}) {
      for (int band = 0; band < kBands; ++band) {
        features.push_back(std::log(power(band, 2 * limbs.feet[end] + along) +
                                    power(band, 2 * limbs.feet[end + 2] + along) +
                                    kFinest * kFinest));
      }
    }
  }
  return features;
}

Values CoordinationFeatures(const Window& window, const Limbs& limbs) {
  const std::array joints = {
      0, limbs.head, limbs.wrists[0], limbs.wrists[1], limbs.feet[0], limbs.feet[2]};
  const auto count = static_cast<Eigen::Index>(joints.size());
  Eigen::MatrixXd speeds(static_cast<Eigen::Index>(window.frames()) - 1, count);
  for (Eigen::Index joint = 0; joint < count; ++joint) {
    const Values of = Speeds(window, joints[static_cast<size_t>(joint)]);
    speeds.col(joint) = Eigen::Map<const Eigen::VectorXd>(of.data(), std::ssize(of));
  }
  speeds = (speeds.array() + kFinest).log().matrix();
  speeds.rowwise() -= speeds.colwise().mean().eval();
  Values features;
  for (Eigen::Index a = 0; a < count; ++a) {
    for (Eigen::Index b = 0; b < a; ++b) {
      const double scale = speeds.col(a).norm() * speeds.col(b).norm();
      features.push_back(scale > 0 ? speeds.col(a).dot(speeds.col(b)) / scale : 0);
    }
  }
  return features;
}

Values DwellFeatures(const Window& window, const Limbs& limbs) {
  Values features;
  const auto add = [&](std::initializer_list<int> joints) {
    Values all;
    for (const int joint : joints) {
      const Values speeds = Speeds(window, joint);
      all.insert(all.end(), speeds.begin(), speeds.end());
    }
    AddLogQuantiles(all, {0.05, 0.25, 0.5, 0.9}, &features);
  };
  add({limbs.wrists[0], limbs.wrists[1]});
  add({limbs.feet[0], limbs.feet[2]});
  add({0});
  return features;
}

}  // namespace

void AddFamilies(const Skeleton& skeleton, double fps, const JointTrack& track, double floor,
                 size_t clip, FamilyWindows* to) {
  const std::vector<Balance> balance = BalanceOf(skeleton, fps, track, floor);
  const Limbs limbs(skeleton);
  const auto length = static_cast<size_t>(std::lround(kWindowSeconds * fps));
  for (size_t from = 0; from + length <= track.size(); from += length) {
    const Window window{std::span(track).subspan(from, length),
                        std::span(balance).subspan(from, length), fps, floor};
    const Values families[] = {FloorFeatures(window),
                               BalanceFeatures(window),
                               ContactFeatures(window, limbs),
                               SpectrumFeatures(window, limbs),
                               CoordinationFeatures(window, limbs),
                               DwellFeatures(window, limbs)};
    for (size_t family = 0; family < to->size(); ++family) {
      const Values& features = families[family];
      (*to)[family].features.push_back(
          Eigen::Map<const Eigen::VectorXd>(features.data(), std::ssize(features)));
      (*to)[family].clips.push_back(clip);
    }
  }
}

std::array<double, kCriticFamilies.size()> FamilyAreas(const FamilyWindows& real,
                                                       const FamilyWindows& danced) {
  std::array<double, kCriticFamilies.size()> areas;
  for (size_t family = 0; family < areas.size(); ++family)
    areas[family] = CriticArea(real[family], danced[family], 0);
  return areas;
}

}  // namespace choreo
