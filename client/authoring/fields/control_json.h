#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/core/error.h"

/// Converts a control's request (model/motion/controls/control_request.h) to and from JSON, for
/// reports and projects. The JSON has the fields of the API's message that are not empty. Points
/// are x, z, x, z, and so on.
namespace choreo::authoring {

struct ControlFieldWriter {
  nlohmann::ordered_json& json;

  void operator()(const char* name, const auto& value) const {
    if (!value.empty()) json[name] = value;
  }
  void operator()(const char* name, const std::vector<Eigen::Vector2d>& points) const {
    std::vector<double> flat;
    for (const Eigen::Vector2d& point : points) flat.insert(flat.end(), {point.x(), point.y()});
    (*this)(name, flat);
  }
};

template <typename Json>
struct ControlFieldReader {
  const Json& json;

  void operator()(const char* name, auto& value) const {
    if (json.contains(name)) json[name].get_to(value);
  }
  void operator()(const char* name, std::vector<Eigen::Vector2d>& points) const {
    std::vector<double> flat;
    (*this)(name, flat);
    if (flat.size() % 2 != 0) return;
    for (size_t i = 0; i < flat.size(); i += 2) points.emplace_back(flat[i], flat[i + 1]);
  }
};

template <typename Control>
nlohmann::ordered_json ControlJson(const Control& control) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  Control::VisitFields(control, ControlFieldWriter{json});
  return json;
}

/// Reads a control. Throws Error(kInvalidArgument, field) unless the control is complete.
template <typename Control, typename Json>
void ReadControlJson(const Json& json, const std::string& field, Control* control) {
  bool is_whole = json.is_object();
  try {
    if (is_whole) Control::VisitFields(*control, ControlFieldReader<Json>{json});
  } catch (const nlohmann::json::exception&) {
    is_whole = false;
  }
  is_whole = is_whole && control->IsWhole() &&
             std::ranges::adjacent_find(control->frames, std::ranges::greater_equal()) ==
                 control->frames.end();
  if (!is_whole) throw InvalidArgument(field, "does not fit the API's message");
}

}  // namespace choreo::authoring
