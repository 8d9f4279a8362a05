#include "client/authoring/keys/choreography.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "model/audio/beats/suggest_keys.h"
#include "model/core/grid.h"
#include "model/motion/kinematics/canonical.h"

namespace choreo::authoring {
namespace {

constexpr double kMinPeriod = 1.6;      // seconds, least interval between counts with keys
constexpr double kPlainInterval = 2.0;  // without beats
constexpr double kWalkingSpeed = 0.28;  // metres a second, at most
constexpr double kTurningSpeed = 0.35;  // radians a second, at most
constexpr double kStageRadius = 1.2;    // metres; beyond it the path leads back

/// Uniform random numbers that do not depend on the standard library.
class Dice {
 public:
  explicit Dice(uint64_t seed) : engine_(seed) {}
  /// In [0, 1).
  double Unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double Between(double low, double high) { return low + (high - low) * Unit(); }
  size_t Below(size_t count) { return static_cast<size_t>(Unit() * static_cast<double>(count)); }

 private:
  std::mt19937_64 engine_;
};

/// Returns the seconds of keys, the first at 0. With beats there is a key on count 1 and every 1,
/// 2, 4, 8 ... beats from it, the fewest that leave time to move. The count continues before the
/// first beat and after the last.
std::vector<double> KeyTimes(const CompositionRequest& request) {
  const auto& [seconds, beats, first, passages, seed, way, end, named] = request;
  double period = kPlainInterval;
  std::vector<double> counts = {0};
  if (beats.size() >= 2) {
    period = (beats.back() - beats.front()) / static_cast<double>(beats.size() - 1);
    counts = beats;
  }
  size_t one = beats.size() >= 2 ? first : 0;
  for (; counts.front() > period; ++one) counts.insert(counts.begin(), counts.front() - period);
  while (counts.back() + period < seconds) counts.push_back(counts.back() + period);

  size_t stride = 1;
  while (period * static_cast<double>(stride) < kMinPeriod) stride *= 2;
  std::vector<double> times = {0};
  for (size_t i = one % stride; i < counts.size(); i += stride) {
    // Drops counts that an unsteady tempo brings too close, and those after the last frame.
    if (counts[i] - times.back() >= kMinKeyInterval && counts[i] <= seconds - 1 / kModelFps)
      times.push_back(counts[i]);
  }
  if (end && *end - times.back() >= kMinKeyInterval) times.push_back(*end);
  if (end && times.size() > 1) times.back() = *end;  // if the count came near
  return times;
}

/// The dancer's path over the floor.
class Walk {
 public:
  explicit Walk(Dice* dice) : dice_(dice) {}

  /// The next place, `seconds` later.
  GroundFrame Next(double seconds) {
    const double distance = kWalkingSpeed * seconds * dice_->Between(0.4, 1.0);
    const double way = place_.origin.norm() > kStageRadius
                           ? std::atan2(-place_.origin.x(), -place_.origin.z())
                           : dice_->Between(-M_PI, M_PI);
    place_.origin += distance * Eigen::Vector3d(std::sin(way), 0, std::cos(way));
    // Turns the dancer back to the audience, who never see a dancer's back for long.
    place_.heading += kTurningSpeed * seconds * dice_->Between(-1, 1);
    place_.heading = std::clamp(place_.heading, -1.2, 1.2);
    return place_;
  }
  const GroundFrame& place() const { return place_; }

 private:
  Dice* dice_;
  GroundFrame place_;
};

/// Deals the library's poses to keys.
class Deck {
 public:
  Deck(Dice* dice, std::span<const LibraryPose> poses, std::span<const Passage> passages)
      : dice_(dice), poses_(poses), passages_(passages) {}

  /// Returns the pose of the key at times[i], which may follow those returned before.
  size_t Next(std::span<const double> times, size_t i) {
    std::optional<size_t> pose = Before(times[i]);
    if (!pose) pose = Draw(i + 1 < times.size() ? Before(times[i + 1]) : std::nullopt);
    drawn_.push_back({times[i], *pose});
    return *pose;
  }

 private:
  struct Drawn {
    double time;
    size_t pose;
  };

  /// Returns the pose of the key at the same place in the earlier passage, if any.
  std::optional<size_t> Before(double time) const {
    for (const Passage& passage : passages_) {
      // A passage's first key is on a beat near the passage's beginning.
      if (time < passage.from - kMinKeyInterval || time >= passage.to) continue;
      const double then = time - passage.from + passage.like;
      for (const Drawn& key : drawn_) {
        if (std::abs(key.time - then) < kMinKeyInterval / 2) return key.pose;
      }
    }
    return std::nullopt;
  }

  /// Draws a pose that differs from its neighbours; the first is not an ending. `next`: the pose
  /// that the following key repeats, if any.
  size_t Draw(std::optional<size_t> next) {
    if (left_.empty()) {  // a pose repeats only after all others
      for (size_t i = 0; i < poses_.size(); ++i) left_.push_back(i);
    }
    size_t card = dice_->Below(left_.size());
    for (size_t tries = 0; tries < left_.size() && !Fits(left_[card], next); ++tries)
      card = (card + 1) % left_.size();
    const size_t pose = left_[card];
    left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(card));
    return pose;
  }

  bool Fits(size_t pose, std::optional<size_t> next) const {
    if (pose == next) return false;
    return drawn_.empty() ? !IsEnding(poses_[pose]) : pose != drawn_.back().pose;
  }

  Dice* dice_;
  std::span<const LibraryPose> poses_;
  std::span<const Passage> passages_;
  std::vector<Drawn> drawn_;
  std::vector<size_t> left_;
};

/// A key's pose and place.
struct Step {
  size_t pose = 0;
  GroundFrame place;
};

/// Draws a step for each of `times`.
std::vector<Step> DrawSteps(uint64_t seed, const std::vector<double>& times,
                            std::span<const Passage> passages, std::span<const LibraryPose> poses) {
  Dice dice(seed);
  Deck deck(&dice, poses, passages);
  Walk walk(&dice);
  std::vector<Step> steps;
  for (size_t i = 0; i < times.size(); ++i) {
    const size_t pose = deck.Next(times, i);
    steps.push_back({pose, i == 0 ? walk.place() : walk.Next(times[i] - times[i - 1])});
  }
  return steps;
}

}  // namespace

std::vector<size_t> DrawPoses(std::span<const double> times, std::span<const Passage> passages,
                              uint64_t seed, std::span<const LibraryPose> poses) {
  Dice dice(seed);
  Deck deck(&dice, poses, passages);
  std::vector<size_t> drawn;
  for (size_t i = 0; i < times.size(); ++i) drawn.push_back(deck.Next(times, i));
  return drawn;
}

std::string IdOfKey(size_t number, const LibraryPose& pose) {
  return std::to_string(number) + "-" + pose.id;
}

std::vector<client::KeyPose> ComposeKeys(const CompositionRequest& request,
                                         std::span<const LibraryPose> poses) {
  if (!(request.seconds >= 2)) {
    std::ostringstream message;
    message << request.seconds << " s is shorter than 2 s, the least for key poses of the library";
    throw InvalidArgument(request.named, message.str());
  }
  const std::vector<double> times = KeyTimes(request);
  const auto draw = [&](uint64_t seed) { return DrawSteps(seed, times, request.passages, poses); };
  const std::vector<Step> steps = draw(request.seed),
                          way = request.way ? draw(*request.way) : steps;
  std::vector<client::KeyPose> keys;
  for (size_t i = 0; i < times.size(); ++i) {
    const LibraryPose& pose = poses[steps[i].pose];
    client::KeyPose& key = keys.emplace_back();
    key.id = IdOfKey(keys.size(), pose);
    key.time_s = times[i];
    key.pose = way[i].place.ToWorld(pose.pose);
  }
  return keys;
}

}  // namespace choreo::authoring
