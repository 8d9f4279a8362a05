#include "model/dance/timeline/validation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/core/error.h"
#include "model/core/hit.h"
#include "model/core/range.h"
#include "model/dance/timeline/timeline.h"

namespace choreo {

int64_t CheckedIn(int64_t value, int64_t least, int64_t most, const std::string& field) {
  if (value >= least && value <= most) return value;
  throw InvalidArgument(field, std::to_string(value) + " is not in [" + std::to_string(least) +
                                   ", " + std::to_string(most) + "]");
}

void CheckKeyId(const std::string& id, const std::string& field) {
  if (!id.empty() && id.size() <= kMaxIdLength) return;
  throw InvalidArgument(field, "has " + std::to_string(id.size()) + " bytes, not 1 to " +
                                   std::to_string(kMaxIdLength));
}

void CheckMask(const Skeleton& skeleton, const PoseMask& mask, const std::string& field) {
  if (mask.joints.empty()) return;
  if (static_cast<int>(mask.joints.size()) != skeleton.joints()) {
    throw InvalidArgument(field + ".joints", std::to_string(mask.joints.size()) +
                                                 " joints, the model has " +
                                                 std::to_string(skeleton.joints()));
  }
  if (!mask.root_position && std::ranges::count(mask.joints, true) == 0) {
    throw InvalidArgument(field, "requests nothing");
  }
}

void CheckFrames(std::span<const int64_t> frames, const std::string& field) {
  for (size_t i = 0; i < frames.size(); ++i) {
    CheckedIn(frames[i], 0, kMaxDanceFrames, At(field, static_cast<int64_t>(i)));
    if (i > 0 && frames[i] <= frames[i - 1]) {
      throw InvalidArgument(At(field, static_cast<int64_t>(i)),
                            std::to_string(frames[i]) + " is not after the frame before it, " +
                                std::to_string(frames[i - 1]));
    }
  }
}

void CheckHit(std::optional<double> hit, const std::string& field) {
  if (hit) Range{0, kMaxHit}.Check(*hit, field);
}

namespace {

void CheckReached(const Continuation& continuation, const std::string& field) {
  CheckedIn(static_cast<int64_t>(continuation.reached.size()), 0, kMaxKeys, field);
  int64_t earliest = 0;
  for (size_t i = 0; i < continuation.reached.size(); ++i) {
    const KeyReached& key = continuation.reached[i];
    const std::string at = At(field, static_cast<int64_t>(i));
    CheckKeyId(key.id, at + ".id");
    CheckedIn(key.frame, earliest, continuation.frame - 1, at + ".frame");
    earliest = key.frame + 1;
    for (const double figure :
         {key.raw_error_m, key.final_error_m, key.final_error_deg, key.correction_m}) {
      if (!(std::isfinite(figure) && figure >= 0))
        throw InvalidArgument(at, "has a figure of " + Show(figure) + ", not of a finite size");
    }
  }
}

}  // namespace

void CheckContinuation(const ModelInfo& model, const Continuation& continuation, bool allow_inexact,
                       const std::string& field) {
  // One more than the last frame, because a key may be in the last frame, and the dance ends after
  // it.
  CheckedIn(continuation.frame, 0, kMaxDanceFrames + 1, field + ".frame");
  if (static_cast<int>(continuation.poses.size()) != model.history_frames) {
    throw InvalidArgument(field + ".poses", std::to_string(continuation.poses.size()) +
                                                " poses, the model needs " +
                                                std::to_string(model.history_frames));
  }
  CheckHistory(model.skeleton, continuation.poses, field + ".poses");
  if (continuation.audio_from_sample.value_or(0) < 0) {
    throw InvalidArgument(
        field + ".audio_from_sample",
        std::to_string(*continuation.audio_from_sample) + " is before the first sample, 0");
  }
  if (continuation.last_beat) {
    // Beats may be after the music's end, as far as the last transition reached.
    const double longest = kMaxDanceFrames / model.fps;
    if (!(*continuation.last_beat >= 0 && *continuation.last_beat <= longest)) {
      throw InvalidArgument(field + ".last_beat", Show(*continuation.last_beat) +
                                                      " s is not in [0, " + Show(longest) + "]");
    }
  }
  if (continuation.stage) {
    const auto& [middle, front] = *continuation.stage;
    for (const double value : middle) {
      if (std::abs(value) <= kMaxPosition) continue;  // false for NaN, too
      throw InvalidArgument(field + ".stage", Show(value) + " m is not within " +
                                                  Show(kMaxPosition) + " m of the origin");
    }
    if (!(std::abs(front) <= 2 * std::numbers::pi)) {
      throw InvalidArgument(field + ".front", Show(front) + " radians are not within a turn of +Z");
    }
  }
  CheckReached(continuation, field + ".reached");
  if (continuation.fingerprint == model.fingerprint) return;
  if (continuation.fingerprint.size() > kMaxFingerprintLength) {
    throw InvalidArgument(field + ".fingerprint",
                          "has " + std::to_string(continuation.fingerprint.size()) +
                              " bytes, at most " + std::to_string(kMaxFingerprintLength));
  }
  if (allow_inexact) return;
  throw Error(ErrorCode::kFailedPrecondition, field + ".fingerprint",
              "\"" + continuation.fingerprint + "\" is not this server's, \"" + model.fingerprint +
                  "\": the dance would continue differently, which must be allowed",
              Remedy::kAllowInexact);
}

}  // namespace choreo
