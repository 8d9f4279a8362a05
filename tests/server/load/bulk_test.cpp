#include <gtest/gtest.h>

#include <algorithm>
#include <mutex>
#include <thread>

#include "model/samplers/samplers.h"
#include "tests/server/fixture.h"

/// How long calls affect a live dance, with a real server, real clients, real kernels and the
/// shipped checkpoint.
namespace choreo::bulk_test {

constexpr int kBulkFrames = 1'800;
constexpr int kCandidates = 32;
constexpr int kDanceFrames = 24;  // two transitions, within SampleQueue::Options::bulk_yields

/// The order in which a sampler runs its jobs.
struct Log {
  enum class Did { kBulkSlice, kDanceSlice, kDanceEnds };

  void Add(Did did) {
    const std::lock_guard lock(mutex);
    all.push_back(did);
  }
  std::vector<Did> Copy() const {
    const std::lock_guard lock(mutex);
    return all;
  }
  int64_t Count(Did did) const { return std::ranges::count(Copy(), did); }

  mutable std::mutex mutex;
  std::vector<Did> all;
};

/// A checkpoint's sampler that records its slices.
class LoggedSampler final : public Sampler {
 public:
  LoggedSampler(std::unique_ptr<Sampler> sampler, std::shared_ptr<Log> log)
      : Sampler(sampler->model(), sampler->device()),
        sampler_(std::move(sampler)),
        log_(std::move(log)) {}

  Slices<Plan> Sample(const ValidSpec& spec) override {
    const bool is_bulk = spec->frames == kBulkFrames;
    Slices<Plan> slices = sampler_->Sample(spec);
    for (bool more = true; more;) {
      log_->Add(is_bulk ? Log::Did::kBulkSlice : Log::Did::kDanceSlice);
      more = slices.Continue();
      if (more) co_await Pause();
    }
    if (!is_bulk) log_->Add(Log::Did::kDanceEnds);
    co_return slices.Take();
  }

 private:
  const std::unique_ptr<Sampler> sampler_;
  const std::shared_ptr<Log> log_;
};

/// A GenerateTransition that reads its answers as they come, until it is cancelled.
class BulkCall {
 public:
  explicit BulkCall(v1::Choreography::Stub& stub, const v1::GenerateTransitionRequest& request)
      : reader_(stub.GenerateTransition(&context_, request)), thread_([this] { Read(); }) {}
  ~BulkCall() { Cancel(); }

  void Cancel() {
    context_.TryCancel();
    if (thread_.joinable()) thread_.join();
  }
  int64_t frames() const { return frames_; }
  bool over() const { return over_; }

 private:
  void Read() {
    v1::GenerateTransitionResponse response;
    while (reader_->Read(&response)) {
      if (!response.has_frames()) continue;
      frames_ += response.frames().root_positions_size() / 3;
    }
    reader_->Finish();
    over_ = true;
  }

  grpc::ClientContext context_;
  std::unique_ptr<grpc::ClientReader<v1::GenerateTransitionResponse>> reader_;
  std::atomic<int64_t> frames_ = 0;
  std::atomic<bool> over_ = false;
  std::thread thread_;
};

class BulkTest : public ServerTest {
 protected:
  BulkTest() {
    SetTorchThreads(1);
    StartWith(std::make_unique<LoggedSampler>(MakeSampler(SHIPPED_CHECKPOINT, Device{}), log));
  }

  static v1::GenerateTransitionRequest Bulk() {
    v1::GenerateTransitionRequest request;
    *request.mutable_config() = Config();
    request.set_frames(kBulkFrames);
    request.set_candidates(kCandidates);
    return request;
  }
  // All its messages arrive before one message grants its frames, so from its first slice on it
  // waits only for the worker.
  Answer Dance() {
    DanceClient client(stub());
    client.Send(Config());
    client.SendGenerateUntil(0);
    client.SendKeyframe(Key("a", kDanceFrames / 2 - 1));
    client.SendKeyframe(Key("b", kDanceFrames - 1, -0.2, 0.9, 1.5F));
    client.SendGenerateUntil(kDanceFrames);
    EXPECT_TRUE(client.ReadFrames(kDanceFrames));
    return client.Finish();
  }

  std::shared_ptr<Log> log = std::make_shared<Log>();
};

TEST_F(BulkTest, DancesPreemptLongTransitionCalls) {
  const Answer::Joined alone = Dance().Join();
  ExpectIdle();
  BulkCall bulk(stub(), Bulk());
  ExpectEventually([&] { return log->Count(Log::Did::kBulkSlice) > 0; }, "it is being made");
  const size_t before = log->Copy().size();
  const Answer answer = Dance();
  const int64_t delivered = bulk.frames();
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  EXPECT_TRUE(answer.Join() == alone);
  EXPECT_FALSE(bulk.over());
  EXPECT_LE(delivered, int64_t{kBulkFrames} * kCandidates / 4);

  // No slice of the call runs between the dance's first and its last.
  const std::vector<Log::Did> all = log->Copy();
  const auto of_dance = [](Log::Did did) { return did != Log::Did::kBulkSlice; };
  const auto first =
      std::find_if(all.begin() + static_cast<std::ptrdiff_t>(before), all.end(), of_dance);
  const auto last = std::find_if(all.rbegin(), all.rend(), of_dance).base();
  ASSERT_LT(first, last);
  EXPECT_EQ(std::count(first, last, Log::Did::kDanceEnds), 2);
  EXPECT_EQ(std::count(first, last, Log::Did::kBulkSlice), 0);
  // Then the call continues.
  const int64_t then = log->Count(Log::Did::kBulkSlice);
  ExpectEventually([&] { return log->Count(Log::Did::kBulkSlice) > then; }, "it goes on");
}

// A dance cancels calls when it is edited, and a page when its reader leaves.
TEST_F(BulkTest, CancelledCallsCostAtMostTheirSlice) {
  constexpr int kCalls = 20;
  for (int i = 0; i < kCalls; ++i) {
    const int64_t before = log->Count(Log::Did::kBulkSlice);
    BulkCall bulk(stub(), Bulk());
    ExpectEventually([&] { return log->Count(Log::Did::kBulkSlice) > before; }, "it is begun");
    bulk.Cancel();
  }
  ExpectIdle();
  // A window has at most 96 frames, so a whole call would take more slices than this.
  constexpr int kAll = kCalls * kCandidates * kBulkFrames / 96;
  EXPECT_LT(log->Count(Log::Did::kBulkSlice), kAll / 8);
  EXPECT_TRUE(Dance().status.ok());
}

}  // namespace choreo::bulk_test
