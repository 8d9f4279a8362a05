#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/core/grid.h"
#include "model/core/limits.h"
#include "model/engine/engine_cost.h"
#include "model/flow/footwork_options.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"
#include "model/motion/velocity_factors.h"

/// What stands between the dance and a network: poses in, poses out, one frame at a time. No torch,
/// no gRPC.
namespace choreo {

/// How lively a model's dancers usually are: what multipliers of velocity factors refer to.
struct VelocityReference {
  std::string name;
  std::array<float, kBodyParts> factors = {};  ///< by BodyPart, metres a frame at the model's rate
};

/// What a loaded model is. Fixed for the life of an engine.
struct ModelInfo {
  std::string name;         ///< "default", "paper", ...
  std::string fingerprint;  ///< model hash + build + kernel set: equal fingerprints give equal bits
  std::string licence;      ///< terms of the weights
  std::string card;         ///< the model card, JSON
  Skeleton skeleton;
  double fps = kModelFps;               ///< rate at which the model runs
  int history_frames = kHistoryFrames;  ///< tau
  int audio_features = kMfccCount;      ///< MFCC rows' width
  int max_transition_frames = kMaxTransitionFrames;
  double default_temperature = 0.3;
  double max_temperature = kMaxTemperature;  ///< beyond it nothing changes any more
  bool hears_music = true;        ///< false: learnt without; music changes when it dances, not what
  bool deterministic = false;     ///< seed, candidate and temperature change nothing
  bool root_path = false;         ///< takes Controls::root_path
  bool velocity_factors = false;  ///< takes Controls::velocity_factors
  /// The first one, "median", is the default. At least one where velocity factors are taken.
  std::vector<VelocityReference> velocity_references = {};
  std::vector<std::string> styles = {};  ///< that may be asked for
  FootworkOptions footwork = {};         ///< of models that make whole plans
};

inline constexpr int kMostSlots = 4096;  ///< of one engine

/// The key pose at the end of a transition.
struct Target {
  Pose pose;
  PoseMask mask;
  /// The root's above the floor, metres, of a key that leaves its position open. None: open too.
  std::optional<double> height = {};
};

/// What is asked of a transition beside its key (paper C, Section 3.3). What is left empty, the
/// model chooses.
struct Controls {
  /// [3, frames] or empty: where the root should be in each frame, metres; from the history's last
  /// root to the target's (dance/path_lead.h bends it there).
  Eigen::Matrix3Xd root_path;
  bool path_heights = true;  ///< whether somebody asked for its heights; else they are a guess
  /// [kBodyParts, frames] or empty: how lively each part should be in each frame
  /// (motion/velocity_factors.h), metres a frame, at least 0.
  Eigen::Matrix<float, kBodyParts, Eigen::Dynamic> velocity_factors;
  /// By BodyPart: whether somebody asked for it; the others' factors are the model's reference.
  std::array<bool, kBodyParts> parts_asked = {true, true, true, true, true};
};

/// Everything that a transition is a function of, but the music of its own frames, which arrives
/// with them. All poses stand in the transition's canonical frame (motion/canonical.h).
struct TransitionSpec {
  int frames = 0;             ///< N >= 1; with a target, frame N-1 is the key's
  std::vector<Pose> history;  ///< tau poses, oldest first; the last one stands right before frame 0
  std::optional<Target> target;  ///< none: music alone
  /// The middle of the floor that the dance keeps to where nothing says its place, its height
  /// unread. None: where the history ends.
  std::optional<Eigen::Vector3d> stage = {};
  bool has_audio = false;  ///< false: audio rows are ignored, the model dances without music
  /// [audio_features, tau] MFCC rows of the history's frames, oldest first.
  Eigen::MatrixXf audio_history;
  /// Where the music beats, in frames from frame 0, ascending; a dance without a path is timed to
  /// it (plan/plan_stages.h). Empty: unknown.
  std::vector<double> beats;
  Controls controls;
  uint64_t seed = 0;
  uint32_t candidate = 0;
  int64_t first_frame = 0;  ///< absolute number of frame 0: the noise is keyed (seed, candidate,
                            ///< absolute frame, dimension)
  float temperature = 0.3F;
  std::string style = {};  ///< one of the model's, or empty: any
};

/// Whether its target asks for the root's position or a joint.
bool Keyed(const TransitionSpec& spec);

/// Throws Error(kInvalidArgument, field) unless the pose has the skeleton's joints.
void CheckJoints(const Skeleton& skeleton, const Pose& pose, const std::string& field);

/// Throws Error(kInvalidArgument) naming the field unless the spec has the model's shape: frames,
/// history, joints, mask, music rows and controls; a control that the model does not take is
/// refused too.
void ValidateSpec(const TransitionSpec& spec, const ModelInfo& model);

/// One slot's share of a step.
struct StepInput {
  int slot = 0;
  const Pose* previous = nullptr;    ///< what was emitted for the frame before (feeds the history);
                                     ///< null on a slot's first step
  std::span<const float> audio_row;  ///< MFCC row of this frame; empty where the spec has no audio
};

struct StepOutput {
  Pose pose;  ///< canonical frame, as the model has it: arrival and post-processing come after
  Contacts contacts = {};  ///< probability-like, [0, 1]
  /// Of this frame, nats (model's standardised space, log-determinants included), of models that
  /// have an exact one.
  std::optional<float> log_likelihood = {};
  /// With frame 0 of a model that makes whole transitions at once: all of its poses, this one
  /// first. Valid until the slot steps on or is released. Else empty.
  std::span<const Pose> plan = {};
};

/// How far a slot's transition is.
struct SlotProgress {
  int frame = 0;                ///< next to be stepped
  int frames = 0;               ///< N
  bool hears = false;           ///< its model listens to the rows of its music
  bool being_admitted = false;  ///< it can't be stepped yet
};

/// Throws Error(kInvalidArgument) unless the input's slot holds a transition, which has made
/// `progress`, and the input is what its next frame needs.
void ValidateStep(const StepInput& input, const std::optional<SlotProgress>& progress,
                  const ModelInfo& model);

/// A network on one device with a fixed number of slots. Each slot holds one transition in
/// progress. Not thread-safe: one worker owns an engine. A slot's outputs do not depend on which
/// other slots step with it.
class StepEngine {
 public:
  virtual ~StepEngine() = default;
  virtual const ModelInfo& model() const = 0;
  virtual std::string device() const = 0;  ///< "cpu", "cuda:0"
  virtual int slots() const = 0;
  virtual int free_slots() const = 0;
  /// How many slots it steps best together: with more, the first would wait for the last.
  virtual int batch() const { return 64; }
  /// Takes a slot, numbered 0 to slots() - 1, for a transition. Throws Error(kResourceExhausted)
  /// with no slot free, Error(kInvalidArgument) for a spec of the wrong shape.
  virtual int BeginAdmission(const TransitionSpec& spec) = 0;
  /// Computes a slice of what is known before the loop: short enough that a frame which is due can
  /// wait for it. True while more is left; the slot can be stepped after false. Between two slices
  /// other slots may step, and the slot may be released. What it computes does not depend on that.
  virtual bool ContinueAdmission(int /*slot*/) { return false; }
  /// Both, to the end.
  int Admit(const TransitionSpec& spec);
  /// Steps every named slot by one frame; a slot is named at most once. `out` has the size of `in`.
  virtual void Step(std::span<const StepInput> in, std::span<StepOutput> out) = 0;
  /// Frees a slot; at any time.
  virtual void Release(int slot) noexcept = 0;

  /// What WarmUp has measured; nothing before.
  const EngineCost& cost() const { return cost_; }
  void set_cost(const EngineCost& cost) { cost_ = cost; }

 private:
  EngineCost cost_;
};

}  // namespace choreo
