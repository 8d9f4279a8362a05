#pragma once

#include <spdlog/spdlog.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "choreo/v1/choreography.pb.h"
#include "model/dance/dance_stream.h"
#include "proto/wire/convert.h"
#include "server/caller.h"
#include "server/outbox.h"
#include "server/refusal.h"
#include "server/serving.h"
#include "server/status.h"
#include "server/write_response.h"

namespace choreo {

/// What the sessions of both streaming calls have in common. A session is shared by the reactor
/// and by the worker threads that dance (`Dance` is a DanceStream or a TransitionGroup, whose sink
/// it is); it holds the outbox, the dance, and the clock. Thread-safe but for what is said to
/// belong to the sender of messages.
template <class Response, class Dance>
class CallSession : public Call {
 public:
  using Wire = typename Outbox<Response>::Wire;

  CallSession(Serving& serving, Wire* wire, std::string method, Caller caller)
      : serving_(serving),
        outbox_(wire, serving.outbox_bytes, [this](bool paused) { SetPaused(paused); }),
        method_(std::move(method)),
        caller_(std::move(caller)) {}

  Outbox<Response>& outbox() { return outbox_; }

  void Abort(const Error& error) override {
    Note(RefusalIn(error));
    outbox_.Abort(StatusOf(error));
    CancelDance();
  }

  void Reset() override { outbox_.Reset(); }
  CallProgress progress() const override { return outbox_.progress(); }

  /// What is queued still goes out, then the call ends with this error.
  void Fail(const Error& error) {
    EndIn(error);
    CancelDance();
  }

  /// Before all else: finds out who it is that calls; false where the call ends for it.
  bool Authenticate(std::string_view authorization) {
    const grpc::Status status = serving_.tokens.FindHolder(authorization, &caller_.holder);
    if (status.ok()) return true;
    Note(Refusal::kToken);
    outbox_.Close(status);
    return false;
  }

  /// Whose calls are counted together with it.
  std::string party() const { return caller_.Party(); }

  /// Counts the call as one in progress; with its first message. Throws as CallRegistry::Admit.
  void Admit() {
    if (std::exchange(admitted_, true)) return;
    serving_.calls.Admit(this);
  }

  /// The reactor is done: frees the dance, which holds this session in turn, and counts the call.
  void Release() noexcept {
    CancelDance();
    serving_.frames.GiveBack(this);
    std::optional<Refusal> refusal;
    {
      const std::lock_guard lock(mutex_);
      dance_.reset();
      refusal = refusal_;
    }
    try {
      const grpc::Status status = outbox_.status();
      if (status.ok()) refusal.reset();  // what came behind the end ended nothing
      serving_.tally.Count({.method = method_,
                            .caller = caller_,
                            .status = status,
                            .seconds = Elapsed(),
                            .frames = frames_,
                            .first_frame_s = first_frame_s_,
                            .model = model_,
                            .seed = seed_,
                            .refusal = refusal});
    } catch (const std::bad_alloc&) {  // a missing log line must not end the server
    }
  }

 protected:
  using Clock = std::chrono::steady_clock;

  std::shared_ptr<Dance> dance() const {
    const std::lock_guard lock(mutex_);
    return dance_;
  }

  /// Takes the dance in, unless the call has ended meanwhile: then it is cancelled.
  void Adopt(std::shared_ptr<Dance> dance) {
    {
      const std::lock_guard lock(mutex_);
      if (!ended_) {
        if (paused_) dance->SetPaused(true);  // which was said before it was there
        dance_ = std::move(dance);
        return;
      }
    }
    dance->Cancel();
  }

  /// Runs something that may throw, on behalf of the client.
  template <class Action>
  void Guard(Action action) {
    try {
      action();
    } catch (const Error& error) {
      Fail(error);
    } catch (const std::exception& error) {
      spdlog::error("{} {} stream {}: {}", method_, caller_.peer, caller_.stream_id, error.what());
      Fail(Error(ErrorCode::kInternal, "", error.what()));
    }
  }

  /// For work that takes long: throws Error(kCancelled) once nobody waits for it.
  void RequireOpen() const {
    if (!outbox_.open()) throw Error(ErrorCode::kCancelled, "", "the call is over");
  }

  void SendHeader(const ModelInfo& model, const v1::DanceConfig& message, const DanceStart& config,
                  int64_t first_frame, bool exact_resume) {
    Response response;
    v1::Header* header = response.mutable_header();
    header->set_model(model.name);
    header->set_fingerprint(model.fingerprint);
    *header->mutable_skeleton() = wire::ToProto(model.skeleton);
    header->set_seed(config.seed);
    header->set_temperature(config.temperature ? static_cast<double>(*config.temperature)
                                               : model.default_temperature);
    header->set_frame_rate(config.output_fps);
    header->set_model_frame_rate(model.fps);
    header->set_encoding(message.encoding() == v1::ROTATION_ENCODING_UNSPECIFIED
                             ? v1::ROTATION_ENCODING_AXIS_ANGLE
                             : message.encoding());
    header->set_first_frame(first_frame);
    header->set_latency_frames(DanceStream::LatencyFrames(config, model));
    header->set_exact_resume(exact_resume);
    header->set_free_transition_frames(kUsualFrames);
    header->set_server_version(CHOREO_VERSION);
    outbox_.Send(std::move(response));
  }

  /// What is queued still goes out, then the call ends so. The dance has ended, and what it was
  /// promised is there for whoever comes once its client knows.
  void End(const grpc::Status& status) {
    serving_.frames.GiveBack(this);
    outbox_.Close(status);
  }
  void EndIn(const Error& error) {
    Note(RefusalIn(error));
    try {
      End(StatusOf(error));
    } catch (const std::bad_alloc&) {
      End({grpc::StatusCode::INTERNAL, "no memory"});  // short enough to need none
    }
  }

  /// Its RetryInfo, if any, is from the measured load.
  grpc::Status StatusOf(const Error& error) const {
    return ToStatus(error, serving_.calls.retry_after());
  }

  /// What its line of the log names. Of the sender of messages.
  void Name(const ModelInfo& model, uint64_t seed) {
    model_ = model.name;
    seed_ = seed;
  }

  /// Calls of a sink come one at a time; so do those of the two below.
  void CountFrames(size_t frames) {
    if (frames_ == 0) first_frame_s_ = Elapsed();
    frames_ += static_cast<int64_t>(frames);
  }
  void FillTiming(double danced_s, v1::Timing* timing) const {
    timing->set_first_frame_latency_s(first_frame_s_);
    timing->set_elapsed_s(Elapsed());
    timing->set_real_time_factor(danced_s / Elapsed());
  }

  Serving& serving_;

 private:
  // Why the call is turned away, if it is; the first reason counts.
  void Note(std::optional<Refusal> refusal) {
    const std::lock_guard lock(mutex_);
    if (!refusal_) refusal_ = refusal;
  }

  double Elapsed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  void SetPaused(bool paused) {
    std::shared_ptr<Dance> current;
    {
      const std::lock_guard lock(mutex_);
      paused_ = paused;
      current = dance_;
    }
    if (current) current->SetPaused(paused);
  }

  void CancelDance() {
    std::shared_ptr<Dance> current;
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
      current = dance_;
    }
    if (current) current->Cancel();
  }

  Outbox<Response> outbox_;
  const std::string method_;
  Caller caller_;  // written before the call has entered
  const Clock::time_point start_ = Clock::now();
  bool admitted_ = false;  // of the sender of messages
  // Written by the sender of messages, later by Release.
  std::string model_;
  std::optional<uint64_t> seed_;

  mutable std::mutex mutex_;      // guards the four below
  std::shared_ptr<Dance> dance_;  // null before the configuration and after the call
  bool ended_ = false;
  bool paused_ = false;  // as the outbox wants it, be there a dance or not
  std::optional<Refusal> refusal_;

  std::atomic<int64_t> frames_ = 0;
  std::atomic<double> first_frame_s_ = 0;
};

}  // namespace choreo
