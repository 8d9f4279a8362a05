#pragma once

#include <string>
#include <vector>

#include "model/core/grid.h"
#include "model/core/limits.h"
#include "model/evaluation/runner.h"
#include "model/evaluation/table.h"
#include "model/evaluation/windows.h"
#include "model/training/trainer/trainer.h"

namespace choreo {

class MotionEncoder;

/// A method of making dances: one row of a table.
struct Method {
  enum class Kind {
    kReal,           ///< the real dance
    kInterpolation,  ///< lerp and slerp between last pose and key, unprocessed
    kModel,          ///< a sampler, driven by model/dance as in the server
  };
  std::string name;
  Kind kind = Kind::kModel;
  Sampler* sampler = nullptr;  ///< for kModel; not owned
  bool keys = true;            ///< kModel: whether requests have keys; false for the music alone
  bool network = true;         ///< kModel: whether the sampler is a trained network
  bool finished = true;        ///< kModel: whether with arrival and footwork, as served

  /// Whether it is a network with tables of its own.
  bool Judged() const { return kind == Kind::kModel && network && keys; }
  /// Whether it can dance `frames` frames.
  bool Lasts(int frames) const {
    return kind != Kind::kModel || frames <= sampler->model().max_transition_frames;
  }
  bool FollowsPath() const { return kind != Kind::kModel || sampler->model().Supports(kRootPath); }
  bool FollowsVelocityFactors() const {
    return kind == Kind::kModel && sampler->model().Supports(kVelocityFactors);
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
                           kComparedFrames.end()};  ///< of transitions, frames
  int windows_per_clip = 8;
  int best_of = 10;  ///< samples per window; the nearest one counts
  float temperature = 0;
  bool own_temperatures = false;  ///< each method's own temperature, in tables that say so
  int long_seeds = 50;            ///< number of long dances of each kind; 0: none
  int long_frames = kMaxTransitionFrames;
  int free_dances = 20;  ///< number of dances without keys in the liveliness table; 0: none
};

/// The context of an evaluation: one data set and the methods that dance on it. Owns nothing.
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

  /// An empty table for this set. Its name includes the method's if it is about one method other
  /// than the judged one.
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

// Each function plans inputs, runs them, and returns tables of results, or none if the set or model
// has nothing to measure. All are deterministic.

/// Transitions between real poses (paper F, Table 2 and the key columns of Table 1). All methods
/// have the same temperature, windows, music, seeds and post-processing.
///
///   transitions_SET  every method: distances to the real dance and the usual metrics
///   keys_SET         every method: the distance from keys, raw and as served
std::vector<Table> EvaluateTransitions(const Evaluation& evaluation);

/// liveliness_l2p_SET for every judged method: L2P over interpolation's at temperature 0, at the
/// served one, and of the best of EvalOptions::best_of samples there.
std::vector<Table> EvaluateNearness(const Evaluation& evaluation);

/// The liveliness of every judged method beside real motion, as served:
///
///   liveliness_SET      one figure per row. Through the clips' own poses every 2 s:
///                       liveliness_figures.h, spread over seeds and songs, hits on requested
///                       beats, Frechet distances, the critic. Without keys: long_figures.h.
///   weight_SET          weight_table.h, with keys and without
///   liveliness_bands_SET  how fast joints move in each frequency band
///
/// Figures named "÷ real" are the sum over dances divided by that over clips. No rows of keyed
/// dances if no clip has 20 s.
std::vector<Table> EvaluateLiveliness(const Evaluation& evaluation);

/// liveliness_styles_SET: how often a classifier, trained on the styles of the set's training clips
/// (metrics/style_classifier.h), recognises the requested style in dances without keys.
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
/// fewer, and to a key that almost equals the present pose. Shows whether the stream would warn
/// (RequiredSpeed::TooFast), whether the dancer freezes, and how demanding the transition is.
std::vector<Table> EvaluateStress(const Evaluation& evaluation);

/// Transitions that follow the real dance's root path and velocity factors (paper C, Section 4).
/// This and all tables below are for models with these controls; other methods have rows without
/// them.
///
///   lrp_SET, avf_SET, art_SET  the paper's Tables 2-4 at 10, 50, 100 and 150 frames: real motion,
///                              interpolation along the path, each network alone and as served
///                              (arrival, footwork), and without keys
///   lrp_ratio_SET, lrp_turned_SET, control_skate_SET, tremor_SET  of the same dances
std::vector<Table> EvaluateControls(const Evaluation& evaluation);

/// How closely each part's speed follows its velocity factor, on the real path between real poses:
///
///   multipliers_SET  the real dance's factors times 0.5, 1 and 1.5, over that dance's speeds
///   constant_SET     the model's first reference times 0.5, 1 and 1.5 in every frame, over that
///                    reference
///
/// Figures are means over windows and frames. Methods without velocity factors have one row in each
/// table.
std::vector<Table> EvaluateMultipliers(const Evaluation& evaluation);

/// repetition_SET, at 100 to 250 frames: the shares of a dance that repeat it, and of its ending
/// that hold still.
std::vector<Table> EvaluateRepetition(const Evaluation& evaluation);

/// drawn_SET: drawn root paths between real poses, compared with the real ones: straight at
/// constant speed, on the spot (with the key moved there), and a bow. Requests no velocity factors.
/// For methods with keys that take a path. Shows how much feet skate and how closely the dance
/// meets key and path.
std::vector<Table> EvaluateDrawnPaths(const Evaluation& evaluation);

}  // namespace choreo
