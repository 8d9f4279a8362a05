#include "model/dance/controls/velocity_track.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "model/core/error.h"
#include "model/core/joined.h"
#include "model/core/rounded.h"
#include "model/dance/timeline/validation.h"

namespace choreo {
namespace {

// The differences between a speed and the requested one that cause no warning: a share, and metres
// per frame.
constexpr double kSpeedTolerance = 0.15, kMinMiss = 0.001;

const VelocityReference* FindReference(const ModelInfo& model, const std::string& name) {
  const auto& references = model.velocity_references;
  const auto found = name.empty() ? references.begin()
                                  : std::ranges::find(references, name, &VelocityReference::name);
  return found == references.end() ? nullptr : &*found;
}

size_t Columns(const VelocityRequest& request) { return std::max<size_t>(1, request.parts.size()); }

bool IsAbsolute(const VelocityRequest& request) { return !request.speeds.empty(); }

const std::vector<double>& ValuesOf(const VelocityRequest& request) {
  return IsAbsolute(request) ? request.speeds : request.factors;
}

void CheckParts(const std::vector<std::string>& parts, const std::string& field) {
  for (size_t i = 0; i < parts.size(); ++i) {
    const std::string at = field + "[" + std::to_string(i) + "]";
    if (!FindBodyPart(parts[i]))
      throw InvalidArgument(at, '"' + parts[i] + "\" is none of " + BodyPartNames());
    if (std::ranges::count(std::span(parts).first(i), parts[i]) > 0)
      throw InvalidArgument(at, parts[i] + " is there twice");
  }
}

bool Names(const VelocityRequest& request, BodyPart part) {
  const std::string_view name = kBodyPartNames[static_cast<size_t>(part)];
  return request.parts.empty() || std::ranges::find(request.parts, name) != request.parts.end();
}

/// The speed that a valid request sets for one of its parts, metres per frame.
float SpeedAt(const VelocityRequest& request, int64_t frame, BodyPart part,
              const ModelInfo& model) {
  const std::vector<std::string>& parts = request.parts;
  const std::string_view name = kBodyPartNames[static_cast<size_t>(part)];
  const auto column =
      parts.empty() ? 0 : static_cast<size_t>(std::ranges::find(parts, name) - parts.begin());
  const std::vector<double>& values = ValuesOf(request);
  const auto value = [&](size_t row) {
    return static_cast<float>(values[row * Columns(request) + column]);
  };
  const RowPlace place = PlaceAmong(request.frames, frame);
  float asked = value(place.row);
  if (place.share > 0) asked += place.share * (value(place.row + 1) - asked);
  if (IsAbsolute(request)) return asked;
  return asked * FindReference(model, request.reference)->speeds[static_cast<size_t>(part)];
}

}  // namespace

void VelocityTrack::Check(const VelocityRequest& request, const ModelInfo& model,
                          const std::string& field) {
  CheckFrames(request.frames, field + ".frames");
  CheckParts(request.parts, field + ".parts");
  const bool absolute = IsAbsolute(request);
  if (absolute && !request.factors.empty())
    throw InvalidArgument(field + ".speeds", "and factors exclude each other");
  const std::string name = field + (absolute ? ".speeds" : ".factors");
  const size_t rows = std::max<size_t>(1, request.frames.size()), columns = Columns(request);
  const std::vector<double>& values = ValuesOf(request);
  if (values.size() != rows * columns) {
    throw InvalidArgument(name, std::to_string(values.size()) +
                                    " values, but rows times columns are " + std::to_string(rows) +
                                    " times " + std::to_string(columns));
  }
  const double limit = absolute ? kMaxVelocity : kMaxVelocityFactor;
  for (size_t i = 0; i < values.size(); ++i) {
    // Written so that NaN fails too.
    if (values[i] >= 0 && values[i] <= limit) continue;
    throw InvalidArgument(
        name + "[" + std::to_string(i) + "]",
        Show(values[i]) + (absolute ? " m a frame" : "") + " is not in [0, " + Show(limit) + "]");
  }
  const std::string& reference = request.reference;
  if (absolute && !reference.empty())
    throw InvalidArgument(field + ".reference",
                          '"' + reference + "\" cannot be combined with speeds, which have none");
  if (!absolute && FindReference(model, reference) == nullptr) {
    const std::string known = Joined(model.velocity_references, &VelocityReference::name);
    throw InvalidArgument(field + ".reference", '"' + reference + "\" is none of the model's, " +
                                                    (known.empty() ? "which has none" : known));
  }
}

void VelocityTrack::Fill(const ModelInfo& model, const std::string& /*key_id*/,
                         TransitionSpec* spec, ControlCurve* curve,
                         std::vector<Warning>* /*warnings*/) const {
  const int64_t first_frame = spec->first_frame;
  if (requests_.empty() || requests_.front().from > first_frame) return;
  curve->values.resize(kBodyParts, spec->frames);
  VelocityRequest usual;
  usual.factors = {1};
  for (int part = 0; part < kBodyParts; ++part) {
    const auto body_part = static_cast<BodyPart>(part);
    const auto latest = std::find_if(requests_.rbegin(), requests_.rend(), [&](const auto& one) {
      return one.from <= first_frame && Names(*one.what, body_part);
    });
    const bool is_requested = latest != requests_.rend();
    curve->requested[static_cast<size_t>(part)] = is_requested;
    const VelocityRequest& asked = is_requested ? *latest->what : usual;
    for (int frame = 0; frame < spec->frames; ++frame)
      curve->values(part, frame) = SpeedAt(asked, first_frame + frame, body_part, model);
  }
}

std::optional<Warning> VelocityTrack::Missed(const QualityReport& report) const {
  if (report.part_speeds.empty()) return std::nullopt;
  std::string misses;
  for (size_t i = 0; i < kBodyParts; ++i) {
    const auto named = [part = static_cast<BodyPart>(i)](const auto& one) {
      return Names(*one.what, part);
    };
    const auto [asked, danced] = report.part_speeds[i];
    const double miss = std::abs(danced - asked);
    if (std::ranges::none_of(requests_, named) || miss <= kMinMiss ||
        miss <= kSpeedTolerance * asked)
      continue;
    misses += (misses.empty() ? "" : ", ") + std::string(kBodyPartNames[i]) + ' ' +
              Rounded(100 * danced) + " instead of " + Rounded(100 * asked);
  }
  if (misses.empty()) return std::nullopt;
  return VelocityNotMet(report.measured_from + report.frames - 1, misses);
}

}  // namespace choreo
