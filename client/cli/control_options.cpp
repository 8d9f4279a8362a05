#include "client/cli/control_options.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "client/cli/json_fields.h"
#include "client/cli/options.h"

namespace choreo::cli {
namespace {

constexpr double kMaxFactor = 10;

/// The body parts that a name stands for: one, both arms or legs, or all.
std::vector<BodyPart> PartsOf(std::string_view name) {
  std::vector<BodyPart> parts;
  for (int i = 0; i < kBodyParts; ++i) {
    const std::string_view part = kBodyPartNames[static_cast<size_t>(i)];
    if (name == "all" || name == part || (name == "arms" && part.ends_with("_arm")) ||
        (name == "legs" && part.ends_with("_leg"))) {
      parts.push_back(static_cast<BodyPart>(i));
    }
  }
  return parts;
}

client::Controls::VelocityFactors ReadVelocities(const std::vector<std::string>& sources,
                                                 const std::string& reference) {
  std::array<std::optional<double>, kBodyParts> factors;
  for (const std::string& source : sources) {
    const size_t equals = source.find('=');
    const std::vector<BodyPart> parts = PartsOf(source.substr(0, equals));
    if (parts.empty()) {
      throw InvalidArgument("--velocity", '"' + source.substr(0, equals) +
                                              "\" is none of all, arms, "
                                              "legs, " +
                                              BodyPartNames());
    }
    const std::string text = equals == std::string::npos ? "" : source.substr(equals + 1);
    double factor = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), factor);
    // Written so that NaN fails too.
    if (code != std::errc() || end != text.data() + text.size() ||
        !(factor >= 0 && factor <= kMaxFactor)) {
      throw InvalidArgument("--velocity",
                            '"' + source + "\": \"" + text + "\" is not a number from 0 to 10");
    }
    for (const BodyPart part : parts) factors[static_cast<size_t>(part)] = factor;
  }
  client::Controls::VelocityFactors velocity;
  velocity.reference = reference;
  for (int part = 0; part < kBodyParts; ++part) {
    if (!factors[static_cast<size_t>(part)]) continue;
    velocity.parts.emplace_back(kBodyPartNames[static_cast<size_t>(part)]);
    velocity.factors.push_back(*factors[static_cast<size_t>(part)]);
  }
  return velocity;
}

}  // namespace

client::Controls::RootPath ParsePathFile(std::string_view text, const std::string& name,
                                         double fps) {
  const nlohmann::json list = ParseList(text, name, "points");
  if (list.size() < 2) {
    throw InvalidArgument(name + ":points", "has 1 point, a path needs at least 2");
  }
  client::Controls::RootPath path;
  for (size_t i = 0; i < list.size(); ++i) {
    const nlohmann::json& point = list[i];
    const std::string field = name + ":points[" + std::to_string(i) + "]";
    CheckMembers(point, field, {"time", "frame", "x", "y", "z"},
                 "a point has time or frame, x, z and perhaps y");
    const auto coordinate = [&](const char* axis) {
      if (!point.contains(axis)) throw InvalidArgument(field + "." + axis, "is missing");
      return JsonNumber(point[axis], field + "." + axis);
    };
    const Moment moment = ParseMoment(point, field);
    path.frames.push_back(moment.frame.value_or(std::llround(moment.time_s * fps)));
    if (i > 0 && path.frames[i] <= path.frames[i - 1]) {
      throw InvalidArgument(field + (moment.frame ? ".frame" : ".time"),
                            "is frame " + std::to_string(path.frames[i]) +
                                ", not after that of the point before it, " +
                                std::to_string(path.frames[i - 1]));
    }
    path.points.emplace_back(coordinate("x"), coordinate("z"));
    if (point.contains("y") != list[0].contains("y")) {
      throw InvalidArgument(field + ".y", "must be in all points or in none");
    }
    if (point.contains("y")) path.heights.push_back(coordinate("y"));
  }
  return path;
}

void ControlOptions::AddTo(CLI::App& command) {
  command.add_option("--path", path,
                     "JSON file that says where the dancer goes: {\"points\": [{\"time\": 0, "
                     "\"x\": 0, \"z\": 0}, ...]}, seconds and metres; y is the root's height. Keys "
                     "win over it. For models that have this control (`choreo info`).");
  AddRepeated(command, "--velocity", velocities,
              "How lively a part of the body is, as in left_arm=1.5: trunk, left_arm, right_arm, "
              "left_leg, right_leg, arms, legs or all, and a multiplier, 0 to 10, of the "
              "reference. May be given more than once; the last one of a part counts.");
  command.add_option("--velocity-reference", reference,
                     "What --velocity multiplies, of those that `choreo info` lists; default: the "
                     "model's first.");
}

client::Controls ControlOptions::Read(double fps) const {
  client::Controls controls;
  if (!path.empty()) controls.root_path = ParsePathFile(ReadText(path, "path file"), path, fps);
  if (!velocities.empty()) {
    controls.velocity_factors = ReadVelocities(velocities, reference);
  } else if (!reference.empty()) {
    throw InvalidArgument("--velocity-reference", "there is no --velocity");
  }
  return controls;
}

Error ControlOptions::InTermsOf(const Error& error) const {
  // What was sent is one message: controls[0] of a stream, controls of a transition.
  std::string_view field = error.field();
  for (const std::string_view prefix : {"controls[0].", "controls."}) {
    if (!field.starts_with(prefix)) continue;
    field.remove_prefix(prefix.size());
    const std::string message = std::string(error.what()).substr(error.field().size() + 2);
    if (field == "velocity_factors.reference")
      return {error.code(), "--velocity-reference", message};
    if (field.starts_with("velocity_factors")) return {error.code(), "--velocity", message};
    if (!field.starts_with("root_path")) break;
    if (field == "root_path") return {error.code(), "--path", message};
    // root_path.points[3] is a number of the second point.
    const bool two_a_point = field.starts_with("root_path.points[");
    const size_t bracket = field.find('[');
    size_t index = 0;
    if (bracket != std::string_view::npos)
      std::from_chars(field.data() + bracket + 1, field.data() + field.size(), index);
    return {error.code(), path + ":points[" + std::to_string(two_a_point ? index / 2 : index) + "]",
            message};
  }
  return error;
}

}  // namespace choreo::cli
