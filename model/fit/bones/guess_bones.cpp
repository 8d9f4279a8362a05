#include "model/fit/bones/guess_bones.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "model/motion/kinematics/mirror.h"
#include "model/motion/skeleton.h"

namespace choreo {
namespace {

// Shares of the body's height.
constexpr double kBeside = 0.02;      // a node further than this from the middle belongs to a side
constexpr double kAboveToes = 0.035;  // ankles are at least this high
constexpr size_t kMinNodes = 10, kMaxNodes = 5000;  // limits, also for hostile files
constexpr size_t kFingers = 3;                      // the least number of chains below a hand

class BodyGuess {
 public:
  BodyGuess(const std::vector<int>& parents, const Eigen::Matrix3Xd& places,
            const std::vector<bool>& joints)
      : parents_(parents), places_(places), children_(parents.size()) {
    for (int node = 0; node < std::ssize(parents); ++node) {
      if (!joints[node]) continue;
      nodes_.push_back(node);
      const int parent = parents[node];
      if (parent >= 0) children_[parent].push_back(node);
    }
  }

  HumanBones Guess() {
    if (nodes_.size() < kMinNodes || parents_.size() > kMaxNodes) return {};
    Measure();
    const int feet[2] = {Extreme([&](int n) { return Beside(n, 1) ? -Y(n) : kNever; }),
                         Extreme([&](int n) { return Beside(n, -1) ? -Y(n) : kNever; })};
    const int hands[2] = {Extreme([&](int n) { return X(n); }),
                          Extreme([&](int n) { return -X(n); })};
    const int top = Extreme([&](int n) { return Y(n); });
    const int pelvis = Common(feet[0], feet[1]), chest = Common(hands[0], hands[1]);
    if (pelvis < 0 || chest < 0 || !IsBelow(chest, pelvis, parents_) ||
        !IsBelow(top, chest, parents_)) {
      return {};
    }
    Set("pelvis", pelvis);
    const std::vector<int> spine = Path(pelvis, chest);
    for (size_t i = 0; i < std::min<size_t>(spine.size(), 6); ++i)
      Set("spine" + std::to_string(i + 1), spine[i]);
    const std::vector<int> neck = Path(chest, top);
    if (neck.size() > 1) Set("neck", neck[0]);
    if (!neck.empty()) Set("head", neck[neck.size() > 1 ? 1 : 0]);
    for (size_t side = 0; side < 2; ++side) {
      Leg(Path(pelvis, feet[side]), side == 0 ? 1 : -1);
      Arm(Path(chest, hands[side]), side == 0 ? 1 : -1);
    }
    return std::move(found_);
  }

 private:
  static constexpr double kNever = -1e300;

  double X(int node) const { return places_(0, node) - middle_; }
  double Y(int node) const { return places_(1, node); }
  bool Beside(int node, int side) const { return side * X(node) > kBeside * height_; }
  double Length(int a, int b) const { return (places_.col(a) - places_.col(b)).norm(); }

  void Measure() {
    const Eigen::Matrix3Xd body = places_(Eigen::all, nodes_);
    floor_ = body.row(1).minCoeff();
    height_ = body.row(1).maxCoeff() - floor_;
    middle_ = (body.row(0).maxCoeff() + body.row(0).minCoeff()) / 2;
  }

  int Extreme(const auto& value) const { return *std::ranges::max_element(nodes_, {}, value); }

  // The lowest common ancestor of both.
  int Common(int a, int b) const {
    int node = parents_[b];
    while (node >= 0 && (node == a || !IsBelow(a, node, parents_))) node = parents_[node];
    return node;
  }
  // The path from below `ancestor` to `node`.
  std::vector<int> Path(int ancestor, int node) const {
    std::vector<int> path;
    for (; node >= 0 && node != ancestor; node = parents_[node]) path.push_back(node);
    std::ranges::reverse(path);
    return path;
  }

  void Set(const std::string& bone, int node) { found_.bones[bone] = node; }

  void Leg(std::vector<int> path, int side) {
    const std::string name = side > 0 ? "left_" : "right_";
    std::erase_if(path, [&](int node) { return !Beside(node, side); });
    if (path.size() < 3) return;
    size_t ankle = 2;
    if (path.size() > 3) {
      while (ankle + 1 < path.size() && Y(path[ankle + 1]) - floor_ > kAboveToes * height_) ++ankle;
    }
    const double half = (Y(path[0]) + Y(path[ankle])) / 2;
    const int knee = *std::ranges::min_element(path.begin() + 1, path.begin() + ankle, {},
                                               [&](int node) { return std::abs(Y(node) - half); });
    Set(name + "hip", path[0]);
    Set(name + "knee", knee);
    Set(name + "ankle", path[ankle]);
    if (ankle + 1 < path.size()) Set(name + "foot", path[ankle + 1]);
  }

  void Arm(const std::vector<int>& path, int side) {
    const std::string name = side > 0 ? "left_" : "right_";
    if (path.size() < 3) return;
    const auto hand =
        std::ranges::find_if(path, [&](int node) { return children_[node].size() >= kFingers; });
    size_t wrist = hand - path.begin();
    if (hand == path.end()) wrist = std::min<size_t>(path.size() - 1, 3);
    if (wrist < 2) return;
    // Upper arm and forearm are long and about equal.
    double best = kNever;
    size_t shoulder = 0, elbow = 1;
    for (size_t upper = 0; upper + 1 < wrist; ++upper) {
      for (size_t lower = upper + 1; lower < wrist; ++lower) {
        const double a = Length(path[upper], path[lower]), b = Length(path[lower], path[wrist]);
        const double score = a + b - 2 * std::abs(a - b);
        if (score > best) best = score, shoulder = upper, elbow = lower;
      }
    }
    if (shoulder > 0) Set(name + "collar", path[shoulder - 1]);
    Set(name + "shoulder", path[shoulder]);
    Set(name + "elbow", path[elbow]);
    Set(name + "wrist", path[wrist]);
  }

  const std::vector<int>& parents_;
  const Eigen::Matrix3Xd& places_;
  std::vector<int> nodes_;
  std::vector<std::vector<int>> children_;
  double height_ = 0, floor_ = 0, middle_ = 0;
  HumanBones found_;
};

// A body facing -Z has its left side at -X.
void TurnRound(const Eigen::Matrix3Xd& places, HumanBones* found) {
  double ahead = 0;
  for (const std::string side : {"left_", "right_"}) {
    const int toes = found->Find(side + "foot"), ankle = found->Find(side + "ankle");
    if (toes >= 0 && ankle >= 0) ahead += places(2, toes) - places(2, ankle);
  }
  if (ahead >= 0) return;
  std::map<std::string, int> turned;
  for (const auto& [bone, node] : found->bones) turned[OtherSide(bone)] = node;
  found->bones = std::move(turned);
}

// The number of conditions on a plausible body that hold.
int Plausible(const HumanBones& found, const Eigen::Matrix3Xd& places) {
  constexpr double kAlike =
      0.1;  // share of a bone's length by which it may differ from the other side's
  int points = 0;
  const auto place = [&](const std::string& bone) -> std::optional<Eigen::Vector3d> {
    const int node = found.Find(bone);
    if (node < 0) return std::nullopt;
    return places.col(node);
  };
  const auto above = [&](const std::string& high, const std::string& low) {
    const auto a = place(high), b = place(low);
    points += a && b && a->y() - b->y() > (*a - *b).norm() / 2 ? 1 : 0;
  };
  above("head", "pelvis");
  for (const std::string side : {"left_", "right_"}) {
    above(side + "hip", side + "knee"), above(side + "knee", side + "ankle");
    above("head", side + "shoulder"), above(side + "shoulder", side + "hip");
  }
  for (const auto& [from, to] : {std::pair("hip", "knee"), std::pair("knee", "ankle"),
                                 std::pair("shoulder", "elbow"), std::pair("elbow", "wrist")}) {
    double lengths[2] = {-1, 1};
    for (const int side : {0, 1}) {
      const std::string name = side == 0 ? "left_" : "right_";
      if (const auto a = place(name + from), b = place(name + to); a && b)
        lengths[side] = (*a - *b).norm();
    }
    points += std::abs(lengths[0] - lengths[1]) < kAlike * std::abs(lengths[1]) ? 1 : 0;
  }
  return points;
}

}  // namespace

HumanBones GuessBones(const std::vector<int>& parents, const Eigen::Matrix3Xd& places,
                      const std::vector<bool>& joints, Eigen::Matrix3d* upright) {
  HumanBones best;
  int most = -1;
  // The axes as files have them, the likely ones first.
  for (const Eigen::Vector3d& up :
       {Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 0, 0),
        Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(-1, 0, 0)}) {
    const Eigen::Matrix3d stand =
        Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitY()).toRotationMatrix();
    for (const double heading : {0.0, -M_PI / 2}) {
      const Eigen::Matrix3d turn =
          Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitY()).toRotationMatrix() * stand;
      const Eigen::Matrix3Xd turned = turn * places;
      HumanBones found = BodyGuess(parents, turned, joints).Guess();
      const int points = Plausible(found, turned);
      if (points <= most) continue;
      most = points;
      TurnRound(turned, &found);
      best = std::move(found);
      if (upright != nullptr) *upright = turn;
    }
  }
  return best;
}

}  // namespace choreo
