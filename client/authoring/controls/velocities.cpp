#include "client/authoring/controls/velocities.h"

#include <algorithm>
#include <charconv>
#include <sstream>
#include <string_view>

#include "client/authoring/fields/json_fields.h"

namespace choreo::authoring {
namespace {

constexpr double kMaxFactor = kMaxVelocityFactor;
constexpr double kMaxSpeed = 100 * double{kMaxVelocity};  // centimetres a frame
constexpr std::string_view kCentimetres = "cm";
constexpr double kMetre = 100;  // centimetres

/// The body parts with this name: one, both arms or legs, or all.
std::vector<size_t> PartsOf(std::string_view name) {
  std::vector<size_t> parts;
  for (size_t i = 0; i < kBodyParts; ++i) {
    const std::string_view part = kBodyPartNames[i];
    if (name == "all" || name == part || (name == "arms" && part.ends_with("_arm")) ||
        (name == "legs" && part.ends_with("_leg"))) {
      parts.push_back(i);
    }
  }
  return parts;
}

std::string NoPart() { return "is none of all, arms, legs, " + BodyPartNames(); }

std::string Limits(bool speeds) {
  std::ostringstream text;
  text << (speeds ? "a speed" : "a number") << " from 0 to " << (speeds ? kMaxSpeed : kMaxFactor)
       << (speeds ? " cm a frame" : "");
  return text.str();
}

// Written so that NaN also fails.
bool IsWithinLimits(double value, bool speeds) {
  return value >= 0 && value <= (speeds ? kMaxSpeed : kMaxFactor);
}

/// Collects the requested values, part by part.
class RequestedVelocities {
 public:
  RequestedVelocities(double fps, const Counts& counts) : fps_(fps), counts_(counts) {}

  void Add(const ControlRequest::VelocityFactors& whole) {
    frames_ = whole.frames;
    speeds_ = !whole.speeds.empty();
    const auto& [frames, parts, factors, speeds, reference] = whole;
    const size_t columns = std::max<size_t>(1, parts.size());
    for (size_t part = 0; part < kBodyParts; ++part) {
      const auto named = std::ranges::find(parts, kBodyPartNames[part]);
      if (named == parts.end() && !parts.empty()) continue;
      std::vector<double>& column = values_[part].emplace();
      for (auto i = static_cast<size_t>(named - parts.begin()); i < factors.size() + speeds.size();
           i += columns)
        column.push_back(*speeds_ ? kMetre * speeds[i] : factors[i]);
    }
  }

  /// Adds a source of the form PART=VALUE.
  void AddConstant(const std::string& source) {
    const size_t equals = source.find('=');
    const std::string name = source.substr(0, equals);
    const std::vector<size_t> parts = PartsOf(name);
    if (parts.empty()) throw InvalidArgument("velocity_factors", '"' + name + "\" " + NoPart());
    const std::string text = equals == std::string::npos ? "" : source.substr(equals + 1);
    const bool speeds = text.ends_with(kCentimetres);
    const char* end = text.data() + text.size() - (speeds ? kCentimetres.size() : 0);
    double value = 0;
    const auto [stop, code] = std::from_chars(text.data(), end, value);
    if (code != std::errc() || stop != end || !IsWithinLimits(value, speeds)) {
      throw InvalidArgument("velocity_factors",
                            '"' + source + "\": \"" + text + "\" is not " + Limits(speeds));
    }
    SetUnit(speeds, source);
    for (const size_t part : parts) values_[part] = std::vector{value};
  }

  void AddFile(const std::string& name) {
    if (!frames_.empty()) throw InvalidArgument("velocity_factors", name + " is a second file");
    const nlohmann::json file = ParseJson(ReadText(name, "velocity file"), name);
    CheckFileMembers(file, name, {"factors", "speeds", "about"},
                     "a velocity file has factors or speeds, and perhaps about");
    const bool speeds = file.contains("speeds");
    const std::string list_name = speeds ? "speeds" : "factors";
    if (speeds && file.contains("factors"))
      throw InvalidArgument(name + ":speeds", "cannot be combined with factors");
    SetUnit(speeds, name);
    const nlohmann::json& points = ListIn(file, name, list_name);
    std::array<std::vector<double>, kBodyParts> read;
    for (size_t i = 0; i < points.size(); ++i) {
      const std::string field = name + ":" + list_name + "[" + std::to_string(i) + "]";
      AppendFrame(points[i], field, fps_, counts_, &frames_);
      if (points[i].size() < 2) throw InvalidArgument(field, "names no part of the body");
      for (const auto& [member, value] : points[i].items()) {
        if (member == "time" || member == "frame") continue;
        const std::vector<size_t> parts = PartsOf(member);
        if (parts.empty()) throw InvalidArgument(field + "." + member, NoPart());
        const double number = JsonNumber(value, field + "." + member);
        if (!IsWithinLimits(number, speeds)) {
          throw InvalidArgument(field + "." + member, Shown(value) + " is not " + Limits(speeds));
        }
        for (const size_t part : parts) {
          if (read[part].size() > i)
            throw InvalidArgument(field + "." + member, "names a part twice");
          read[part].push_back(number);
        }
      }
      for (size_t part = 0; part < kBodyParts; ++part) {
        if (read[part].size() == (read[part].empty() ? 0 : i + 1)) continue;
        throw InvalidArgument(field, "each point must name the same parts, and not all name " +
                                         std::string(kBodyPartNames[part]));
      }
    }
    for (size_t part = 0; part < kBodyParts; ++part) {
      if (!read[part].empty()) values_[part] = std::move(read[part]);
    }
  }

  ControlRequest::VelocityFactors Finish(const std::string& reference) const {
    if (*speeds_ && !reference.empty())
      throw InvalidArgument("velocity_factors.reference", "is for multipliers, not for speeds");
    ControlRequest::VelocityFactors velocity;
    velocity.reference = reference;
    velocity.frames = frames_;
    for (size_t part = 0; part < kBodyParts; ++part) {
      if (values_[part]) velocity.parts.emplace_back(kBodyPartNames[part]);
    }
    for (size_t row = 0; row < std::max<size_t>(1, frames_.size()); ++row) {
      for (const auto& values : values_) {
        if (!values) continue;
        const double value = (*values)[values->size() == 1 ? 0 : row];
        if (*speeds_) {
          velocity.speeds.push_back(value / kMetre);
        } else {
          velocity.factors.push_back(value);
        }
      }
    }
    return velocity;
  }

 private:
  void SetUnit(bool speeds, const std::string& source) {
    if (speeds_.value_or(speeds) != speeds)
      throw InvalidArgument("velocity_factors", source + ": multipliers and cm exclude each other");
    speeds_ = speeds;
  }

  const double fps_;
  const Counts& counts_;
  std::optional<bool> speeds_;                                         // false: multipliers
  std::vector<int64_t> frames_;                                        // the file's points
  std::array<std::optional<std::vector<double>>, kBodyParts> values_;  // one, or one per point
};

}  // namespace

bool IsVelocityFile(const std::string& source) { return source.ends_with(".json"); }

ControlRequest::VelocityFactors ReadVelocities(const std::vector<std::string>& sources,
                                               const std::string& reference, double fps,
                                               const Counts& counts,
                                               const ControlRequest::VelocityFactors& usual) {
  RequestedVelocities requested(fps, counts);
  const bool has_points = !usual.frames.empty() && std::ranges::any_of(sources, IsVelocityFile);
  if (usual.IsWhole() && !has_points) requested.Add(usual);
  for (const std::string& source : sources) {
    if (IsVelocityFile(source)) {
      requested.AddFile(source);
    } else {
      requested.AddConstant(source);
    }
  }
  return requested.Finish(reference.empty() ? usual.reference : reference);
}

}  // namespace choreo::authoring
