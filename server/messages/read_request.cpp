#include "server/messages/read_request.h"

#include <algorithm>
#include <utility>

#include "model/audio/signal/format.h"
#include "model/audio/signal/pcm.h"
#include "model/core/error.h"
#include "model/core/joined.h"
#include "model/dance/timeline/validation.h"
#include "proto/wire/continuation_message.h"
#include "proto/wire/control_messages.h"
#include "proto/wire/convert.h"
#include "proto/wire/field_path.h"
#include "proto/wire/poses.h"

namespace choreo {
namespace {

std::vector<Pose> ToHistory(const v1::History& history, const ModelInfo& model) {
  const std::string field = "config.history.poses";
  if (history.poses_size() == 0) throw InvalidArgument(field, "empty; at least 1 pose is needed");
  std::vector<Pose> poses;
  for (int i = 0; i < history.poses_size(); ++i) {
    poses.push_back(wire::ToPose(history.poses(i), model.skeleton, At(field, i)));
  }
  return poses;
}

// Reads the part of the configuration that both RPCs share.
void FillCommon(const v1::DanceConfig& config, const ModelInfo& model, uint64_t fresh_seed,
                DanceStart* out) {
  wire::NumbersPerJoint(config.encoding(), "config.encoding");
  out->output_fps = config.frame_rate() == 0 ? model.fps : config.frame_rate();
  static_cast<DanceManner&>(*out) = wire::MannerOf(config);
  static_cast<KnownMusic&>(*out) = wire::MusicOf(config);
  out->seed = config.has_seed()           ? config.seed()
              : config.has_continuation() ? config.continuation().seed()
                                          : fresh_seed;
  out->allow_inexact_resume = config.allow_inexact_resume();
  if (config.has_history()) {
    out->history = ToHistory(config.history(), model);
    out->first_frame = config.history().first_frame();
  }
  if (config.has_continuation()) {
    out->continuation = wire::FromProto(config.continuation(), model.skeleton, model.history_frames,
                                        "config.continuation");
  }
}

void CheckMusic(const v1::AudioFormat& format) {
  const std::string field = "config.audio_format";
  switch (format.encoding()) {
    case v1::AUDIO_ENCODING_PCM_F32LE:
    case v1::AUDIO_ENCODING_PCM_S16LE:
      if (format.sample_rate() == 0) throw InvalidArgument(field + ".sample_rate", "missing");
      if (format.channels() == 0) throw InvalidArgument(field + ".channels", "missing");
      choreo::CheckAudioFormat(format.sample_rate(),
                               static_cast<int>(std::min<uint32_t>(format.channels(), 1U << 30)),
                               field);
      return;
    case v1::AUDIO_ENCODING_FILE:
      for (const auto& [name, value] :
           {std::pair<std::string, int64_t>{".sample_rate", format.sample_rate()},
            {".channels", format.channels()},
            {".first_sample", format.first_sample()}}) {
        if (value != 0) {
          throw InvalidArgument(field + name, std::to_string(value) + " must be 0 for a file");
        }
      }
      return;
    default:
      throw InvalidArgument(
          field + ".encoding",
          (format.encoding() == v1::AUDIO_ENCODING_UNSPECIFIED
               ? "missing"
               : std::to_string(format.encoding())) +
              std::string("; there are AUDIO_ENCODING_PCM_F32LE, AUDIO_ENCODING_PCM_S16LE, "
                          "AUDIO_ENCODING_FILE"));
  }
}

// DecodeMono converts files to one format, whatever their own is.
DanceStart::Audio SamplesOf(const v1::AudioFormat& format) {
  if (format.encoding() == v1::AUDIO_ENCODING_FILE) return {kModelSampleRate, 1, 0};
  return {static_cast<double>(format.sample_rate()), static_cast<int>(format.channels()),
          format.first_sample()};
}

}  // namespace

ValidDance ToDanceConfig(const v1::DanceConfig& message, const ModelInfo& model,
                         uint64_t fresh_seed) {
  DanceConfig config;
  FillCommon(message, model, fresh_seed, &config);
  if (message.has_frames()) config.end_frame = message.frames();
  if (message.has_generate_until()) config.generate_until = message.generate_until();
  if (message.has_audio_format()) {
    CheckMusic(message.audio_format());
    config.audio = SamplesOf(message.audio_format());
  }
  return wire::WithPaths([&] { return ValidDance(std::move(config), model); });
}

ValidGroup ToGroupRequest(const v1::GenerateTransitionRequest& message, const ModelInfo& model,
                          uint64_t fresh_seed, int max_candidates) {
  if (!message.has_config()) throw InvalidArgument("config", "missing");
  GroupRequest request;
  FillCommon(message.config(), model, fresh_seed, &request);
  if (message.config().has_frames()) {
    throw InvalidArgument("config.frames", "is for StreamDance; GenerateTransition has its own");
  }
  if (message.config().has_generate_until())
    throw InvalidArgument("config.generate_until", "is for StreamDance");
  if (message.config().reject_invalid_keys())
    throw InvalidArgument("config.reject_invalid_keys", "is for StreamDance");
  request.frames = message.frames();
  request.candidates = std::max(
      1, static_cast<int>(CheckedIn(message.candidates(), 0, max_candidates, "candidates")));
  switch (message.rank_by()) {
    case v1::RANK_BY_UNSPECIFIED:
    case v1::RANK_BY_QUALITY:
      break;
    case v1::RANK_BY_LIKELIHOOD:
      request.rank_by = RankBy::kLikelihood;
      break;
    default:
      throw InvalidArgument("rank_by",
                            std::to_string(message.rank_by()) + " is not a RankBy; 0 to 2 are");
  }
  if (message.has_target()) {
    request.target = wire::ToTarget(message.target(),
                                    message.has_target_mask() ? &message.target_mask() : nullptr,
                                    model.skeleton, "target", "target_mask");
  } else if (message.has_target_mask()) {
    throw InvalidArgument("target_mask", "there is no target");
  }
  if (!message.target_id().empty()) {
    if (!message.has_target()) throw InvalidArgument("target_id", "there is no target");
    request.target_id = message.target_id();
  }
  if (message.has_target_hit()) {
    if (!message.has_target()) throw InvalidArgument("target_hit", "there is no target");
    request.hit = message.target_hit();
  }
  std::vector<Pose> after;
  for (int i = 0; i < message.after_size(); ++i) {
    after.push_back(wire::ToPose(message.after(i), model.skeleton, At("after", i)));
  }
  CheckHistory(model.skeleton, after, "after");
  if (!after.empty()) request.after = after.front();
  if (message.has_controls()) request.controls = ToControls(message.controls(), "controls");

  if (message.config().has_audio_format()) {
    const v1::AudioFormat& format = message.config().audio_format();
    CheckMusic(format);
    if (!message.has_audio()) {
      throw InvalidArgument("audio", "missing, though config.audio_format is there");
    }
    if (message.audio().first_sample() != format.first_sample()) {
      throw Error(ErrorCode::kOutOfRange, "audio.first_sample",
                  std::to_string(message.audio().first_sample()) +
                      " is not config.audio_format.first_sample, " +
                      std::to_string(format.first_sample()));
    }
    request.audio = SamplesOf(format);
    if (format.encoding() != v1::AUDIO_ENCODING_FILE) {
      request.samples = ReadSamples(message.audio(), format);
      if (request.samples.empty()) throw InvalidArgument("audio", "has no samples");
    }
  } else if (message.has_audio()) {
    throw WithoutAudioFormat("audio");
  }
  return wire::WithPaths([&] { return ValidGroup(std::move(request), model); });
}

std::vector<float> ReadSamples(const v1::Audio& audio, const v1::AudioFormat& format) {
  return ReadPcm(audio.data(), format.encoding() == v1::AUDIO_ENCODING_PCM_F32LE,
                 static_cast<int>(format.channels()), "audio.data");
}

Error WithoutAudioFormat(const std::string& field) {
  return InvalidArgument(
      field,
      "comes without config.audio_format, which must say before what its bytes are: "
      R"({"audio_format": {"encoding": "AUDIO_ENCODING_FILE"}} for a WAV, FLAC, Ogg or MP3 file, )"
      R"({"audio_format": {"encoding": "AUDIO_ENCODING_PCM_S16LE", "sample_rate": 44100, )"
      R"("channels": 2}} for samples)");
}

ControlRequest ToControls(const v1::Controls& controls, const std::string& field) {
  std::vector<const google::protobuf::FieldDescriptor*> fields;
  controls.GetReflection()->ListFields(controls, &fields);
  if (!fields.empty()) return wire::FromProto(controls, field);
  throw InvalidArgument(
      field, "empty; " + Joined(kControls, &ControlRow::name, " or ") + " must be there");
}

}  // namespace choreo
