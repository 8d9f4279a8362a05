#include "server/calls/stream_reactor.h"

#include <grpcpp/server_context.h>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "model/audio/music/music_analysis.h"
#include "model/dance/dance_stream.h"
#include "proto/wire/continuation_message.h"
#include "proto/wire/convert.h"
#include "proto/wire/field_path.h"
#include "proto/wire/poses.h"
#include "server/calls/call_session.h"
#include "server/calls/player.h"
#include "server/calls/session_reactor.h"
#include "server/messages/message_error.h"
#include "server/messages/music_file.h"
#include "server/messages/read_message.h"
#include "server/messages/read_request.h"
#include "server/messages/status.h"

namespace choreo {
namespace {

using DanceRequest = v1::StreamDanceRequest;
using DanceResponse = v1::StreamDanceResponse;

/// The longest piece of music handled on a gRPC thread. Longer ones go to the task pool.
constexpr size_t kLongAudioBytes = 64 << 10;

/// The session of a StreamDance. Messages are handled one at a time.
class DanceSession final : public CallSession<DanceResponse, DanceStream>,
                           public DanceSink,
                           public std::enable_shared_from_this<DanceSession> {
 public:
  DanceSession(Serving& serving, Wire* wire, Caller caller)
      : CallSession(serving, wire, "StreamDance", std::move(caller)), file_(serving.file_music) {}

  /// False if the message ends the call.
  bool Read(const grpc::ByteBuffer& bytes, DanceRequest* request) {
    Guard([&] { ReadMessage(bytes, request); });
    return outbox().open();
  }

  /// The pool for a message that takes long to handle; null if the caller's thread can handle it. A
  /// null `request` is the half-close.
  TaskPool* PoolFor(const DanceRequest* request) const {
    const bool ends_music = request == nullptr || request->has_end_of_audio();
    if (ends_music && !file_.empty()) return &serving_.decoding;
    const bool is_long = request && request->audio().data().size() > kLongAudioBytes;
    return is_long ? &serving_.tasks : nullptr;
  }

  void Handle(const DanceRequest& request) {
    Guard([&] {
      Admit();
      Dispatch(request);
    });
  }

  void HandleHalfClose() {
    Guard([&] {
      if (!queue_) throw InvalidArgument("config", "missing: the stream ended without it");
      const auto stream = dance();
      if (!stream) return;
      DecodeFile(*stream);
      wire::WithPaths([&] { stream->HalfClose(); });
    });
  }

  // ---- DanceSink

  void OnFrames(int64_t first_frame, std::span<const Pose> poses,
                std::span<const Contacts> contacts) override {
    CountFrames(poses.size());
    serving_.tally.dance_frames += poses.size();
    DanceResponse response;
    *response.mutable_frames() = wire::ToProto(first_frame, poses, contacts, encoding_);
    outbox().Send(std::move(response));
  }

  void OnEvent(const DanceEvent& event) override {
    if (const auto* key = std::get_if<KeyReached>(&event))
      serving_.tally.QualityOf(queue_->model().name).steered_m.Add(key->correction_m);
    DanceResponse response;
    *response.mutable_event() = wire::ToProto(event, queue_->model().fps);
    outbox().Send(std::move(response));
  }

  void OnContinuation(const Continuation& continuation) override {
    DanceResponse response;
    *response.mutable_continuation() =
        wire::ToProto(continuation, queue_->model().skeleton, seed_, SendsFile());
    outbox().Send(std::move(response));
    if (serving_.calls.ends_at_transitions()) End(ResumeElsewhere());
  }

  void OnSummary(const QualityReport& report) override {
    if (report.support) serving_.tally.QualityOf(queue_->model().name).support.Add(*report.support);
    DanceResponse response;
    v1::DanceSummary* summary = response.mutable_summary();
    *summary->mutable_report() = wire::ToProto(report);
    *summary->mutable_timing() =
        wire::ToProto(TimingOf(static_cast<double>(report.frames) / queue_->model().fps));
    outbox().Send(std::move(response));
    End(grpc::Status::OK);
  }

  void OnError(const Error& error) override { End(error); }

 private:
  void OnSent(const DanceResponse& answer, Clock::time_point queued) override {
    if (!answer.has_frames()) return;
    serving_.tally.sending_lateness_s.Add(
        player_->Record(answer.frames().first_frame(), queued, Clock::now()));
  }

  void Dispatch(const DanceRequest& request) {
    if (request.request_case() == DanceRequest::REQUEST_NOT_SET) {
      throw InvalidArgument("request", "empty; one of its fields must be set");
    }
    if (request.has_config()) return Configure(request.config());
    if (!queue_) throw InvalidArgument("config", "missing: it must be the first message");
    const auto stream = dance();
    if (!stream) return;
    switch (request.request_case()) {
      case DanceRequest::kAudio:
        return HandleAudio(*stream, request.audio());
      case DanceRequest::kKeyframe:
        return HandleRepeatable(request, request.keyframe().id(),
                                [&] { HandleKeyframe(*stream, request.keyframe()); });
      case DanceRequest::kRemoveKeyframe:
        return HandleRepeatable(request, request.remove_keyframe().id(),
                                [&] { RemoveKeyframe(*stream, request.remove_keyframe().id()); });
      case DanceRequest::kControls:
        return HandleRepeatable(request, "", [&] {
          const ControlRequest controls = ToControls(request.controls(), "controls");
          wire::WithPaths([&] { stream->SetControls(controls); });
        });
      case DanceRequest::kMusicBeats:
        return HandleRepeatable(request, "", [&] { GiveBeats(*stream, request.music_beats()); });
      case DanceRequest::kMusicPassages:
        return HandleRepeatable(request, "", [&] {
          std::vector<Passage> passages;
          for (const v1::MusicPassage& passage : request.music_passages().passages())
            passages.push_back(wire::FromProto(passage));
          wire::WithPaths([&] { stream->GivePassages(passages); });
        });
      case DanceRequest::kGenerateUntil:
        return wire::WithPaths([&] { stream->GenerateUntil(request.generate_until().frame()); });
      case DanceRequest::kKeyframesComplete:
        return wire::WithPaths([&] { stream->KeysComplete(); });
      case DanceRequest::kEndOfAudio:
        if (!audio_) throw WithoutAudioFormat("end_of_audio");
        DecodeFile(*stream);
        return wire::WithPaths([&] { stream->EndOfAudio(); });
      case DanceRequest::kConfig:
      case DanceRequest::REQUEST_NOT_SET:
        return;  // handled before the switch
    }
  }

  // Handles a message of a repeatable kind. Errors give its index among the accepted messages of
  // that kind.
  void HandleRepeatable(const DanceRequest& request, const std::string& key_id,
                        const auto& handle) {
    int& number = accepted_[request.request_case()];
    try {
      handle();
    } catch (const Error& error) {
      if (error.field().empty()) throw;
      throw MessageError(error, number, key_id);
    }
    ++number;
  }

  void Configure(const v1::DanceConfig& message) {
    if (queue_) throw InvalidArgument("config", "came before; it may come only once");
    const Models::Use found = serving_.models.Find(message.model(), "config.model");
    const ModelInfo& model = found->model();
    const ValidDance config = ToDanceConfig(message, model, Serving::FreshSeed());
    Name(model, config->seed);
    serving_.frames.ReserveDance(this, *found, caller_name());
    if (message.has_continuation() || IsNamedResumed()) NoteResumed(config->FirstFrame());
    queue_ = found;
    encoding_ = message.encoding();
    seed_ = config->seed;
    player_.emplace(config->output_fps);
    music_beats_ = config->music_beats;
    rejects_keys_ = message.reject_invalid_keys();
    if (message.has_audio_format()) audio_ = message.audio_format();
    SendHeader(model, message, *config, config->FirstFrame());
    Adopt(wire::WithPaths(
        [&] { return std::make_shared<DanceStream>(*queue_, config, shared_from_this()); }));
  }

  bool SendsFile() const { return audio_ && audio_->encoding() == v1::AUDIO_ENCODING_FILE; }

  void HandleAudio(DanceStream& stream, const v1::Audio& audio) {
    if (!audio_) throw WithoutAudioFormat("audio");
    if (!SendsFile()) {
      const auto samples = ReadSamples(audio, *audio_);
      return wire::WithPaths([&] { stream.PushAudio(samples, audio.first_sample()); });
    }
    if (file_decoded_) {
      throw Error(ErrorCode::kFailedPrecondition, "audio", "comes after end_of_audio");
    }
    if (audio.first_sample() != static_cast<int64_t>(file_.size())) {
      throw Error(ErrorCode::kOutOfRange, "audio.first_sample",
                  std::to_string(audio.first_sample()) + " is not the byte expected, " +
                      std::to_string(file_.size()));
    }
    file_.Append(audio.data(), "audio.data");
  }

  // Passes the music of a complete file to the stream; does nothing for PCM.
  void DecodeFile(DanceStream& stream) {
    if (!SendsFile() || file_decoded_) return;
    file_decoded_ = true;
    const auto music = DecodedMusic::Of(file_.bytes(), [this] { RequireOpen(); });
    file_.Clear();
    if (!music.notes.empty()) stream.NoteMusicDamaged(music.notes, music.seconds());
    stream.SetMusic(music.Analyse(music_beats_));
    wire::WithPaths([&] { stream.PushAudio(music.mono, 0); });
  }

  static void GiveBeats(DanceStream& stream, const v1::MusicBeats& beats) {
    wire::WithPaths([&] {
      stream.GiveBeats({beats.times().begin(), beats.times().end()},
                       {beats.downbeats().begin(), beats.downbeats().end()},
                       beats.has_confidence() ? std::optional(beats.confidence()) : std::nullopt);
    });
  }

  void HandleKeyframe(DanceStream& stream, const v1::Keyframe& keyframe) {
    std::optional<KeyMoment> when;
    try {
      when = wire::ToMoment(keyframe, "keyframe");
      const Key key = wire::ToKey(keyframe, queue_->model().skeleton, "keyframe");
      wire::WithPaths([&] { stream.SetKey(key, *when); });
    } catch (const Error& error) {
      if (error.code() != ErrorCode::kInvalidArgument) throw;
      Reject(stream, keyframe.id(), when, error);
    }
  }

  void RemoveKeyframe(DanceStream& stream, const std::string& id) {
    try {
      wire::WithPaths([&] { stream.RemoveKey(id); });
    } catch (const Error& error) {
      const bool is_unusable =
          error.code() == ErrorCode::kNotFound || error.code() == ErrorCode::kInvalidArgument;
      if (!is_unusable) throw;
      Reject(stream, id, std::nullopt, error);
    }
  }

  // Rejects an unusable key if the client has requested that; otherwise rethrows. Call inside a
  // catch block.
  void Reject(DanceStream& stream, const std::string& id, const std::optional<KeyMoment>& when,
              const Error& error) {
    if (!rejects_keys_) throw;
    const auto [path, description] = ViolationOf(error);
    stream.RejectKey(id, when, path, description);
  }

  // The configuration sets the members below, before the stream exists.
  Models::Use queue_;  // keeps the model, even if the server stops serving it
  v1::RotationEncoding encoding_ = v1::ROTATION_ENCODING_UNSPECIFIED;
  uint64_t seed_ = 0;
  std::optional<Player> player_;
  std::optional<v1::AudioFormat> audio_;
  std::vector<double> music_beats_;
  bool rejects_keys_ = false;  // rejects unusable keys instead of ending the call

  // Messages change the members below.
  std::map<DanceRequest::RequestCase, int> accepted_;  // messages of each kind
  MusicFile file_;
  bool file_decoded_ = false;
};

class StreamReactor final
    : public SessionReactor<grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>,
                            DanceResponse, DanceSession> {
 public:
  StreamReactor(Serving& serving, grpc::CallbackServerContext* context)
      : SessionReactor(serving, context) {
    const Outbox<DanceResponse>::Hold hold(session_->outbox());
    Enter([this] { session_->outbox().RequestRead(); });
  }

  void Read() override { StartRead(&bytes_); }

  void OnReadDone(bool ok) override {
    auto hold = std::make_shared<Outbox<DanceResponse>::Hold>(session_->outbox());
    if (ok && !session_->Read(bytes_, &request_)) return;
    TaskPool* pool = session_->PoolFor(ok ? &request_ : nullptr);
    if (pool == nullptr || !session_->outbox().open()) return Process(ok);
    pool->Post([this, ok, session = session_, hold]() mutable {
      Process(ok);
      hold.reset();  // `this` may be destroyed from here on; the session still exists
    });
  }

 private:
  // Requires a hold.
  void Process(bool ok) {
    if (!session_->outbox().open()) return;
    if (!ok) return session_->HandleHalfClose();
    session_->Handle(request_);
    request_.Clear();
    session_->outbox().RequestRead();
  }

  grpc::ByteBuffer bytes_;
  DanceRequest request_;
};

}  // namespace

grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>* MakeStreamReactor(
    Serving& serving, grpc::CallbackServerContext* context) {
  return new StreamReactor(serving, context);
}

}  // namespace choreo
