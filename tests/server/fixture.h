#pragma once

#include <grpcpp/channel.h>
#include <grpcpp/client_context.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "choreo/v1/choreography.grpc.pb.h"
#include "google/rpc/error_details.pb.h"
#include "server/server.h"
#include "tests/support/advanced_clock.h"
#include "tests/support/fake_sampler.h"

namespace choreo {

/// What a test sees and does of a model that the server owns.
struct EngineProbe {
  std::atomic<int64_t> frames = 0;
  /// While it is closed, no frame is made.
  void Close() { closed_ = true; }
  void Open() {
    closed_ = false;
    closed_.notify_all();
  }
  void Pass() const { closed_.wait(true); }

 private:
  std::atomic<bool> closed_ = false;
};

/// A FakeSampler that records its calls, and can be held.
class ProbedSampler final : public FakeSampler {
 public:
  ProbedSampler(std::string name, std::shared_ptr<EngineProbe> probe);
  void OnFrame(const TransitionSpec& spec, Plan* plan) override;

 private:
  const std::shared_ptr<EngineProbe> probe_;
};

/// All that came back from a call.
struct Answer {
  std::optional<v1::Header> header;
  std::vector<v1::Frames> frames;  ///< as the messages had them
  std::vector<v1::Event> events;
  std::vector<v1::Continuation> continuations;
  std::optional<v1::DanceSummary> summary;
  std::optional<v1::TransitionSummary> transition_summary;
  grpc::Status status;

  /// Numbers of a candidate's frames, joined; also checks that they come without gaps, from the
  /// first one on.
  struct Joined {
    int64_t first_frame = 0;
    int64_t count = 0;
    std::vector<float> root_positions, rotations, contacts;
    bool operator==(const Joined&) const = default;
  };
  Joined Join(uint32_t candidate = 0) const;
  /// Ids of keys, in the order in which they were reached.
  std::vector<std::string> ReachedKeys() const;

  void Add(const v1::StreamDanceResponse& response);
  void Add(const v1::GenerateTransitionResponse& response);
};

/// A StreamDance, read and written by the test's own thread.
class DanceClient {
 public:
  explicit DanceClient(v1::Choreography::Stub& stub,
                       std::optional<std::chrono::milliseconds> deadline = std::nullopt,
                       const std::map<std::string, std::string>& headers = {});
  ~DanceClient();

  grpc::ClientContext context;

  bool Send(const v1::StreamDanceRequest& request) { return stream_->Write(request); }
  bool Send(const v1::DanceConfig& config);
  bool SendKeyframe(const v1::Keyframe& keyframe);
  bool SendAudio(const std::string& bytes, int64_t first_sample);
  bool SendKeyframesComplete();
  bool SendEndOfAudio();
  bool SendGenerateUntil(int64_t frame);
  void HalfClose();
  /// Cancels and reads to the end.
  const Answer& Cancel();

  /// Reads until this many frames have come in all; false if the stream ended before.
  bool ReadFrames(int64_t count);
  bool ReadHeader();
  bool ReadOne();
  /// Half-closes, unless that was done, and reads all that is left.
  const Answer& Finish();
  const Answer& answer() const { return answer_; }

 private:
  std::unique_ptr<grpc::ClientReaderWriter<v1::StreamDanceRequest, v1::StreamDanceResponse>>
      stream_;
  Answer answer_;
  int64_t frames_ = 0;
  bool half_closed_ = false;
  bool finished_ = false;
};

/// A server and a client of it.
class ServerTest : public ::testing::Test {
 protected:
  ~ServerTest() override;

  /// Starts the server with models of these names, each with so many workers, and connects to it.
  void Start(int workers = 1, std::function<void(ServerConfig&)> change = {},
             const std::vector<std::string>& names = {"fake"});
  /// Starts the server with this model and one worker, and connects to it.
  void StartWith(std::unique_ptr<Sampler> sampler);
  /// Takes over a server that a test has started itself.
  void Connect(std::unique_ptr<Server> started);
  v1::Choreography::Stub& stub();

  static v1::DanceConfig Config(uint64_t seed = 7);
  /// At rest, its root moved over the floor and its left elbow bent.
  static v1::Pose KeyPose(double x, double z, float elbow);
  static v1::Keyframe Key(const std::string& id, int64_t frame, double x = 0.3, double z = 0.4,
                          float elbow = 0.8F);
  /// With a config, a key and the end, what comes of it.
  Answer Dance(const std::vector<v1::StreamDanceRequest>& requests);
  Answer Generate(const v1::GenerateTransitionRequest& request);
  /// Dances to a key at frame 20.
  Answer DanceToAKey();
  /// Starts a dance that waits for more music.
  std::unique_ptr<DanceClient> OpenEndedDance(
      std::optional<std::chrono::milliseconds> deadline = std::nullopt);

  /// Mono 16-bit PCM of a melody with a beat, 22 050 Hz.
  static std::string Music(double seconds);
  static v1::AudioFormat MusicFormat();
  /// A WAV file, mono, 22 050 Hz: of 16-bit samples as Music gives them, or of floats.
  static std::string Wav(const std::string& samples, int bytes_per_sample = 2);

  /// Waits until no call and no transition is in progress.
  void ExpectIdle();

  std::shared_ptr<EngineProbe> probe = std::make_shared<EngineProbe>();
  AdvancedClock clock;  // of the server's limits on clients
  std::unique_ptr<Server> server;
  std::shared_ptr<grpc::Channel> channel;

 private:
  std::unique_ptr<v1::Choreography::Stub> stub_;
};

/// Polls, for things that other threads bring about; fails after ten seconds.
void ExpectEventually(const std::function<bool()>& condition, const std::string& what,
                      std::chrono::seconds limit = std::chrono::seconds(10));

/// Details of a status, as clients read them.
struct Details {
  std::optional<google::rpc::BadRequest> bad_request;
  std::optional<google::rpc::ErrorInfo> error_info;
  std::optional<google::rpc::RetryInfo> retry_info;
};
Details DetailsOf(const grpc::Status& status);

}  // namespace choreo
