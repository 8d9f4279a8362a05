#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/messages/continuation.h"
#include "model/messages/dance_event.h"
#include "model/motion/canonical.h"
#include "model/motion/motion.h"
#include "model/plan/arrival.h"
#include "model/plan/footwork.h"
#include "model/plan/sampler.h"

namespace choreo {

/// One finished frame.
struct DanceFrame {
  Pose pose;  ///< world; rounded to floats, as it is sent and as the next transition finds it
  Contacts contacts = {};                    ///< the model's, if without footwork
  std::optional<float> log_likelihood = {};  ///< nats; none if the model has no exact likelihood
  /// The speeds that velocity factors ask for in this frame, by BodyPart, metres a frame.
  std::optional<std::array<float, kBodyParts>> asked_speeds = {};
};

/// The state from which a transition continues.
struct DancedState {
  std::vector<Pose> history = {};  ///< the last tau poses; empty: the dance begins without any
  std::optional<GroundFrame> stage = {};  ///< TransitionSpec::stage
};

/// The average speeds needed to reach a key. Paper F, Section 5.2: an interval too short for the
/// change fails.
struct RequiredSpeed {
  double root_m_per_s = 0;
  double joint_rad_per_s = 0;  ///< of the fastest joint
  int joint = 0;
  /// A dance warns beyond these limits: a sprint, and the fastest limbs of real dances.
  static constexpr double kRootLimit = 5.0;
  static constexpr double kJointLimit = 15.0;
  bool TooFast() const { return root_m_per_s > kRootLimit || joint_rad_per_s > kJointLimit; }
};

/// Makes one transition slice by slice: samples it, steers it onto its key, and puts it on its
/// feet. A pure function of the spec and the model; the same code serves streams, single
/// transitions and evaluation. Not thread-safe.
class TransitionRun {
 public:
  /// `world`: in the world frame. Its history may have any number of poses: the last tau count,
  /// fewer are padded with the earliest, and none means the neutral stance at the origin. A target
  /// without a position needs no height. Throws what TransitionSpec::Validate throws.
  TransitionRun(const ModelInfo& model, const TransitionSpec& world);

  /// In its canonical frame.
  const TransitionSpec& spec() const { return *spec_; }
  void set_candidate(uint32_t candidate) {
    spec_.Change([candidate](TransitionSpec& spec) { spec.candidate = candidate; });
  }

  /// Makes all frames. If a joint moves faster than bodies can, though no key demands that, samples
  /// anew up to four times, and keeps the slowest. Sampler and this must outlive the slices,
  /// and this must not move meanwhile. Throws Error(kInternal) for a plan of another length, and
  /// for a value that is not finite, whoever made it.
  Slices<> Dance(Sampler& sampler);

  /// All frames, once they are made.
  const std::vector<DanceFrame>& frames() const { return frames_; }
  /// Set after the last frame of a transition with a target; the caller fills in the id.
  const std::optional<KeyReached>& arrival() const { return arrival_result_; }
  /// The state, world, from which a dance continues after this many frames. A path, or a key with a
  /// root position, moves the stage there.
  DancedState StateAfter(size_t frames) const;
  /// None without a target.
  std::optional<RequiredSpeed> required_speed() const;

 private:
  void MoveToCanonicalFrame(TransitionSpec& spec);
  bool MayBeRetaken() const;
  double Strain() const;
  Slices<> DanceOnce(Sampler& sampler);
  void CheckLength() const;
  void Hold();
  void Steer();
  void PutOnFeet();
  DanceFrame Finish(size_t at);
  void MeasureArrival();
  void CheckFinite(size_t frame, const Pose& pose, std::span<const float> contacts,
                   const std::string& whose) const;

  const ModelInfo* model_;
  ValidSpec spec_;
  std::optional<Target> world_target_;
  GroundFrame ground_;
  std::optional<Arrival> arrival_;  // none: no steering
  bool held_ = false;               // the dancer holds the target's pose
  GroundFrame stage_;               // world
  std::vector<Pose> before_;        // the history, world
  Pose world_;                      // the newest frame, whose signs are kept

  Plan drawn_;              // as sampled
  std::vector<Pose> plan_;  // canonical, steered; those of frames_ stand on their feet
  Eigen::Matrix<double, 3, 2> offset_ = Eigen::Matrix<double, 3, 2>::Zero();  // Footwork::offset
  std::vector<DanceFrame> frames_;
  std::optional<KeyReached> arrival_result_;
  double correction_m_ = 0;
};

/// Whether the dancer only keeps the pose that she has: its target is that pose where she is, or
/// anywhere, and so soon that nobody dances away from it and back. No model is asked, and a path
/// waits. `world`: with at least one pose of history.
bool IsHold(const TransitionSpec& world, double fps);

/// Makes a transition at once, then calls `danced` with its number of frames. Throws what
/// TransitionRun throws.
TransitionRun DanceTransition(Sampler& sampler, const TransitionSpec& world,
                              const std::function<void(int)>& danced = {});

/// The history of a transition after these poses: exactly tau of them, rounded to floats. Fewer are
/// padded with the earliest; none mean a dancer who stands.
std::vector<Pose> FillHistory(const ModelInfo& model, std::span<const Pose> poses);

/// Rounds every number to a float, as clients receive it.
Pose RoundToFloat(const Pose& pose);

/// Picks from the music's beats (seconds, ascending) those of frames [first_frame, first_frame +
/// frames), one before and one after, as TransitionSpec::beats: in frames from the first.
std::vector<double> BeatsAround(std::span<const double> seconds, double fps, int64_t first_frame,
                                int frames);

}  // namespace choreo
