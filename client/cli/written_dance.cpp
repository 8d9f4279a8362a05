#include "client/cli/written_dance.h"

#include <algorithm>
#include <cmath>

#include "model/audio/beats.h"
#include "model/core/rounded.h"
#include "model/motion/resample.h"

namespace choreo::cli {
namespace {

int64_t FirstFrameOfFile(const client::Header& header) {
  const double first = static_cast<double>(header.first_frame) * header.fps / header.model_fps;
  return static_cast<int64_t>(std::ceil(first - kOnFrame));
}

WrittenKey Find(const client::Header& header, const Motion& motion, const client::KeyPose& key,
                const client::KeyReached& reached) {
  const double place = static_cast<double>(reached.frame) * header.fps / header.model_fps -
                       static_cast<double>(FirstFrameOfFile(header));
  WrittenKey found{.reached = reached, .hit = key.hit, .hands = key.hands};
  found.frame =
      std::clamp<int64_t>(std::llround(place), 0, static_cast<int64_t>(motion.frames.size()) - 1);
  found.on_frame = std::abs(place - static_cast<double>(found.frame)) < kOnFrame;
  found.error = ComparePoses(header.skeleton, key.pose,
                             motion.frames[static_cast<size_t>(found.frame)], key.mask);
  return found;
}

}  // namespace

WrittenDance Examine(const client::Header& header, const client::Report& report,
                     const Motion& motion, const std::vector<client::KeyPose>& keys) {
  WrittenDance dance{.header = header, .report = report};
  dance.frames = static_cast<int64_t>(motion.frames.size());
  dance.fps = motion.fps;
  dance.sketch = SketchOf(motion, report.frames, header.model_fps);
  for (const client::KeyPose& key : keys) {
    const auto reached =
        std::find_if(report.keys.begin(), report.keys.end(),
                     [&](const client::KeyReached& candidate) { return candidate.id == key.id; });
    if (reached == report.keys.end() || motion.frames.empty())
      throw Error(ErrorCode::kInternal, key.id, "the dance has no such key pose");
    dance.keys.push_back(Find(header, motion, key, *reached));
  }
  return dance;
}

std::optional<double> BeatHitChance(const std::vector<double>& beats, int64_t frames, double fps) {
  if (beats.empty() || frames <= 0) return std::nullopt;
  std::vector<bool> near(static_cast<size_t>(frames), false);
  for (const double beat : beats) {
    const auto first = static_cast<int64_t>(std::ceil(beat * fps - kBeatGap - kOnFrame));
    const auto last = static_cast<int64_t>(std::floor(beat * fps + kBeatGap + kOnFrame));
    for (int64_t frame = std::max<int64_t>(0, first); frame <= std::min(frames - 1, last); ++frame)
      near[static_cast<size_t>(frame)] = true;
  }
  return static_cast<double>(std::count(near.begin(), near.end(), true)) /
         static_cast<double>(frames);
}

void CheckKeys(const WrittenDance& dance) {
  for (const WrittenKey& key : dance.keys) {
    double distance = key.reached.final_error_m;
    double angle = key.reached.final_error_deg;
    if (key.on_frame) {
      distance = std::max(distance, key.error.position_m);
      angle = std::max(angle, key.error.angle_deg);
    }
    if (distance <= client::kMaxKeyError_m && angle <= client::kMaxKeyError_deg) continue;
    throw Error(ErrorCode::kInternal, key.reached.id,
                "was missed by " + Rounded(1000 * distance) + " mm and " + Rounded(angle) +
                    " degrees, more than " + Rounded(1000 * client::kMaxKeyError_m) + " mm or " +
                    Rounded(client::kMaxKeyError_deg) + " degrees");
  }
}

}  // namespace choreo::cli
