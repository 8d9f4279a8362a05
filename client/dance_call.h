#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>

#include "choreo/v1/choreography.grpc.pb.h"
#include "client/choreo_client.h"
#include "client/dance_messages.h"
#include "client/delivery_filter.h"
#include "client/journal.h"
#include "client/replicas.h"

namespace choreo::client {

/// One call to one server. Its own thread sends the journal, so that neither the caller nor Read
/// waits for sending. The owner's `mutex` guards the journal. The owner calls NotifyAppended after
/// appending to it.
class Attempt {
 public:
  /// `resumed_from`: the StreamId of the call in which the dance began; empty: this call.
  Attempt(const Replicas& replicas, const v1::StreamDanceRequest& first,
          std::optional<Patience::Clock::time_point> deadline, const std::string& resumed_from,
          Journal* journal, std::mutex* mutex);
  ~Attempt();  ///< ends the call
  Attempt(const Attempt&) = delete;
  Attempt& operator=(const Attempt&) = delete;

  const Replicas::Server& server() const { return server_; }
  /// The call's name in the server's log, known after the first Read. Empty if the server has none.
  std::string StreamId() const;
  /// Waits for the next response. Returns false at the end of the call.
  bool Read(v1::StreamDanceResponse* response) { return stream_->Read(response); }
  /// Returns how the call ended. Call after Read returned false.
  grpc::Status Finish();
  void NotifyAppended() { appended_.notify_one(); }
  void Cancel() { context_.TryCancel(); }

 private:
  void SendLoop(const v1::StreamDanceRequest& first);

  Replicas::Server server_;
  Journal* journal_;
  std::mutex* mutex_;
  std::condition_variable appended_;
  bool stop_ = false;  // guarded by *mutex_
  bool finished_ = false;
  grpc::ClientContext context_;
  std::unique_ptr<grpc::ClientReaderWriter<v1::StreamDanceRequest, v1::StreamDanceResponse>>
      stream_;
  std::thread sender_;
};

/// A dance in the API's own messages. If its server is lost, the dance resumes on the next one, as
/// RemoteDance says. Thread safety as RemoteDance's.
class DanceCall {
 public:
  /// A server's response, or the news that another server continues the dance. That server's header
  /// is left out.
  using Answer = std::variant<v1::StreamDanceResponse, Resumed>;

  /// `config`: its music is absent, 32-bit floats or a file.
  DanceCall(std::shared_ptr<Replicas> replicas, v1::DanceConfig config);
  ~DanceCall();  ///< cancels a dance that has not ended
  DanceCall(const DanceCall&) = delete;
  DanceCall& operator=(const DanceCall&) = delete;

  /// Sends any request but a config. Numbers the samples of music, and splits it.
  void Send(v1::StreamDanceRequest request);
  /// Waits for the next answer, each of which comes once however often the dance resumes. Skips
  /// those that this version does not know. Returns nullopt after the summary, whose report counts
  /// the frames of all servers. Throws Error if a server breaks the protocol, or the dance failed
  /// and cannot be resumed.
  std::optional<Answer> Next();
  /// Ends the dance; a concurrent Next throws Error(kCancelled). Idempotent.
  void Cancel() noexcept;

 private:
  void Connect();
  void Recover(const grpc::Status& status);
  /// Returns what the caller gets of a response, if anything.
  std::optional<Answer> Handle(v1::StreamDanceResponse* response);
  /// Whether a server that restarts the dance would generate other frames, which
  /// Options::allow_inexact_resume does not allow.
  bool IsOtherDance(const v1::Header& header) const;
  void Begin(const v1::Header& header);
  Resumed Resume(const v1::Header& header);
  void HandleContinuation(const v1::Continuation& continuation);
  void HandleSummary(v1::DanceSummary* summary);

  std::shared_ptr<Replicas> replicas_;
  Patience patience_;
  v1::DanceConfig config_;  // used only by Next

  std::mutex
      mutex_;  // guards the members below, and the attempt's lifetime against Cancel and Send
  Journal journal_;
  std::unique_ptr<Attempt> attempt_;
  bool cancelled_ = false;

  // The members below are used only by Next.
  std::optional<Header> header_;
  std::string fingerprint_;  // of the last server that generated frames
  std::string first_stream_id_;
  std::optional<DeliveryFilter> filter_;
  std::string lost_because_;  // the reason for the next Resumed
  bool complete_ = false;
};

/// A dance's own messages, for programs that pass them on. Such a program calls this one's Next
/// instead of the dance's.
DanceCall& CallOf(RemoteDance& dance);

}  // namespace choreo::client
