#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/core/grid.h"
#include "model/core/limits.h"
#include "model/core/valid.h"
#include "model/motion/canonical.h"
#include "model/motion/controls.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"
#include "model/motion/velocity_factors.h"
#include "model/plan/arrival.h"
#include "model/plan/footwork_options.h"

/// Describes a model, and a transition that it is to make.
namespace choreo {

/// The features of music that a model takes for each frame, besides beats and energy. Such a model
/// begins a transition once it has all of the transition's music.
struct Hearing {
  int features = 0;  ///< numbers of a frame; 0: nothing
  /// Makes them of the mel bands, in dB.
  void (*row)(std::span<const double> bands, std::span<float> features) = nullptr;

  explicit operator bool() const { return features > 0; }
};

/// A loaded model. Constant for the life of a sampler.
struct ModelInfo {
  std::string name;         ///< "default", "paper-f", ...
  std::string fingerprint;  ///< model hash + build + kernel set: equal fingerprints give equal bits
  std::string weights;      ///< hash of the checkpoint's content
  std::string packed_kernels;  ///< PackedKernels::name of what computes it; empty: LibTorch
  std::string licence;         ///< of the weights
  std::string card;            ///< the model card, JSON
  Skeleton skeleton;
  double fps = kModelFps;               ///< rate at which the model runs
  int history_frames = kHistoryFrames;  ///< tau
  int max_transition_frames = kMaxTransitionFrames;
  /// Frames from a transition's start within which the model sees a later key (LaterTarget). 0: it
  /// sees none.
  int sight_frames = 0;
  double default_temperature = 0.3;
  double max_temperature = kMaxTemperature;  ///< higher values change nothing
  bool takes_music = true;                   ///< false: its dances have no music
  Hearing hearing = {};
  bool deterministic = false;              ///< seed, candidate and temperature change nothing
  bool likelihood = false;                 ///< plans have exact ones (Plan::log_likelihoods)
  std::vector<std::string> controls = {};  ///< that it takes, of the names in kControls
  /// The first one, "median", is the default. At least one where velocity factors are taken.
  std::vector<VelocityReference> velocity_references = {};
  std::vector<std::string> styles = {};  ///< available for requests
  FootworkOptions footwork = {};

  bool Takes(std::string_view control) const {
    return std::ranges::find(controls, control) != controls.end();
  }
  bool Takes(size_t row) const { return Takes(kControls[row].name); }
};

/// A key that is reached only after a transition.
struct LaterTarget {
  Target target;
  int frames = 0;  ///< >= 1, from the transition's last frame to the key's
};

/// The music as a model hears it (Hearing).
struct MusicRows {
  Eigen::MatrixXf history;  ///< [features, tau], of the history's frames, oldest first
  Eigen::MatrixXf rows;     ///< [features, frames], of the transition's own
};

/// All inputs of a transition. Its poses are in one frame: the world's for a TransitionRun, the
/// canonical one (motion/canonical.h) for a Sampler.
struct TransitionSpec {
  int frames = 0;             ///< N >= 1; with a target, frame N-1 is the key's
  std::vector<Pose> history;  ///< tau poses, oldest first; the last one directly precedes frame 0
  std::optional<Target> target;           ///< none: dances to music alone
  std::optional<LaterTarget> later = {};  ///< only without a target; for models with sight_frames
  /// The pose one frame after the target, if the motion that follows exists already.
  std::optional<Pose> after = {};
  /// How hard the target is hit, 0 to kMaxHit (plan/plan_stages.h), and then rested in unless
  /// `after` follows. None: it is passed at the dance's own speed.
  std::optional<double> hit = {};
  /// The middle of the floor area that the dance keeps to if nothing fixes its position, and the
  /// audience, which the dancer faces if nothing fixes the facing. None: where the history ends and
  /// faces.
  std::optional<GroundFrame> stage = {};
  /// The music's beats, in frames from frame 0, ascending; a dance without a path is timed to them
  /// (plan/plan_stages.h). Empty: unknown.
  std::vector<double> beats;
  Controls controls;        ///< beside the key (paper C, Section 3.3)
  EnergyShift energy = {};  ///< for models that sample their own energy
  uint64_t seed = 0;
  uint32_t candidate = 0;
  int64_t first_frame = 0;  ///< absolute number of frame 0: noise is keyed by (seed, candidate,
                            ///< absolute frame, dimension)
  /// [frames] or empty: for each frame the absolute frame that it repeats, whose noise it shares,
  /// with this much `variation`, 0 to 1 (FillNormalLike).
  std::vector<int64_t> noise_like = {};
  double variation = 0;
  float temperature = 0.3F;
  std::string style = {};               ///< one of the model's, or empty for any
  std::optional<MusicRows> music = {};  ///< for models that hear; none: dances without
  // For measuring the model alone, set these to 0 and false.
  int arrival_frames = 12;  ///< Arrival's window
  bool footwork = true;
};

/// A spec that fits its model.
class ValidSpec : public Valid<TransitionSpec> {
 public:
  /// Throws Error(kInvalidArgument) naming the field unless it has the model's shape: frames,
  /// history, joints, mask, music rows and controls; also for a control that the model lacks.
  ValidSpec(TransitionSpec spec, const ModelInfo& model);
};

/// Whether its target fixes the root's position or a joint.
bool Keyed(const TransitionSpec& spec);

/// What steers its frames to its target; none without a target or with arrival_frames 0. A model
/// that makes one frame after another steers each before it makes the next, so that it continues
/// from where the dance is.
std::optional<Arrival> ArrivalOf(const TransitionSpec& spec,
                                 Arrival::Lead lead = Arrival::Lead::kWithModel);

}  // namespace choreo
