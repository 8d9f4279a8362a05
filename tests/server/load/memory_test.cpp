#include <grpcpp/create_channel.h>

#include <algorithm>
#include <fstream>
#include <iostream>

#include "client/authoring/local_server.h"
#include "server/messages/read_message.h"
#include "tests/server/fixture.h"
#include "tests/server/requests/raw_call.h"
#include "tests/support/sanitizers.h"
#include "tests/support/tcp_proxy.h"

/// How much memory hostile clients can make a server use. The test has its own process, whose peak
/// is the server's alone, and prints the figures.
namespace choreo::memory_test {

constexpr int64_t kMiB = 1 << 20;

class MemoryTest : public testing::Test {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "sanitizers take memory of their own";
    Connect();
    v1::GetServerInfoResponse info;
    grpc::ClientContext context;
    ASSERT_TRUE(stub_->GetServerInfo(&context, {}, &info).ok());  // all that it needs at first
    std::ofstream(Proc() + "clear_refs") << 5;                    // the peak counts from here
    before_ = Peak();
  }

  /// Prints the peak since SetUp and fails beyond `most` MiB.
  void ExpectPeak(const std::string& under, int64_t most) {
    const int64_t more = (Peak() - before_) / kMiB;
    std::cout << "memory under " << under << ": " << more << " MiB more\n";
    EXPECT_LE(more, most) << under;
  }

  void Connect() {
    channel_ = grpc::CreateChannel(server_.address(), grpc::InsecureChannelCredentials());
    stub_ = v1::Choreography::NewStub(channel_);
  }

  int port() const { return std::stoi(server_.address().substr(server_.address().rfind(':') + 1)); }

  std::shared_ptr<grpc::Channel> channel_;
  std::unique_ptr<v1::Choreography::Stub> stub_;

 private:
  std::string Proc() const { return "/proc/" + std::to_string(server_.process()) + "/"; }

  int64_t Peak() const {
    std::ifstream status(Proc() + "status");
    for (std::string word; status >> word;) {
      int64_t kib = 0;
      if (word == "VmHWM:" && status >> kib) return kib << 10;
    }
    return 0;
  }

  const authoring::LocalServer server_{FAKE_CHOREOD};
  int64_t before_ = 0;
};

// Elements of two bytes each, which would take 800 MiB as objects.
TEST_F(MemoryTest, SixteenMebibytesOfEmptyPoses) {
  const std::string pose = WireField(v1::History::kPosesFieldNumber, "");
  std::string poses;
  while (poses.size() + 64 < static_cast<size_t>(kMaxMessageBytes)) poses += pose;
  const std::string request = WireField(1, WireField(v1::DanceConfig::kHistoryFieldNumber, poses));
  for (const char* method : {"GenerateTransition", "StreamDance"}) {
    const grpc::Status status = RawCall(channel_, method, request);
    EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT) << status.error_message();
  }
  // The bytes in transit.
  ExpectPeak("16 MiB of empty poses", 64);
}

// 256 MiB of zeros in a quarter of a mebibyte.
TEST_F(MemoryTest, AGzipBomb) {
  v1::GenerateTransitionRequest request;
  request.mutable_audio()->set_data(std::string(256 * kMiB, '\0'));
  grpc::ClientContext context;
  context.set_compression_algorithm(GRPC_COMPRESS_GZIP);
  const auto reader = stub_->GenerateTransition(&context, request);
  v1::GenerateTransitionResponse response;
  EXPECT_FALSE(reader->Read(&response));
  EXPECT_EQ(reader->Finish().error_code(), grpc::StatusCode::UNIMPLEMENTED);
  ExpectPeak("a gzip bomb of 256 MiB", 16);
}

// Each client sends its 16 MiB except for the end.
TEST_F(MemoryTest, MessagesThatNeverEnd) {
  constexpr int kClients = 80;
  constexpr int64_t kSent = 15 * kMiB;
  v1::GenerateTransitionRequest request;
  request.mutable_audio()->set_data(std::string(kMaxMessageBytes - 1000, 'x'));
  std::vector<std::unique_ptr<TcpProxy>> networks;
  std::vector<std::jthread> clients;
  std::atomic<int> ended = 0;
  std::vector<grpc::ClientContext> contexts(kClients);
  for (int i = 0; i < kClients; ++i) {
    TcpProxy& network = *networks.emplace_back(std::make_unique<TcpProxy>(port(), kSent));
    clients.emplace_back([&, i] {
      const auto own = v1::Choreography::NewStub(
          grpc::CreateChannel(network.address(), grpc::InsecureChannelCredentials()));
      own->GenerateTransition(&contexts[static_cast<size_t>(i)], request)->Finish();
      ++ended;
    });
  }
  ExpectEventually(
      [&] {
        return ended + std::ranges::count_if(
                           networks, [](const auto& network) { return network->upward_done(); }) >=
               kClients;
      },
      "everybody has sent all, or was sent away", std::chrono::minutes(1));
  ExpectPeak("80 messages of 16 MiB that never end", 640);
  for (grpc::ClientContext& context : contexts) context.TryCancel();
  clients.clear();
  EXPECT_TRUE(RawCall(channel_, "GetServerInfo", "").ok()) << "others are served";
}

}  // namespace choreo::memory_test
