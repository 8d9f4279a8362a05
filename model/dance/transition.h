#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/dance/control_track.h"
#include "model/dance/dance_music.h"
#include "model/dance/spec_poses.h"
#include "model/dance/timeline.h"
#include "model/dance/warning.h"
#include "model/messages/continuation.h"
#include "model/messages/dance_event.h"
#include "model/messages/dance_manner.h"
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

/// What a transition of a dance depends on. Values, so that later messages change nothing.
struct TransitionInputs {
  DanceManner manner = {};
  uint64_t seed = 0;  ///< the dance's; the music's identity is added to it
  ControlTrack controls;
  Segment segment;
  /// The poses danced or given before the transition; without any it starts from
  /// ControlTrack::Stance.
  DancedState before = {};
  std::optional<Pose> after = {};        ///< TransitionSpec::after
  std::vector<int64_t> noise_like = {};  ///< TransitionSpec::noise_like
  TransitionMusic music = {};
};

/// Makes one transition slice by slice: samples it, steers it onto its key, and puts it on its
/// feet. A pure function of the spec and the model; the same code serves streams, single
/// transitions and evaluation. Not thread-safe.
class TransitionRun {
 public:
  /// `world`: in the world frame. Its history may have any number of poses: the last tau count,
  /// fewer are padded with the earliest, and none means the neutral stance at the origin. A target
  /// without a position needs no height. Throws what ValidSpec throws.
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
  std::optional<RequiredSpeed> required_speed() const {
    return RequiredSpeedOf(*spec_, model_->fps);
  }

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

struct PreparedTransition {
  TransitionRun run;
  std::vector<Warning> warnings;  ///< about its controls and its key
};

/// Prepares one transition of a dance. Throws what TransitionRun throws.
PreparedTransition PrepareTransition(const ModelInfo& model, const TransitionInputs& inputs);

/// Makes a transition at once, then calls `danced` with its number of frames. Throws what
/// TransitionRun throws.
TransitionRun DanceTransition(Sampler& sampler, const TransitionSpec& world,
                              const std::function<void(int)>& danced = {});

}  // namespace choreo
