#pragma once

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "client/authoring/fields/control_json.h"
#include "model/motion/controls/control_request.h"
#include "model/motion/controls/controls.h"
#include "model/motion/kinematics/mirror.h"

/// The controls requested for a dance, in its report. Frames are the model's.
namespace choreo::cli {

/// A control's member of a report: its option without the dashes.
inline std::string MemberOf(const ControlRow& row) { return std::string(row.option.substr(2)); }

template <typename Request>
void WriteControls(const Request& controls, nlohmann::ordered_json* report,
                   std::span<const ControlRow> rows = kControls) {
  Request::VisitControls(
      [&](size_t row, const auto& control) {
        if (control) (*report)[MemberOf(rows[row])] = authoring::ControlJson(*control);
      },
      controls);
}

/// Reads the controls in the report called `name`. Throws Error(kInvalidArgument) whose field is
/// NAME:MEMBER.
template <typename Request = ControlRequest>
Request ReadControls(const nlohmann::ordered_json& report, const std::string& name,
                     std::span<const ControlRow> rows = kControls) {
  Request controls;
  Request::VisitControls(
      [&](size_t row, auto& control) {
        const std::string member = MemberOf(rows[row]);
        if (report.contains(member))
          authoring::ReadControlJson(report[member], name + ":" + member, &control.emplace());
      },
      controls);
  return controls;
}

/// Cuts off the rows of a control before frame 0. The last of them moves to frame 0, with values
/// interpolated between it and the next row.
class CutAtZero {
 public:
  explicit CutAtZero(std::vector<int64_t>* frames);

  void operator()(const char* /*name*/, const auto& /*unchanged*/) const {}
  void operator()(const char* /*name*/, std::vector<double>& values) const { Cut(&values); }
  void operator()(const char* /*name*/, std::vector<Eigen::Vector2d>& points) const {
    Cut(&points);
  }

 private:
  template <typename Value>
  void Cut(std::vector<Value>* values) const {
    if (gone_ == 0 && share_ == 0) return;
    const size_t width = values->size() / rows_;
    const auto begin = values->begin() + static_cast<std::ptrdiff_t>(gone_ * width);
    for (size_t i = 0; share_ > 0 && i < width; ++i)
      begin[i] += share_ * (begin[i + width] - begin[i]);
    values->erase(values->begin(), begin);
  }

  size_t rows_, gone_ = 0;
  double share_ = 0;
};

/// The controls of a dance that is delayed by `frames` or, if these are negative, whose beginning
/// is cut off.
template <typename Request>
Request Delayed(Request controls, int64_t frames) {
  Request::VisitControls(
      [frames](size_t, auto& control) {
        if (!control) return;
        for (int64_t& frame : control->frames) frame += frames;
        control->VisitFields(*control, CutAtZero(&control->frames));
        if (!control->IsWhole()) control.reset();
      },
      controls);
  return controls;
}

struct FieldMirror {
  void operator()(const char* /*name*/, const auto& /*unchanged*/) const {}
  void operator()(const char* /*name*/, std::vector<Eigen::Vector2d>& points) const {
    for (Eigen::Vector2d& point : points) point.x() = -point.x();
  }
  void operator()(const char* /*name*/, std::vector<std::string>& parts) const {
    for (std::string& part : parts) part = OtherSide(part);
  }
};

/// The controls of a dance mirrored in the plane x = 0.
template <typename Request>
Request Mirrored(Request controls) {
  Request::VisitControls(
      [](size_t, auto& control) {
        if (control) control->VisitFields(*control, FieldMirror());
      },
      controls);
  return controls;
}

}  // namespace choreo::cli
