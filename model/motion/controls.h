#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/motion/canonical.h"
#include "model/motion/velocity_factors.h"

/// What may be asked of each frame beside its key, a row a control. Server, engines, networks,
/// training, client and studio walk these rows; docs/extending.md says what a new one needs beside.
namespace choreo {

/// How a control's numbers change with the scene.
enum class ControlSpace {
  kPlace,    ///< x, y, z in metres: turned into the canonical frame, mirrored as a place is
  kPerPart,  ///< one for each BodyPart: no frame changes them, a mirror swaps left and right
  kPlain,    ///< neither changes them
};

/// What a network is told of a control in each frame (flow/window_features.h).
enum class ControlFeatures {
  kOffMean,  ///< of a place: whether it is asked for, its height too, how far the mean way is off
  kLevel,    ///< EnergyLevel over the training clips' medians, and of each whether it is asked for
  kPlain,    ///< the numbers, of order one, and of each whether it is asked for
};

struct ControlRow {
  /// As the API's Controls, errors and `choreo info` call it; its Control is 1 + the row's number.
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

/// Row numbers of single controls.
inline constexpr size_t kRootPath = 0, kVelocityFactors = 1;
inline constexpr int kPathHeight = 1;  ///< the channel of a root path that is its height

/// The row of that name, which is one of them.
size_t FindControl(std::string_view name);
/// The names of all of them: what a model takes that takes each.
std::vector<std::string> ControlNames();

/// One control over frames.
struct ControlCurve {
  Eigen::MatrixXd values = {};   ///< [channels, frames], or empty: nobody asks anything
  std::vector<bool> asked = {};  ///< by channel: it was asked for; otherwise it is a guess

  bool IsGiven() const { return values.cols() > 0; }
  bool Asks(int channel) const { return IsGiven() && asked[static_cast<size_t>(channel)]; }
};

/// A curve for each row of a table. The root's path: where it should be in each frame, from the
/// history's last root to the target's (dance/path_lead.h bends it there); its heights may be a
/// guess. Velocity factors: how lively each part should be (motion/velocity_factors.h); those not
/// asked for are the model's reference, or unknown. The model chooses what is left empty.
class Controls {
 public:
  Controls() : Controls(kControls) {}
  /// `rows` must outlive it.
  explicit Controls(std::span<const ControlRow> rows);

  std::span<const ControlRow> rows() const { return rows_; }
  ControlCurve& operator[](size_t row) { return curves_[row]; }
  const ControlCurve& operator[](size_t row) const { return curves_[row]; }

  /// Throws Error(kInvalidArgument) for what is not one of `taken`, naming `model`, has not as many
  /// channels and `frames` frames as it should, is not finite or less than its least. The field is
  /// "controls.NAME".
  void Check(std::span<const std::string> taken, const std::string& model, int frames) const;

  /// What is asked of the frames [from, from + count).
  Controls Part(int from, int count) const;
  /// The same in another frame of the floor, which stands in this one.
  void ToLocal(const GroundFrame& ground);
  /// The same of a dancer whose left is its right.
  void Mirror();

 private:
  std::span<const ControlRow> rows_;
  std::vector<ControlCurve> curves_;
};

}  // namespace choreo
