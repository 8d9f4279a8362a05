#include "client/cli/asked_controls.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/core/error.h"
#include "model/motion/controls.h"
#include "model/motion/mirror.h"

namespace choreo::cli {
namespace {

using nlohmann::ordered_json;

// A control's member of a report is its option without the dashes.
std::string MemberOf(size_t row) { return std::string(kControls[row].option.substr(2)); }

void Require(bool is_right, const std::string& field) {
  if (!is_right) throw InvalidArgument(field, "is not what a report says there");
}

bool Ascend(const std::vector<int64_t>& frames) {
  return std::ranges::adjacent_find(frames, std::ranges::greater_equal()) == frames.end();
}

/// Lets rows that begin before frame 0 begin there, on the line between its neighbours.
void BeginAtZero(std::vector<int64_t>* frames, const std::vector<std::vector<double>*>& columns) {
  auto gone = std::ranges::lower_bound(*frames, 0) - frames->begin();
  if (gone == 0) return;
  const auto rows = std::ssize(*frames);
  const bool between = gone < rows;
  const bool starts = between && (*frames)[static_cast<size_t>(gone)] == 0;
  if (!starts) --gone;
  const auto row = static_cast<size_t>(gone);
  const double share = starts || !between
                           ? 0
                           : static_cast<double>(-(*frames)[row]) /
                                 static_cast<double>((*frames)[row + 1] - (*frames)[row]);
  for (std::vector<double>* values : columns) {
    const auto width = values->size() / static_cast<size_t>(rows);
    for (size_t i = row * width; share > 0 && i < (row + 1) * width; ++i)
      (*values)[i] += share * ((*values)[i + width] - (*values)[i]);
    values->erase(values->begin(), values->begin() + gone * static_cast<std::ptrdiff_t>(width));
  }
  frames->erase(frames->begin(), frames->begin() + gone);
  frames->front() = 0;
}

std::vector<double> Flat(const std::vector<Eigen::Vector2d>& points) {
  std::vector<double> flat;
  for (const Eigen::Vector2d& point : points) flat.insert(flat.end(), {point.x(), point.y()});
  return flat;
}

std::vector<Eigen::Vector2d> Points(const std::vector<double>& flat) {
  std::vector<Eigen::Vector2d> points;
  for (size_t i = 0; i + 1 < flat.size(); i += 2) points.emplace_back(flat[i], flat[i + 1]);
  return points;
}

struct FieldWriter {
  ordered_json& json;

  void operator()(const char* name, const auto& value) const {
    if (!value.empty()) json[name] = value;
  }
  void operator()(const char* name, const std::vector<Eigen::Vector2d>& points) const {
    (*this)(name, Flat(points));
  }
};

struct FieldReader {
  const ordered_json& json;

  void operator()(const char* name, auto& value) const {
    if (json.contains(name)) json[name].get_to(value);
  }
  void operator()(const char* name, std::vector<Eigen::Vector2d>& points) const {
    std::vector<double> flat;
    (*this)(name, flat);
    if (flat.size() % 2 == 0) points = Points(flat);
  }
};

bool IsWhole(const ControlRequest::RootPath& path) {
  const size_t rows = path.frames.size();
  return rows >= 2 && Ascend(path.frames) && path.points.size() == rows &&
         (path.heights.empty() || path.heights.size() == rows);
}

bool IsWhole(const ControlRequest::VelocityFactors& velocity) {
  const size_t cells =
      std::max<size_t>(1, velocity.frames.size()) * std::max<size_t>(1, velocity.parts.size());
  return Ascend(velocity.frames) && velocity.factors.size() + velocity.speeds.size() == cells &&
         (velocity.factors.empty() || velocity.speeds.empty());
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

}  // namespace

void WriteControls(const ControlRequest& controls, ordered_json* report) {
  ControlRequest::VisitControls(controls, [report](size_t row, const auto& control) {
    if (!control) return;
    ordered_json& json = (*report)[MemberOf(row)] = ordered_json::object();
    control->VisitFields(*control, FieldWriter{json});
  });
}

ControlRequest ReadControls(const ordered_json& report, const std::string& name) {
  ControlRequest controls;
  ControlRequest::VisitControls(controls, [&](size_t row, auto& control) {
    const std::string member = MemberOf(row), field = name + ":" + member;
    if (!report.contains(member)) return;
    Require(report[member].is_object(), field);
    control.emplace();
    try {
      control->VisitFields(*control, FieldReader{report[member]});
    } catch (const nlohmann::json::exception&) {
      Require(false, field);
    }
    Require(IsWhole(*control), field);
  });
  return controls;
}

ControlRequest Delayed(ControlRequest controls, int64_t frames) {
  if (auto& path = controls.root_path) {
    for (int64_t& frame : path->frames) frame += frames;
    std::vector<double> flat = Flat(path->points);
    BeginAtZero(&path->frames, {&flat, &path->heights});
    path->points = Points(flat);
    if (path->frames.size() < 2) path.reset();
  }
  if (auto& velocity = controls.velocity_factors) {
    for (int64_t& frame : velocity->frames) frame += frames;
    BeginAtZero(&velocity->frames, {&velocity->factors, &velocity->speeds});
  }
  return controls;
}

ControlRequest Mirrored(ControlRequest controls) {
  ControlRequest::VisitControls(controls, [](size_t, auto& control) {
    if (control) control->VisitFields(*control, FieldMirror());
  });
  return controls;
}

}  // namespace choreo::cli
