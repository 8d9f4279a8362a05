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

/// A row of a table: who makes the transitions.
struct Method {
  enum class Kind {
    kReal,           ///< what was really danced
    kInterpolation,  ///< lerp and slerp between last pose and key, as they are
    kModel,          ///< a sampler, through model/dance as the server has it
  };
  std::string name;
  Kind kind = Kind::kModel;
  Sampler* sampler = nullptr;  ///< of kModel; not owned
  bool keys = true;            ///< kModel: false for a dance to the music alone
  bool network = true;         ///< kModel: false for one that nobody trained
  bool finished = true;        ///< kModel: as served, with arrival and footwork

  /// A network that gets tables of its own, beside its rows.
  bool Judged() const { return kind == Kind::kModel && network && keys; }
  /// Whether it can dance that many frames at all.
  bool Lasts(int frames) const {
    return kind != Kind::kModel || frames <= sampler->model().max_transition_frames;
  }
  bool TakesPath() const { return kind != Kind::kModel || sampler->model().Takes(kRootPath); }
  bool TakesVelocityFactors() const {
    return kind == Kind::kModel && sampler->model().Takes(kVelocityFactors);
  }
  /// Takes from a request what this method is not told, and what it does without.
  void Restrict(TransitionRequest* request) const {
    if (!keys) request->target.reset();
    if (finished) return;
    request->arrival_frames = 0;
    request->footwork = false;
  }
};

/// What one evaluation does alike in all its rows.
struct EvalOptions {
  std::vector<int> lengths{kComparedFrames.begin(),
                           kComparedFrames.end()};  ///< frames of the transitions
  int windows_per_clip = 8;
  int best_of = 10;  ///< samples a window, of which the nearest counts
  float temperature = 0;
  bool own_temperatures = false;  ///< each method's own instead, where a table says so
  int long_seeds = 50;            ///< long dances of each kind; 0: none
  int long_frames = kMaxTransitionFrames;
  int free_dances = 20;  ///< without keys, of the table of liveliness; 0: none
};

/// One set, and who dances beside it. Nothing is owned.
struct Evaluation {
  const ClipSet& set;
  const std::vector<Method>& methods;  ///< the judged one, a model, is last
  const EvalOptions& options;
  const Runner& runner;
  const MotionEncoder* encoder = nullptr;  ///< of EvaluateEncoded
  const ClipSet* training = nullptr;       ///< the set's clips that train, or null

  const Method& judged() const { return methods.back(); }
  const ModelInfo& model() const { return judged().sampler->model(); }
  /// What a method is danced at where tables compare models as they are served.
  float TemperatureOf(const Method& method) const {
    return options.own_temperatures && method.kind == Method::Kind::kModel
               ? static_cast<float>(method.sampler->model().default_temperature)
               : options.temperature;
  }

  /// An empty table of this set; one of a method's own is called after it, but for the judged one.
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

// Each of these plans inputs, has the runner dance them, and returns tables of what came of it:
// none where there is nothing to say of this set or model. All are deterministic.

/// Transitions between real poses (paper F, Table 2 and the key columns of Table 1). Methods have
/// one temperature, the same windows, music, seeds and post-processing.
///   transitions_SET  every method: distances to the real dance and the field's metrics
///   keys_SET         every method: how far it misses keys, raw and as served
std::vector<Table> EvaluateTransitions(const Evaluation& evaluation);

/// liveliness_l2p_SET of every judged method: L2P over interpolation's at temperature 0, at the
/// served one, and of the best of EvalOptions::best_of samples there.
std::vector<Table> EvaluateNearness(const Evaluation& evaluation);

/// Whether a dance lives, beside real motion, of every judged method:
///   liveliness_SET      a figure a row. Through the clips' own poses each 2 s: lively_figures.h,
///                       how far seeds and songs part, hits on beats that it was told of, Frechet
///                       distances, the critic. Without keys: long_figures.h.
///   weight_SET          weight_table.h, with keys and without
///   liveliness_bands_SET  how fast joints go in each band of frequency
/// Everything is danced as it is served. Figures named "÷ real" are the sum over dances over the
/// same of the clips. No rows of keyed dances where no clip has 20 s.
std::vector<Table> EvaluateLiveliness(const Evaluation& evaluation);

/// liveliness_styles_SET: how often a classifier that learnt the styles of the set's training clips
/// (metrics/style_classifier.h) tells the style that dances without keys were asked for.
std::vector<Table> EvaluateStyles(const Evaluation& evaluation);

/// Long dances of the judged method beside the clips:
///   long_SET       with keys each 2 s and without: drift, freezing, explosion, limbs, keys
///   beats_SET      kinematic beats on music beats, against the same dances scored on the set's
///                  other songs (chance); keys at equal intervals and on beats (paper F, Table 4).
///                  Sets with music alone
std::vector<Table> EvaluateLongDances(const Evaluation& evaluation);

/// encoder_SET: paper F's Table 1 (Sections 4.5.2 and 4.5.4) in the codes of Evaluation::encoder,
/// of dances of 10 s: FID, variability (MeanApart of 15 seeds of one input, mean over inputs) and
/// diversity (MeanApart over inputs). Codes are in units of their standard deviation in training:
/// two windows of it, drawn at random, are 64 apart. Of blocks of 5 s of real motion all rows are
/// compared with the even ones; the odd ones are its own row.
std::vector<Table> EvaluateEncoded(const Evaluation& evaluation);

/// stress_SET: paper F, Section 5.2, where its model failed: onto a lying pose in 30 frames and
/// fewer, and onto a key that is almost the pose that the dancer has. Would the stream warn
/// (RequiredSpeed::TooFast), does the dancer freeze, how hard is the way.
std::vector<Table> EvaluateStress(const Evaluation& evaluation);

/// Transitions that follow the real dance's root path and velocity factors (paper C, Section 4);
/// of models that take them, as all that follow. Methods that take none stand beside it without.
///   lrp_SET, avf_SET, art_SET  its Tables 2-4 at 10, 50, 100 and 150 frames: real motion,
///                              interpolation along the path, each network alone and as served
///                              (arrival, footwork), and without keys
///   lrp_ratio_SET, lrp_turned_SET, control_skate_SET, tremor_SET  of the same dances
std::vector<Table> EvaluateControls(const Evaluation& evaluation);

/// How the speed of each part follows its velocity factors, on the real path between real poses:
///   multipliers_SET  the real dance's factors times 0.5, 1 and 1.5, over that dance's speeds
///   constant_SET     the model's first reference times 0.5, 1 and 1.5 in every frame, over that
///                    reference
/// Means over windows and frames. Who takes no factors has one row in each.
std::vector<Table> EvaluateMultipliers(const Evaluation& evaluation);

/// repetition_SET, at 100 to 250 frames: how much of a dance repeats itself, how much of its ending
/// holds still.
std::vector<Table> EvaluateRepetition(const Evaluation& evaluation);

/// drawn_SET: root paths that nobody danced, between real poses: straight on at constant speed, on
/// the spot (the key is moved there), and a bow; beside the real ones. No velocity factors are
/// asked for. Of the ways with keys that take a path: how much feet skate, how well key and path
/// are met.
std::vector<Table> EvaluateDrawnPaths(const Evaluation& evaluation);

}  // namespace choreo
