#pragma once

#include <grpcpp/channel.h>
#include <grpcpp/client_context.h>

#include <memory>
#include <string>

#include "choreo/v1/choreography.pb.h"
#include "server/server.h"
#include "tests/fuzz/fuzz.h"

/// A server with a fake engine in this process, and calls of any bytes to it. Not thread-safe.
namespace choreo::fuzz {

class RpcServer {
 public:
  RpcServer();

  const std::shared_ptr<grpc::Channel>& channel() const { return channel_; }
  /// Ends the program unless all that calls had comes back within ten seconds.
  void ExpectIdle() const;

 private:
  std::unique_ptr<Server> server_;
  std::shared_ptr<grpc::Channel> channel_;
};

/// One call, written and read as bytes.
class RawStream {
 public:
  /// `method`: "StreamDance".
  RawStream(RpcServer& server, const std::string& method);
  ~RawStream();
  RawStream(const RawStream&) = delete;
  RawStream& operator=(const RawStream&) = delete;

  bool Send(const std::string& bytes);
  /// Reads one answer, parsed as this message; false at the end.
  bool Read(google::protobuf::Message* answer);
  /// Half-closes, reads the rest, and cancels a dance that takes too long. Aborts the program if
  /// the call ends with a status that no input may cause, or does not end at all.
  template <typename Response>
  void Finish() {
    HalfClose();
    Response answer;
    while (Read(&answer)) {
      frames_ += answer.frames().count();
      if (frames_ > kEnough) Cancel();
    }
    CheckEnd();
  }
  void Cancel();

 private:
  static constexpr int64_t kEnough = 2000;  // frames

  void HalfClose();
  void CheckEnd();

  struct Call;
  RpcServer& server_;
  grpc::ClientContext context_;
  std::unique_ptr<Call> call_;
  int64_t frames_ = 0;
  bool cancelled_ = false;
};

/// Poses and music that are as they should be.
v1::Pose GoodPose(double x, float elbow);
std::string GoodMusic(size_t samples);  ///< mono, 16 bits, 22 050 Hz
v1::AudioFormat GoodFormat();

}  // namespace choreo::fuzz
