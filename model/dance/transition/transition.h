#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/dance/controls/control_track.h"
#include "model/dance/input/dance_music.h"
#include "model/dance/timeline/spec_poses.h"
#include "model/dance/timeline/timeline.h"
#include "model/dance/timeline/warning.h"
#include "model/messages/continuation.h"
#include "model/messages/dance_event.h"
#include "model/messages/dance_manner.h"
#include "model/motion/kinematics/canonical.h"
#include "model/motion/motion.h"
#include "model/plan/process_plan.h"
#include "model/plan/sampler.h"

namespace choreo {

/// One finished frame.
struct DanceFrame {
  Pose pose;               ///< world; rounded to floats, as sent and as the next transition uses it
  Contacts contacts = {};  ///< without footwork, the model's own if it has any
  std::optional<float> log_likelihood = {};  ///< nats; none if the model has no exact likelihood
  /// The speeds requested by velocity factors in this frame, by BodyPart, metres per frame.
  std::optional<std::array<float, kBodyParts>> asked_speeds = {};
};

/// The state from which a transition continues.
struct DancedState {
  std::vector<Pose> history = {};  ///< the last tau poses; empty: the dance begins without any
  std::optional<GroundFrame> stage = {};  ///< TransitionSpec::stage
};

/// All inputs of a dance's transition. They are values, so later messages do not change them.
struct TransitionInputs {
  /// What depends on no key, control or music (SpecOf). Without a history the transition starts
  /// from ControlTrack::Stance. PrepareTransition XORs the seed with TransitionMusic::id.
  TransitionSpec spec = {};
  ControlTrack controls;
  Segment segment;
  PlannedMusic music = {};
};

/// The part of a transition's spec that a dance's settings and the state before it give.
TransitionSpec SpecOf(const ModelInfo& model, const DanceManner& manner, uint64_t seed,
                      DancedState before);

/// Generates one transition slice by slice: samples and processes a plan (plan/process_plan.h). A
/// pure function of the spec and the model. Streams, single transitions and evaluation
/// share this code. Not thread-safe.
class TransitionRun {
 public:
  /// `world`: in the world frame. Its history may have any number of poses: only the last tau are
  /// used, fewer are padded with the earliest, and none means the neutral stance at the origin. A
  /// target without a position needs no height. Throws what ValidSpec throws.
  TransitionRun(const ModelInfo& model, const TransitionSpec& world);

  /// The spec in its canonical frame.
  const TransitionSpec& spec() const { return *spec_; }
  void set_candidate(uint32_t candidate) { spec_.SetTake(candidate, spec_->spare_frames); }

  /// Generates all frames. If a joint moves faster than human bodies can and no key requires it,
  /// samples again and keeps the slowest take (plan/takes.h). The sampler and this object must
  /// outlive the slices, and this object must not be moved meanwhile. Throws Error(kInternal) for a
  /// plan of the wrong length, and for any value that is not finite.
  Slices<> Dance(Sampler& sampler);

  /// All frames, once generated.
  const std::vector<DanceFrame>& frames() const { return frames_; }
  /// How the target was reached. Set after the last frame of a transition with a target. The caller
  /// fills in the id.
  const std::optional<KeyReached>& arrival() const { return arrival_result_; }
  /// The state, in the world frame, from which a dance continues after `frames` frames. A path, or
  /// a key with a root position, moves the stage there.
  DancedState StateAfter(size_t frames) const;
  /// The speeds needed to reach the target; none without a target.
  std::optional<RequiredSpeed> required_speed() const {
    return RequiredSpeedOf(*spec_, model_->fps);
  }

 private:
  void ToCanonicalFrame(TransitionSpec* spec) const;
  bool EndsOnFloor(const TransitionSpec& spec) const;
  double ExcessOf(const std::vector<Pose>& poses) const;
  Slices<ProcessedPlan> DanceOnce(Sampler& sampler) const;
  void SetFrames(const ProcessedPlan& processed);

  const ModelInfo* model_;
  ValidSpec spec_;
  std::optional<Target> world_target_;
  GroundFrame ground_;
  bool held_ = false;         // whether the dancer holds the target's pose
  GroundFrame stage_;         // world
  std::vector<Pose> before_;  // the history, world
  std::vector<DanceFrame> frames_;
  std::optional<KeyReached> arrival_result_;
};

struct PreparedTransition {
  TransitionRun run;
  std::vector<Beat> beats;        ///< TransitionMusic::beats
  std::vector<Warning> warnings;  ///< about its controls and its key
};

/// Prepares one transition of a dance: hears its music, and fills in its spec. Throws what
/// TransitionRun's constructor throws.
PreparedTransition PrepareTransition(const ModelInfo& model, const TransitionInputs& inputs);

/// Generates a whole transition, then calls `danced` with its number of frames. Throws what
/// TransitionRun throws.
TransitionRun DanceTransition(Sampler& sampler, const TransitionSpec& world,
                              const std::function<void(int)>& danced = {});

}  // namespace choreo
