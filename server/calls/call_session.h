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
#include "server/calls/outbox.h"
#include "server/calls/serving.h"
#include "server/connections/caller.h"
#include "server/messages/refusal.h"
#include "server/messages/status.h"

namespace choreo {

/// Base of both streaming calls' sessions: outbox, dance and clock. A session is the sink of its
/// `Dance`, a DanceStream or a TransitionGroup. The reactor and the workers' threads share it.
/// Thread-safe, except for functions restricted to the message thread, which handles the call's
/// messages one at a time.
template <class Response, class Dance>
class CallSession : public Call {
 public:
  using Wire = typename Outbox<Response>::Wire;

  CallSession(Serving& serving, Wire* wire, std::string method, Caller caller)
      : serving_(serving),
        outbox_(
            wire, serving.outbox_bytes, [this](bool paused) { SetPaused(paused); },
            [this](const Response& answer, Clock::time_point queued) { OnSent(answer, queued); },
            serving.calls.time()),
        method_(std::move(method)),
        caller_(std::move(caller)) {}

  Outbox<Response>& outbox() { return outbox_; }

  void End(const Error& error, Ending ending = Ending::kAfterQueued) override try {
    End(StatusOf(error), ending, RefusalIn(error));
  } catch (const std::bad_alloc&) {
    End({grpc::StatusCode::INTERNAL, "no memory"}, ending);  // short enough not to allocate
  }

  // A client may be silent while the workers sample: slow models take minutes for long transitions.
  CallProgress progress() const override {
    CallProgress progress = outbox_.progress();
    const std::shared_ptr<Dance> current = dance();
    if (!progress.unread && current && current->IsSampling())
      progress.since = serving_.calls.time().Now();
    return progress;
  }

  // Waiting answers, including the last continuation, are still sent.
  void EndIfRevoked() override {
    if (!serving_.tokens.IsRevoked(token_)) {
      revoked_since_.reset();
      return;
    }
    const Clock::time_point now = serving_.calls.time().Now();
    if (!revoked_since_) revoked_since_ = now;
    if (!outbox_.open() || now - *revoked_since_ < kRevoking) return;
    End(
        Unauthenticated("its token has been revoked; with another one the dance can resume from "
                        "the last continuation",
                        /*renewable=*/true));
  }

  /// Identifies the caller; call first. Returns false if the token is not valid, which ends the
  /// call.
  bool Authenticate(std::string_view authorization) {
    const grpc::Status status = serving_.tokens.FindHolder(authorization, &caller_.holder, &token_);
    if (status.ok()) return true;
    End(status, Ending::kAfterQueued, Refusal::kToken);
    return false;
  }

  /// The name of the caller to whom this call is counted.
  std::string caller_name() const { return caller_.Name(); }

  /// Counts the call as in progress. Call on the message thread with the first message. Throws what
  /// CallRegistry::Admit throws.
  void Admit() {
    if (std::exchange(admitted_, true)) return;
    serving_.calls.Admit(this);
  }

  /// Call when the reactor is done. Frees the dance, which holds this session, and counts the call.
  /// `lost`: the status was never sent. gRPC first reports a dead connection as a half-close, so
  /// the dance may have finished for nobody.
  void Release(bool lost) noexcept try {
    if (const auto dance = NoteEnd()) dance->Cancel();
    serving_.frames.GiveBack(this);
    {
      const std::lock_guard lock(mutex_);
      dance_.reset();
    }
    grpc::Status status = outbox_.status();
    if (status.ok() && lost)
      status = {grpc::StatusCode::CANCELLED, "the client left before the end of its dance"};
    Count(status);
  } catch (const std::bad_alloc&) {  // loses the log line, but keeps the server
  }

  void GiveUp() noexcept override try {
    Count({grpc::StatusCode::UNAVAILABLE, "the server was told to exit immediately"});
  } catch (const std::bad_alloc&) {
  }

 protected:
  using Clock = std::chrono::steady_clock;

  std::shared_ptr<Dance> dance() const {
    const std::lock_guard lock(mutex_);
    return dance_;
  }

  /// Stores the dance, or cancels it if the call has ended meanwhile.
  void Adopt(std::shared_ptr<Dance> dance) {
    {
      const std::lock_guard lock(mutex_);
      if (!ended_) {
        if (paused_) dance->SetPaused(true);  // requested before the dance existed
        dance_ = std::move(dance);
        return;
      }
    }
    dance->Cancel();
  }

  /// Called, one call at a time, after an answer was sent. `queued`: when it was queued.
  virtual void OnSent(const Response& /*answer*/, Clock::time_point /*queued*/) {}

  /// Runs `action`; ends the call if it throws.
  template <class Action>
  void Guard(Action action) {
    try {
      action();
    } catch (const Error& error) {
      End(error);
    } catch (const std::exception& error) {
      spdlog::error("{} {} stream {}: {}", method_, caller_.peer, caller_.stream_id, error.what());
      End(Error(ErrorCode::kInternal, "", error.what()));
    }
  }

  /// Throws Error(kCancelled) if the call is over. Long-running work calls this.
  void RequireOpen() const {
    if (!outbox_.open()) throw Error(ErrorCode::kCancelled, "", "the call is over");
  }

  void SendHeader(const ModelInfo& model, const v1::DanceConfig& message, const DanceStart& config,
                  int64_t first_frame) {
    Response response;
    *response.mutable_header() = wire::ToProto(
        DanceHeader{.model = model.name,
                    .fingerprint = model.fingerprint,
                    .skeleton = model.skeleton,
                    .seed = config.seed,
                    .temperature = config.temperature.value_or(model.default_temperature),
                    .fps = config.output_fps,
                    .model_fps = model.fps,
                    .first_frame = first_frame,
                    .latency_frames = LatencyFrames(config, model),
                    .exact_resume = !config.ResumesInexactly(model),
                    .free_transition_frames = kTypicalFrames,
                    .server_version = CHOREO_VERSION});
    if (message.encoding() != v1::ROTATION_ENCODING_UNSPECIFIED)
      response.mutable_header()->set_encoding(message.encoding());
    outbox_.Send(std::move(response));
  }

  /// Ends the call with this status, and cancels its dance. Frees the dance's share of the machine
  /// for other calls before the client gets the status. `refusal`: why the call is refused; the
  /// first reason counts.
  void End(const grpc::Status& status, Ending ending = Ending::kAfterQueued,
           std::optional<Refusal> refusal = {}) {
    const std::shared_ptr<Dance> dance = NoteEnd(refusal);
    serving_.frames.GiveBack(this);
    outbox_.End(status, ending);
    if (dance) dance->Cancel();
  }

  /// The gRPC status for an error, including RetryInfo's delay.
  grpc::Status StatusOf(const Error& error) const {
    const std::optional<Refusal> refusal = RefusalIn(error);
    if (!refusal || *refusal == Refusal::kDraining)
      return ToStatus(error, serving_.calls.RetryElsewhere());
    // Calls that ended before tell nothing of how long these transitions last.
    const bool is_busy = *refusal == Refusal::kLoad || *refusal == Refusal::kLoadOfPeer ||
                         *refusal == Refusal::kWaiting;
    return ToStatus(error,
                    serving_.calls.RetryAfter(is_busy ? serving_.frames.SecondsToRoom() : 0));
  }

  /// Names model and seed in the call's log line. Message thread.
  void Name(const ModelInfo& model, uint64_t seed) {
    const std::lock_guard lock(mutex_);
    model_ = model.name;
    seed_ = seed;
  }

  /// Logs and counts a dance that this call resumes. Message thread.
  void NoteResumed(int64_t frame) {
    ++serving_.tally.dances_resumed;
    spdlog::info("{} {} stream {} resumes {} at frame {}", method_, caller_.peer, caller_.stream_id,
                 caller_.resumed_from.empty() ? "a dance" : "stream " + caller_.resumed_from,
                 frame);
  }
  bool IsNamedResumed() const { return !caller_.resumed_from.empty(); }

  /// Only the sink's functions, which run one at a time, may call CountFrames and TimingOf.
  void CountFrames(size_t frames) {
    if (frames_ == 0) first_frame_s_ = Elapsed();
    frames_ += static_cast<int64_t>(frames);
  }
  CallTiming TimingOf(double danced_s) const {
    const double elapsed = Elapsed();
    return {first_frame_s_, elapsed, danced_s / elapsed};
  }

  Serving& serving_;

 private:
  // Counts and logs the call, once.
  void Count(const grpc::Status& status) {
    const std::lock_guard lock(mutex_);
    if (std::exchange(counted_, true)) return;
    serving_.tally.Count({.method = method_,
                          .caller = caller_,
                          .status = status,
                          .seconds = Elapsed(),
                          .frames = frames_,
                          .first_frame_s = first_frame_s_,
                          .model = model_,
                          .seed = seed_,
                          // A refusal after the call's end does not count.
                          .refusal = outbox_.status().ok() ? std::nullopt : refusal_});
  }

  // Records that the call is over, and why. Returns its dance, or null.
  std::shared_ptr<Dance> NoteEnd(std::optional<Refusal> refusal = {}) {
    const std::lock_guard lock(mutex_);
    if (!refusal_) refusal_ = refusal;
    ended_ = true;
    return dance_;
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

  /// How long a token must be missing from the file, which lacks tokens for a moment while it is
  /// rewritten.
  static constexpr std::chrono::seconds kRevoking{2};

  Outbox<Response> outbox_;
  const std::string method_;
  Caller caller_;         // written before the call enters
  Tokens::Hash token_{};  // written before the call enters
  const Clock::time_point start_ = Clock::now();
  bool admitted_ = false;                           // message thread
  std::optional<Clock::time_point> revoked_since_;  // the thread that rereads tokens

  mutable std::mutex mutex_;  // guards the members from model_ to refusal_
  std::string model_;
  std::optional<uint64_t> seed_;
  bool counted_ = false;
  std::shared_ptr<Dance> dance_;  // null before the configuration and after the end
  bool ended_ = false;
  bool paused_ = false;  // requested by the outbox, with or without a dance
  std::optional<Refusal> refusal_;

  std::atomic<int64_t> frames_ = 0;
  std::atomic<double> first_frame_s_ = 0;
};

}  // namespace choreo
