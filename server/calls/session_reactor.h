#pragma once

#include <grpc/grpc.h>
#include <grpcpp/server_context.h>
#include <grpcpp/support/status.h>

#include <memory>
#include <string>
#include <utility>

#include "model/core/error.h"
#include "server/calls/call_session.h"
#include "server/connections/caller.h"
#include "server/messages/read_message.h"

namespace choreo {

/// The reactor of a streaming call. Passes gRPC's events to the call's session, which may outlive
/// the reactor. `Grpc`: gRPC's reactor class for this kind of call. Deletes itself.
template <class Grpc, class Response, class Session>
class SessionReactor : public Grpc, public Outbox<Response>::Wire {
 public:
  // ---- Wire

  void Write(const Response* message) override {
    written_ = WriteMessage(*message);
    this->StartWrite(&written_);
  }
  void Finish(const grpc::Status& status) override { Grpc::Finish(status); }
  // TryCancel would send only CANCELLED. This status can carry no details either.
  void Reset(const grpc::Status& status) override {
    grpc_call_cancel_with_status(context_->c_call(),
                                 static_cast<grpc_status_code>(status.error_code()),
                                 status.error_message().c_str(), nullptr);
  }

  // ---- gRPC's reactions

  void OnWriteDone(bool ok) override { session_->outbox().OnWriteDone(ok); }

  void OnCancel() override {
    session_->End(Error(ErrorCode::kCancelled, "", "the client is gone or its deadline passed"),
                  Ending::kAfterCurrent);
  }

  void OnDone() override {
    const std::unique_ptr<SessionReactor> own(this);
    // By now gRPC knows whether the client's connection accepted the status.
    session_->Release(/*lost=*/context_->IsCancelled());
    serving_.calls.Leave(session_.get());
  }

 protected:
  SessionReactor(Serving& serving, grpc::CallbackServerContext* context)
      : serving_(serving),
        session_(std::make_shared<Session>(serving, this, Named(*context))),
        context_(context) {}

  /// Registers the call with the service and runs `begin`. Fails the call if it has no valid token
  /// or the service is full.
  template <class Begin>
  void Enter(Begin begin) {
    if (!session_->Authenticate(HeaderOf(*context_, "authorization"))) return;
    try {
      serving_.calls.Enter(session_, session_->caller_name());
      begin();
    } catch (const Error& error) {
      session_->End(error);
    }
  }

  Serving& serving_;
  const std::shared_ptr<Session> session_;

 private:
  static Caller Named(grpc::CallbackServerContext& context) {
    Caller caller = CallerOf(context);
    caller.stream_id = FreshStreamId();
    context.AddInitialMetadata(kStreamIdHeader, caller.stream_id);
    if (const auto from = HeaderOf(context, kResumedFromHeader); IsStreamId(from)) {
      caller.resumed_from = from;
      context.AddInitialMetadata(kResumedFromHeader, caller.resumed_from);
    }
    return caller;
  }

  grpc::CallbackServerContext* const context_;  // lives until OnDone
  grpc::ByteBuffer written_;
};

}  // namespace choreo
