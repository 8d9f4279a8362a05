#include "client/cli/report/written_dance.h"

#include <algorithm>
#include <cmath>

#include "model/audio/beats/beats.h"
#include "model/core/rounded.h"
#include "model/motion/resample.h"

namespace choreo::cli {
namespace {

int64_t FirstFrameOfFile(const client::Header& header) {
  const double first = static_cast<double>(header.first_frame) * header.fps / header.model_fps;
  return static_cast<int64_t>(std::ceil(first - kOnFrame));
}

ReportKey::InFile Find(const client::Header& header, const Motion& motion,
                       const client::KeyPose& key, int64_t frame) {
  const double place = static_cast<double>(frame) * header.fps / header.model_fps -
                       static_cast<double>(FirstFrameOfFile(header));
  ReportKey::InFile found;
  found.frame =
      std::clamp<int64_t>(std::llround(place), 0, static_cast<int64_t>(motion.frames.size()) - 1);
  found.on_frame = std::abs(place - static_cast<double>(found.frame)) < kOnFrame;
  found.error = ComparePoses(header.skeleton, key.pose,
                             motion.frames[static_cast<size_t>(found.frame)], key.mask);
  return found;
}

}  // namespace

WrittenDance Examine(const client::Header& header, const client::Report& figures,
                     const Motion& motion, const std::vector<client::KeyPose>& keys) {
  WrittenDance dance;
  dance.header = header;
  dance.figures = figures;
  dance.frames = figures.frames;
  dance.fps = header.model_fps;
  dance.file_frames = std::ssize(motion.frames);
  dance.file_fps = motion.fps;
  dance.sketch = SketchOf(motion, figures.frames, header.model_fps);
  dance.faults = FindDanceFaults(header.skeleton, motion, header.model_fps);
  for (const client::KeyPose& key : keys) {
    const auto reached = std::ranges::find(figures.keys, key.id, &client::KeyReached::id);
    if (reached == figures.keys.end() || motion.frames.empty())
      throw Error(ErrorCode::kInternal, key.id, "the dance has no such key pose");
    ReportKey& danced = dance.keys[reached->frame] = {*reached};
    danced.hit = key.hit;
    danced.hands = key.hands;
    danced.in_file = Find(header, motion, key, reached->frame);
  }
  return dance;
}

void MarkHolds(const authoring::DanceKeys& keys, WrittenDance* dance) {
  for (size_t i = 0; i < keys.poses.size(); ++i) {
    for (auto& [frame, key] : dance->keys)
      if (key.id == keys.poses[i].id) key.holds = authoring::HeldKey(keys, i);
  }
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
  for (const auto& [frame, key] : dance.keys) {
    double distance = key.final_error_m;
    double angle = key.final_error_deg;
    if (key.in_file->on_frame) {
      distance = std::max(distance, key.in_file->error.position_m);
      angle = std::max(angle, key.in_file->error.angle_deg);
    }
    if (distance <= client::kMaxKeyError_m && angle <= client::kMaxKeyError_deg) continue;
    throw Error(ErrorCode::kInternal, key.id,
                "was missed by " + Rounded(1000 * distance) + " mm and " + Rounded(angle) +
                    " degrees, more than " + Rounded(1000 * client::kMaxKeyError_m) + " mm or " +
                    Rounded(client::kMaxKeyError_deg) + " degrees");
  }
}

}  // namespace choreo::cli
