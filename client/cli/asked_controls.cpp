#include "client/cli/asked_controls.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "model/core/error.h"
#include "model/motion/mirror.h"

namespace choreo::cli {
namespace {

using nlohmann::ordered_json;

constexpr const char* kPath = "path";
constexpr const char* kVelocity = "velocity";

template <typename Value>
void WriteSome(const char* member, const Value& value, ordered_json* json) {
  if (!value.empty()) (*json)[member] = value;
}

template <typename Value>
void ReadSome(const ordered_json& json, const char* member, Value* value) {
  if (json.contains(member)) json[member].get_to(*value);
}

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

ControlRequest::RootPath ReadPath(const ordered_json& json, const std::string& field) {
  ControlRequest::RootPath path;
  std::vector<double> flat;
  ReadSome(json, "frames", &path.frames);
  ReadSome(json, "points", &flat);
  ReadSome(json, "heights", &path.heights);
  const size_t rows = path.frames.size();
  Require(rows >= 2 && Ascend(path.frames) && flat.size() == 2 * rows &&
              (path.heights.empty() || path.heights.size() == rows),
          field);
  path.points = Points(flat);
  return path;
}

ControlRequest::VelocityFactors ReadVelocity(const ordered_json& json, const std::string& field) {
  ControlRequest::VelocityFactors velocity;
  ReadSome(json, "frames", &velocity.frames);
  ReadSome(json, "parts", &velocity.parts);
  ReadSome(json, "factors", &velocity.factors);
  ReadSome(json, "speeds", &velocity.speeds);
  ReadSome(json, "reference", &velocity.reference);
  const size_t cells =
      std::max<size_t>(1, velocity.frames.size()) * std::max<size_t>(1, velocity.parts.size());
  Require(Ascend(velocity.frames) && velocity.factors.size() + velocity.speeds.size() == cells &&
              (velocity.factors.empty() || velocity.speeds.empty()),
          field);
  return velocity;
}

/// Reads a member, if there is one.
template <typename Read>
auto ReadMember(const ordered_json& report, const char* member, const std::string& name,
                const Read& read) -> std::optional<decltype(read(report, name))> {
  if (!report.contains(member)) return std::nullopt;
  const std::string field = name + ":" + member;
  Require(report[member].is_object(), field);
  try {
    return read(report[member], field);
  } catch (const nlohmann::json::exception&) {
    Require(false, field);
    throw;
  }
}

}  // namespace

void WriteControls(const ControlRequest& controls, ordered_json* report) {
  if (const auto& path = controls.root_path) {
    ordered_json& json = (*report)[kPath] = ordered_json::object();
    WriteSome("frames", path->frames, &json);
    WriteSome("points", Flat(path->points), &json);
    WriteSome("heights", path->heights, &json);
  }
  if (const auto& velocity = controls.velocity_factors) {
    ordered_json& json = (*report)[kVelocity] = ordered_json::object();
    WriteSome("frames", velocity->frames, &json);
    WriteSome("parts", velocity->parts, &json);
    WriteSome("factors", velocity->factors, &json);
    WriteSome("speeds", velocity->speeds, &json);
    WriteSome("reference", velocity->reference, &json);
  }
}

ControlRequest ReadControls(const ordered_json& report, const std::string& name) {
  return {.root_path = ReadMember(report, kPath, name, ReadPath),
          .velocity_factors = ReadMember(report, kVelocity, name, ReadVelocity)};
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
  if (auto& path = controls.root_path)
    for (Eigen::Vector2d& point : path->points) point.x() = -point.x();
  if (auto& velocity = controls.velocity_factors)
    for (std::string& part : velocity->parts) part = OtherSide(part);
  return controls;
}

}  // namespace choreo::cli
