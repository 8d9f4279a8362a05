#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/motion/controls/control_request.h"
#include "model/motion/controls/controls.h"

/// A control that the API does not have, written as docs/extending.md says: where the dancer looks.
namespace choreo::toy {

struct Gaze {
  std::vector<int64_t> frames = {};
  std::vector<double> values = {};  ///< [rows, 3] places

  static void VisitFields(auto& gaze, const auto& visit) {
    visit("frames", gaze.frames);
    visit("values", gaze.values);
  }
  bool IsWhole() const { return values.size() == 3 * std::max<size_t>(1, frames.size()); }
};

inline constexpr size_t kGaze = 2;
inline constexpr std::array<ControlRow, 3> kRows = {
    kControls[kRootPath],
    kControls[kVelocityFactors],
    {"gaze", "gaze", "--gaze", ControlSpace::kPlace, 3, ControlFeatures::kPlain}};

template <template <typename Request> typename Of>
struct EachControl : choreo::EachControl<Of> {
  Of<Gaze> gaze = {};

  static void VisitControls(const auto& visit, auto&... each) {
    choreo::EachControl<Of>::VisitControls(visit, each...);
    visit(kGaze, each.gaze...);
  }
};
using ControlRequest = EachControl<std::optional>;

}  // namespace choreo::toy
