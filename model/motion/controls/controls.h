#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/motion/controls/velocity_factors.h"
#include "model/motion/kinematics/canonical.h"

/// The table of controls: what a request may set for each frame beside its key, one row per
/// control. Server, engines, networks, training, client and studio iterate over these rows;
/// docs/extending.md says what else a new control needs.
namespace choreo {

/// How a control's numbers change when the scene turns or is mirrored.
enum class ControlSpace {
  kPlace,    ///< x, y, z in metres: turned and mirrored as positions are
  kPerPart,  ///< one per BodyPart: turns change nothing, mirrors swap left and right
  kPlain,    ///< never change
};

/// The network's inputs for a control in each frame (flow/window/window_features.h).
enum class ControlFeatures {
  kOffMean,  ///< for positions: whether requested, whether with a height, and the offset from the
             ///< mean way
  kLevel,    ///< for kBodyParts speeds: EnergyLevel over the training clips' medians, and whether
             ///< each is requested
  kPlain,    ///< the numbers, of order one, and whether each is requested
};

struct ControlRow {
  /// Its name in the API's Controls, errors and `choreo info`; its Control is 1 + the row's number.
  std::string_view name;
  std::string_view label;   ///< for people
  std::string_view option;  ///< of the commands that dance
  ControlSpace space;
  int channels;
  ControlFeatures features;
  double least = -std::numeric_limits<double>::infinity();  ///< of each number
  std::string_view unit = "m";
};

inline constexpr ControlRow kControls[] = {
    {"root_path", "root path", "--path", ControlSpace::kPlace, 3, ControlFeatures::kOffMean},
    {"velocity_factors", "velocity factors", "--velocity", ControlSpace::kPerPart, kBodyParts,
     ControlFeatures::kLevel, 0, "m a frame"},
};

/// Row numbers of the controls.
inline constexpr size_t kRootPath = 0, kVelocityFactors = 1;
static_assert(kControls[kRootPath].name == "root_path" &&
              kControls[kVelocityFactors].name == "velocity_factors");
inline constexpr int kPathHeight = 1;  ///< the height's channel in a root path

/// The row with this name, which must exist.
size_t FindControl(std::string_view name);
/// The names of all controls, for models that support them all.
std::vector<std::string> ControlNames();

/// One control over frames.
struct ControlCurve {
  Eigen::MatrixXd values = {};       ///< [channels, frames], or empty: nothing is requested
  std::vector<bool> requested = {};  ///< by channel: whether requested; otherwise a guess

  bool IsGiven() const { return values.cols() > 0; }
  bool IsRequested(int channel) const {
    return IsGiven() && requested[static_cast<size_t>(channel)];
  }
};

/// One curve per row of a table. The root path: where the root should be in each frame, from the
/// history's last root to the target's (dance/controls/path_lead.h bends it there); its heights may
/// be a guess. Velocity factors: the speed of each part (motion/controls/velocity_factors.h); parts
/// not requested have the model's reference or are unknown. The model chooses what is left empty.
class Controls {
 public:
  Controls() : Controls(kControls) {}
  /// `rows` must outlive it. Throws Error(kInvalidArgument), naming the row, if its channels do not
  /// fit its space or features.
  explicit Controls(std::span<const ControlRow> rows);

  std::span<const ControlRow> rows() const { return rows_; }
  ControlCurve& operator[](size_t row) { return curves_[row]; }
  const ControlCurve& operator[](size_t row) const { return curves_[row]; }

  /// Throws Error(kInvalidArgument), field "controls.NAME", for a control that is not in `taken`
  /// (the message names `model`), has a wrong number of channels or not `frames` frames, or has
  /// values that are not finite or below the least.
  void Check(std::span<const std::string> taken, const std::string& model, int frames) const;

  /// The controls of frames [from, from + count) alone.
  Controls Part(int from, int count) const;
  /// Converts to the floor frame `ground`, which is given in the present one.
  void ToLocal(const GroundFrame& ground);
  /// Exchanges left and right.
  void Mirror();

 private:
  std::span<const ControlRow> rows_;
  std::vector<ControlCurve> curves_;
};

}  // namespace choreo
