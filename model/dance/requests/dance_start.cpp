#include "model/dance/requests/dance_start.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "model/audio/music/feature_stream.h"
#include "model/audio/signal/format.h"
#include "model/core/error.h"
#include "model/core/range.h"
#include "model/dance/input/audio_feed.h"
#include "model/dance/input/dance_music.h"
#include "model/dance/input/recurrence.h"
#include "model/dance/timeline/timeline.h"
#include "model/dance/timeline/validation.h"
#include "model/motion/pose/pose_limits.h"
#include "model/plan/model_info.h"

namespace choreo {
namespace {

void CheckAudioStart(const ModelInfo& model, const DanceStart::Audio& audio, int64_t first_frame) {
  const std::string field = "audio";
  if (!model.takes_music) {
    throw Error(ErrorCode::kUnimplemented, field, "this model does not take music");
  }
  CheckAudioFormat(audio.sample_rate, audio.channels, field);
  const int64_t latest = LatestFirstSample(first_frame, audio.sample_rate, model);
  if (audio.first_sample < 0 || audio.first_sample > latest) {
    throw Error(ErrorCode::kOutOfRange, field + ".first_sample",
                std::to_string(audio.first_sample) + " is not in [0, " + std::to_string(latest) +
                    "], so frame " + std::to_string(first_frame) +
                    " could not hear the music before it");
  }
}

// Throws what the constructors of ValidDance and ValidGroup throw.
void CheckStart(const DanceStart& start, const ModelInfo& model) {
  start.CheckNumbers("");
  CheckStyle(model, start.style);
  CheckBeats(start.music_beats, "music_beats");
  CheckDownbeats(start.music_downbeats, start.music_beats, "music_downbeats");
  CheckPassages(start.music_passages, "music_passages");
  if (start.music_passages.size() > kMaxPassages) {
    throw InvalidArgument("music_passages", std::to_string(start.music_passages.size()) +
                                                " passages, the limit is " +
                                                std::to_string(kMaxPassages));
  }
  CheckEnergies(start.music_energies, "music_energies");
  Range{kMinOutputFps, kMaxOutputFps}.Check(start.output_fps, "output_fps");
  CheckHistory(model.skeleton, start.history, "history");
  if (!start.continuation) {
    CheckedIn(start.first_frame, 0, kMaxDanceFrames, "first_frame");
    return;
  }
  if (!start.history.empty())
    throw InvalidArgument("before", "a history and a continuation exclude each other");
  CheckContinuation(model, *start.continuation, start.allow_inexact_resume, "continuation");
}

}  // namespace

std::vector<Warning> DanceStart::Warnings(const ModelInfo& model) const {
  std::vector<Warning> warnings;
  if (ResumesInexactly(model)) warnings.push_back(InexactResume(*continuation, model));
  if (temperature && *temperature > model.max_temperature)
    warnings.push_back(TemperatureTooHigh(FirstFrame(), *temperature, model.max_temperature));
  return warnings;
}

ValidDance::ValidDance(DanceConfig request, const ModelInfo& model) : Valid(std::move(request)) {
  const DanceConfig& config = **this;
  CheckStart(config, model);
  const int64_t first = config.FirstFrame();
  if (config.end_frame) {
    CheckedIn(first, 0, kMaxDanceFrames, "continuation.frame");  // else there is no such end
    CheckedIn(*config.end_frame, std::max<int64_t>(first, 1), kMaxDanceFrames, "end_frame");
  }
  if (config.generate_until)
    CheckedIn(*config.generate_until, 0, kMaxDanceFrames, "generate_until");
  if (config.audio) {
    CheckAudioStart(model, *config.audio, first);
    if (config.continuation && config.continuation->audio_from_sample &&
        config.audio->first_sample > *config.continuation->audio_from_sample) {
      throw Error(ErrorCode::kOutOfRange, "audio.first_sample",
                  std::to_string(config.audio->first_sample) + " is after " +
                      std::to_string(*config.continuation->audio_from_sample) +
                      ", the first that the continuation needs");
    }
  }
  // A stream is long-lived, and needs only the last poses of a long history.
  std::vector<Pose>& poses = request_.history;
  const auto kept = std::min(std::ssize(poses), std::ptrdiff_t{model.history_frames});
  poses.erase(poses.begin(), poses.end() - kept);
}

ValidGroup::ValidGroup(GroupRequest group, const ModelInfo& model) : Valid(std::move(group)) {
  const GroupRequest& request = **this;
  CheckStart(request, model);
  CheckedIn(request.candidates, 1, kMaxCandidates, "candidates");
  if (request.rank_by == RankBy::kLikelihood && !model.likelihood)
    throw InvalidArgument("rank_by",
                          "\"" + model.name + "\" has no likelihood, only quality is possible");
  CheckedIn(request.frames, 1, std::min(kMaxTransitionFrames, model.max_transition_frames),
            "frames");
  CheckedIn(request.FirstFrame(), 0, kMaxDanceFrames, "continuation.frame");
  if (request.target) {
    CheckKeyPose(model.skeleton, request.target->pose, "target");
    CheckMask(model.skeleton, request.target->mask, "target.mask");
  }
  CheckKeyId(request.target_id, "target_id");
  CheckHit(request.hit, "hit");
  if (request.after) {
    if (!request.target) throw InvalidArgument("after", "needs a target");
    CheckKeyPose(model.skeleton, *request.after, "after");
  }
  CheckControls(request.controls, model, "controls");
  if (!request.audio) {
    if (!request.samples.empty()) throw InvalidArgument("samples", "come without their format");
    return;
  }
  CheckAudioStart(model, *request.audio, request.FirstFrame());
  CheckSamples(request.samples, request.audio->channels, request.audio->first_sample);
}

void ValidGroup::SetMusic(std::vector<float> mono, MusicAnalysis music) {
  request_.samples = std::move(mono);
  if (request_.music_beats.empty()) request_.music_beats = std::move(music.beats);
  if (request_.music_id == 0) request_.music_id = music.id;
  if (request_.music_passages.empty()) request_.music_passages = std::move(music.passages);
  if (request_.music_energies.empty()) request_.music_energies = std::move(music.energies);
}

int64_t LatestFirstSample(int64_t first_frame, double sample_rate, const ModelInfo& model) {
  return FeatureStream::FirstSampleFor(std::max<int64_t>(0, first_frame - model.history_frames),
                                       sample_rate);
}

int LatencyFrames(const DanceStart& config, const ModelInfo& model) {
  double seconds = 0;
  if (config.audio) {
    if (model.music_features) seconds += kTypicalFrames / model.fps;
    const FeatureStream stream(config.audio->sample_rate, config.audio->channels);
    seconds += static_cast<double>(stream.latency_samples()) / kModelSampleRate;
  }
  if (config.output_fps != model.fps) seconds += 1 / model.fps;
  return static_cast<int>(std::ceil(seconds * config.output_fps));
}

int64_t ResumeSample(const DanceStart::Audio& audio, double dynamics, int64_t first_frame,
                     const ModelInfo& model, bool beats) {
  const auto& [rate, channels, first_sample] = audio;
  const int heard = dynamics > 0 ? kSoundMemory : beats ? kBeatMemory : 0;
  if (heard == 0) return LatestFirstSample(first_frame, rate, model);
  const int64_t row = std::max<int64_t>(0, first_frame - heard - kRowSoundMemory);
  return std::max(first_sample, FeatureStream::FirstSampleFor(row, rate));
}

}  // namespace choreo
