#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <string_view>
#include <thread>

#include "client/choreo_client.h"
#include "client/convert.h"
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

/// The implementation of RemoteDance. Next() runs attempt after attempt until the summary.
struct RemoteDance::Impl {
 public:
  Impl(std::shared_ptr<Replicas> replicas, const DanceConfig& config);
  ~Impl();

  void Send(v1::StreamDanceRequest request);
  void SendMusic(std::string_view bytes);
  int bytes_per_sample() const { return bytes_per_sample_; }
  AudioKind audio_kind() const { return audio_kind_; }
  std::optional<Message> Next();
  void Cancel() noexcept;

 private:
  void Connect();
  void Recover(const grpc::Status& status);
  /// Returns the part of a response for the caller, if any.
  std::optional<Message> Handle(const v1::StreamDanceResponse& response);
  /// Whether a server that restarts the dance would generate other frames, which
  /// Options::allow_inexact_resume does not allow.
  bool IsOtherDance(const v1::Header& header) const;
  Message HandleHeader(const v1::Header& header);
  Message HandleSummary(const v1::DanceSummary& summary);

  std::shared_ptr<Replicas> replicas_;
  Patience patience_;
  AudioKind audio_kind_;
  int bytes_per_sample_;
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
  std::string lost_because_;  // if not empty, the next header is a resumed dance's
  bool complete_ = false;
};

}  // namespace choreo::client
