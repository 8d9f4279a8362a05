#include "server/calls/transition_reactor.h"

#include <grpcpp/server_context.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/audio/music/music_analysis.h"
#include "model/dance/transition_group.h"
#include "proto/wire/continuation_message.h"
#include "proto/wire/convert.h"
#include "proto/wire/field_path.h"
#include "server/calls/call_session.h"
#include "server/calls/session_reactor.h"
#include "server/messages/music_file.h"
#include "server/messages/read_message.h"
#include "server/messages/read_request.h"

namespace choreo {
namespace {

/// The session of a GenerateTransition.
class TransitionSession final : public CallSession<v1::GenerateTransitionResponse, TransitionGroup>,
                                public GroupSink,
                                public std::enable_shared_from_this<TransitionSession> {
 public:
  TransitionSession(Serving& serving, Wire* wire, Caller caller)
      : CallSession(serving, wire, "GenerateTransition", std::move(caller)) {}

  /// Reads and processes the music, which takes long. Files go to the decoding pool. The call lasts
  /// at least as long as `hold`, so there are never more waiting files than calls.
  void Start(const grpc::ByteBuffer& bytes,
             std::shared_ptr<Outbox<v1::GenerateTransitionResponse>::Hold> hold) {
    Guard([&] {
      v1::GenerateTransitionRequest message;
      ReadMessage(bytes, &message);
      if (!message.has_config()) throw InvalidArgument("config", "missing");
      queue_ = serving_.models.Find(message.config().model(), "config.model");
      // Checks before decoding, so that an invalid request costs no decoding.
      ValidGroup request =
          ToGroupRequest(message, queue_->model(), Serving::FreshSeed(), serving_.max_candidates);
      Name(queue_->model(), request->seed);
      serving_.frames.ReserveTransition(this, *queue_, caller_name(),
                                        request->candidates * request->frames);
      if (message.config().audio_format().encoding() != v1::AUDIO_ENCODING_FILE) {
        return Begin(message, std::move(request));
      }
      serving_.decoding.Post([session = shared_from_this(), hold = std::move(hold),
                              message = std::move(message),
                              request = std::move(request)]() mutable {
        session->Guard([&] {
          session->AddMusic(message.audio(), &request);
          session->Begin(message, std::move(request));
        });
        hold.reset();
      });
    });
  }

  // ---- GroupSink

  void OnFrames(int candidate, int64_t first_frame, std::span<const Pose> poses,
                std::span<const Contacts> contacts) override {
    CountFrames(poses.size());
    v1::GenerateTransitionResponse response;
    v1::Frames* frames = response.mutable_frames();
    *frames = wire::ToProto(first_frame, poses, contacts, encoding_);
    frames->set_candidate(static_cast<uint32_t>(candidate));
    outbox().Send(std::move(response));
  }

  void OnWarning(const Warning& warning) override {
    v1::GenerateTransitionResponse response;
    *response.mutable_event() = wire::ToProto(warning, queue_->model().fps);
    outbox().Send(std::move(response));
  }

  void OnDone(std::span<const CandidateReport> ranked) override {
    v1::GenerateTransitionResponse response;
    v1::TransitionSummary* summary = response.mutable_summary();
    int64_t frames = 0;
    Tally::Quality& of_model = serving_.tally.QualityOf(queue_->model().name);
    for (const CandidateReport& report : ranked) {
      v1::Candidate* candidate = summary->add_candidates();
      candidate->set_candidate(static_cast<uint32_t>(report.candidate));
      *candidate->mutable_report() = wire::ToProto(report.quality);
      *candidate->mutable_continuation() =
          wire::ToProto(report.continuation, queue_->model().skeleton, seed_, sends_file_);
      frames += report.quality.frames;
      if (report.quality.support) of_model.support.Add(*report.quality.support);
      for (const KeyReached& key : report.quality.keys) of_model.steered_m.Add(key.correction_m);
    }
    *summary->mutable_timing() =
        wire::ToProto(TimingOf(static_cast<double>(frames) / queue_->model().fps));
    outbox().Send(std::move(response));
    End(grpc::Status::OK);
  }

  void OnError(const Error& error) override { End(error); }

 private:
  // Adds a file's samples, and the beats and passages if the client gave none.
  void AddMusic(const v1::Audio& audio, ValidGroup* request) {
    RequireOpen();
    auto file = DecodedMusic::Of(std::as_bytes(std::span(audio.data())), [this] { RequireOpen(); });
    if (!file.notes.empty())
      music_damaged_ = MusicDamaged(file.notes, file.seconds(), queue_->model().fps);
    MusicAnalysis music = file.Analyse((*request)->music_beats);
    request->SetMusic(std::move(file.mono), std::move(music));
  }

  void Begin(const v1::GenerateTransitionRequest& message, ValidGroup request) {
    const ModelInfo& model = queue_->model();
    RequireOpen();  // does not start if the client has left
    encoding_ = message.config().encoding();
    sends_file_ = message.config().audio_format().encoding() == v1::AUDIO_ENCODING_FILE;
    seed_ = request->seed;

    SendHeader(model, message.config(), *request, request->FirstFrame());
    if (music_damaged_) OnWarning(*music_damaged_);
    Adopt(wire::WithPaths([&] {
      return std::make_shared<TransitionGroup>(*queue_, std::move(request), shared_from_this());
    }));
  }

  // Written before the group exists. Nothing refers to the message, which may be freed before the
  // group.
  Models::Use queue_;  // keeps the model even if the server withdraws it
  v1::RotationEncoding encoding_ = v1::ROTATION_ENCODING_UNSPECIFIED;
  bool sends_file_ = false;
  uint64_t seed_ = 0;
  std::optional<Warning> music_damaged_;
};

class TransitionReactor final
    : public SessionReactor<grpc::ServerWriteReactor<grpc::ByteBuffer>,
                            v1::GenerateTransitionResponse, TransitionSession> {
 public:
  TransitionReactor(Serving& serving, grpc::CallbackServerContext* context,
                    const grpc::ByteBuffer& request)
      : SessionReactor(serving, context) {
    auto hold = std::make_shared<Outbox<v1::GenerateTransitionResponse>::Hold>(session_->outbox());
    Enter([&] {
      session_->Admit();
      serving.tasks.Post([session = session_, hold, &request]() mutable {
        if (session->outbox().open()) session->Start(request, std::move(hold));
        hold.reset();
      });
    });
  }
};

}  // namespace

grpc::ServerWriteReactor<grpc::ByteBuffer>* MakeTransitionReactor(
    Serving& serving, grpc::CallbackServerContext* context, const grpc::ByteBuffer* request) {
  return new TransitionReactor(serving, context, *request);
}

}  // namespace choreo
