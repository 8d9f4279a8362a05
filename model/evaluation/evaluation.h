#pragma once

#include <string>
#include <vector>

#include "model/core/grid.h"
#include "model/core/limits.h"
#include "model/evaluation/runner.h"
#include "model/evaluation/table.h"
#include "model/evaluation/windows.h"
#include "model/training/trainer.h"

namespace choreo {

class MotionEncoder;

/// A method: one row of a table.
struct Method {
  enum class Kind {
    kReal,           ///< the real dance
    kInterpolation,  ///< lerp and slerp between last pose and key, unprocessed
    kModel,          ///< a sampler, through model/dance as in the server
  };
  std::string name;
  Kind kind = Kind::kModel;
  Sampler* sampler = nullptr;  ///< for kModel; not owned
  bool keys = true;            ///< kModel: false for dances to the music alone
  bool network = true;         ///< kModel: false for one that was not trained
  bool finished = true;        ///< kModel: as served, with arrival and footwork

  /// A network that gets tables of its own besides its rows.
  bool Judged() const { return kind == Kind::kModel && network && keys; }
  /// Whether it can dance that many frames.
  bool Lasts(int frames) const {
    return kind != Kind::kModel || frames <= sampler->model().max_transition_frames;
  }
  bool TakesPath() const { return kind != Kind::kModel || sampler->model().Takes(kRootPath); }
  bool TakesVelocityFactors() const {
    return kind == Kind::kModel && sampler->model().Takes(kVelocityFactors);
  }
  /// Removes from a request the inputs that this method does not take.
  void Restrict(TransitionSpec* request) const {
    if (!keys) request->target.reset();
    if (finished) return;
    request->arrival_frames = 0;
    request->footwork = false;
  }
};

/// Options shared by all rows of an evaluation.
struct EvalOptions {
  std::vector<int> lengths{kComparedFrames.begin(),
                           kComparedFrames.end()};  ///< frames of the transitions
  int windows_per_clip = 8;
  int best_of = 10;  ///< samples per window, of which the nearest counts
  float temperature = 0;
  bool own_temperatures = false;  ///< each method's own instead, in tables that say so
  int long_seeds = 50;            ///< long dances of each kind; 0: none
  int long_frames = kMaxTransitionFrames;
  int free_dances = 20;  ///< without keys, in the liveliness table; 0: none
};

/// One data set, and the methods that dance on it. Owns nothing.
struct Evaluation {
  const ClipSet& set;
  const std::vector<Method>& methods;  ///< the judged model is last
  const EvalOptions& options;
  const Runner& runner;
  const MotionEncoder* encoder = nullptr;  ///< for EvaluateEncoded
  const ClipSet* training = nullptr;       ///< the set's training clips, or null

  const Method& judged() const { return methods.back(); }
  const ModelInfo& model() const { return judged().sampler->model(); }
  /// A method's temperature in tables that compare models as served.
  float TemperatureOf(const Method& method) const {
    return options.own_temperatures && method.kind == Method::Kind::kModel
               ? static_cast<float>(method.sampler->model().default_temperature)
               : options.temperature;
  }

  /// An empty table for this set; a table of one method has its name, except the judged one's.
  Table NewTable(const std::string& name, const std::string& title, std::vector<std::string> labels,
                 const Method* of = nullptr) const {
    const bool named = of != nullptr && of != &judged();
    Table table;
    table.name = name + "_" + set.name + (named ? "_" + of->name : "");
    table.title = title + ", " + set.name + (named ? ", " + of->name : "");
    table.label_headings = std::move(labels);
    return table;
  }
};

// Each plans inputs, has the runner dance them, and returns tables of the results: none if there is
// nothing to say of this set or model. All are deterministic.

/// Transitions between real poses (paper F, Table 2 and the key columns of Table 1). All methods
/// have the same temperature, windows, music, seeds and post-processing.
///
///   transitions_SET  every method: distances to the real dance and the usual metrics
///   keys_SET         every method: how far it misses keys, raw and as served
std::vector<Table> EvaluateTransitions(const Evaluation& evaluation);

/// liveliness_l2p_SET for every judged method: L2P over interpolation's at temperature 0, at the
/// served one, and of the best of EvalOptions::best_of samples there.
std::vector<Table> EvaluateNearness(const Evaluation& evaluation);

/// The liveliness of every judged method beside real motion, as served:
///
///   liveliness_SET      one figure per row. Through the clips' own poses every 2 s:
///                       lively_figures.h, spread over seeds and songs, hits on requested
///                       beats, Frechet distances, the critic. Without keys: long_figures.h.
///   weight_SET          weight_table.h, with keys and without
///   liveliness_bands_SET  how fast joints move in each frequency band
///
/// Figures named "÷ real" are the sum over dances divided by that over clips. No rows of keyed
/// dances if no clip has 20 s.
std::vector<Table> EvaluateLiveliness(const Evaluation& evaluation);

/// liveliness_styles_SET: how often a classifier, trained on the styles of the set's training clips
/// (metrics/style_classifier.h), recognises the style requested of dances without keys.
std::vector<Table> EvaluateStyles(const Evaluation& evaluation);

/// Long dances of the judged method beside the clips:
///
///   long_SET       with keys every 2 s and without: drift, freezing, explosion, limbs, keys
///   beats_SET      kinematic beats on music beats, compared with the same dances on the set's
///                  other songs (chance); keys at equal intervals and on beats (paper F, Table 4).
///                  Only for sets with music
std::vector<Table> EvaluateLongDances(const Evaluation& evaluation);

/// encoder_SET: paper F's Table 1 (Sections 4.5.2 and 4.5.4) in the codes of Evaluation::encoder,
/// for dances of 10 s: FID, variability (MeanApart of 15 seeds of one input, mean over inputs) and
/// diversity (MeanApart over inputs). Codes are in units of their standard deviation in training:
/// two random windows of it are 64 apart. All rows are compared with the even 5-second blocks of
/// real motion; the odd ones form a row.
std::vector<Table> EvaluateEncoded(const Evaluation& evaluation);

/// stress_SET: paper F, Section 5.2, where its model failed: to a lying pose in 30 frames and
/// fewer, and to a key that almost equals the present pose. Whether the stream would warn
/// (RequiredSpeed::TooFast), whether the dancer freezes, how demanding the transition is.
std::vector<Table> EvaluateStress(const Evaluation& evaluation);

/// Transitions that follow the real dance's root path and velocity factors (paper C, Section 4),
/// for models with these controls, like all below. Other methods appear without them.
///
///   lrp_SET, avf_SET, art_SET  its Tables 2-4 at 10, 50, 100 and 150 frames: real motion,
///                              interpolation along the path, each network alone and as served
///                              (arrival, footwork), and without keys
///   lrp_ratio_SET, lrp_turned_SET, control_skate_SET, tremor_SET  of the same dances
std::vector<Table> EvaluateControls(const Evaluation& evaluation);

/// How the speed of each part follows its velocity factor, on the real path between real poses:
///
///   multipliers_SET  the real dance's factors times 0.5, 1 and 1.5, over that dance's speeds
///   constant_SET     the model's first reference times 0.5, 1 and 1.5 in every frame, over that
///                    reference
///
/// Means over windows and frames. Methods without velocity factors have one row in each.
std::vector<Table> EvaluateMultipliers(const Evaluation& evaluation);

/// repetition_SET, at 100 to 250 frames: how much of a dance repeats itself, and how much of its
/// ending holds still.
std::vector<Table> EvaluateRepetition(const Evaluation& evaluation);

/// drawn_SET: root paths that no dancer recorded, between real poses: straight at constant speed,
/// on the spot (the key is moved there), and a bow; compared with the real ones. Requests no
/// velocity factors. For methods with keys that take a path: how much feet skate, how well key and
/// path are met.
std::vector<Table> EvaluateDrawnPaths(const Evaluation& evaluation);

}  // namespace choreo
