#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <unistd.h>

#include "model/audio/signal/format.h"
#include "tests/server/fixture.h"
#include "tests/server/requests/raw_call.h"

/// Refusals of messages on the wire, before they are parsed.
namespace choreo::limits_test {

using testing::HasSubstr;

constexpr int kConfig = v1::GenerateTransitionRequest::kConfigFieldNumber;
static_assert(kConfig == v1::StreamDanceRequest::kConfigFieldNumber);

std::string Repeated(const std::string& bytes, size_t times) {
  std::string out;
  out.reserve(bytes.size() * times);
  while (times-- > 0) out += bytes;
  return out;
}

class WireLimitsTest : public ServerTest, public testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override { Start(); }

  void ExpectRefused(const std::string& bytes, const std::string& field, const std::string& says) {
    const grpc::Status status = RawCall(channel, GetParam(), bytes);
    EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT) << status.error_message();
    EXPECT_THAT(status.error_message(), HasSubstr(says));
    const Details details = DetailsOf(status);
    ASSERT_TRUE(details.bad_request);
    EXPECT_EQ(details.bad_request->field_violations(0).field(), field);
    ExpectIdle();
  }

  static std::string History(const std::string& poses) {
    return WireField(kConfig, WireField(v1::DanceConfig::kHistoryFieldNumber, poses));
  }
  static inline const std::string kEmptyPose = WireField(v1::History::kPosesFieldNumber, "");
};

INSTANTIATE_TEST_SUITE_P(Calls, WireLimitsTest,
                         testing::Values("GenerateTransition", "StreamDance"));

TEST_P(WireLimitsTest, RefusesTooManyPosesInAHistory) {
  ExpectRefused(History(Repeated(kEmptyPose, 1001)), "config.history.poses", "1001 poses, more");
  ExpectRefused(Repeated(History(kEmptyPose), 1001), "config.history.poses", "1000");
}

TEST_P(WireLimitsTest, AThousandPosesAreRead) {
  ExpectRefused(History(Repeated(kEmptyPose, 1000)), "config.history.poses[0].root_position",
                "missing");
}

TEST_P(WireLimitsTest, RefusesTooManyUnknownFields) {
  const std::string unknown = WireField(1000, "");
  ExpectRefused(Repeated(unknown, 32'769), "unknown field", "32768");
  ExpectRefused(WireField(kConfig, Repeated(unknown, 32'768)), "config.unknown field", "32768");
}

TEST_P(WireLimitsTest, ReadsAsManyPassagesAsADanceMayHave) {
  v1::DanceConfig config;
  for (size_t i = 0; i <= kMaxPassages; ++i) {
    v1::MusicPassage* passage = config.add_music_passages();
    passage->set_from(10 + 0.05 * static_cast<double>(i));
    passage->set_to(10.01 + 0.05 * static_cast<double>(i));
    passage->set_like(1);
  }
  ExpectRefused(WireField(kConfig, config.SerializeAsString()), "config.music_passages",
                "6001 passages, the limit is 6000");
}

TEST_P(WireLimitsTest, RefusesTooManyBytesBesideMusic) {
  const std::string name = WireField(v1::DanceConfig::kModelFieldNumber, std::string(5 << 20, 'x'));
  ExpectRefused(WireField(kConfig, name), "request", "4194304");
}

// A message that cannot be parsed does not count as the end of the stream.
TEST_P(WireLimitsTest, RefusesBytesThatAreNoMessage) {
  ExpectRefused("this is none", "request", GetParam());
  ExpectRefused(WireField(kConfig, "\x0b\x0c"), "request", "DanceConfig");  // a group
  ExpectRefused(WireField(kConfig, WireField(v1::DanceConfig::kModelFieldNumber, "\xff\xfe")),
                "request", GetParam());  // no UTF-8
  ExpectRefused(WireField(kConfig, "").substr(0, 1), "request", GetParam());
}

using LimitsTest = ServerTest;

TEST_F(LimitsTest, PosesThatFollowATransition) {
  Start();
  const std::string pose = WireField(v1::GenerateTransitionRequest::kAfterFieldNumber, "");
  const grpc::Status status = RawCall(channel, "GenerateTransition", Repeated(pose, 61));
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(status.error_message(), "after: 61 poses, more than 60");
}

TEST_F(LimitsTest, AreDeclared) {
  Start();
  grpc::ClientContext context;
  v1::GetServerInfoResponse info;
  ASSERT_TRUE(stub().GetServerInfo(&context, {}, &info).ok());
  EXPECT_EQ(info.limits().max_other_bytes(), 4 << 20);
  EXPECT_EQ(info.limits().max_history_poses(), 1000);
  EXPECT_EQ(info.limits().max_after_poses(), 60);
  EXPECT_EQ(info.limits().max_audio_file_samples(), 240'000'000);
}

TEST_F(LimitsTest, FingerprintsAreNotEchoed) {
  Start();
  v1::StreamDanceRequest request;
  *request.mutable_config() = Config();
  v1::Continuation* continuation = request.mutable_config()->mutable_continuation();
  continuation->set_skeleton(Skeleton::Smpl24().name);
  continuation->mutable_root_positions()->Resize(30, 0.5F);
  continuation->mutable_rotations()->Resize(30 * 24, 0);
  continuation->set_fingerprint(std::string(1 << 20, 'x'));
  request.mutable_config()->set_allow_inexact_resume(true);
  request.mutable_config()->set_frames(5);
  const Answer answer = Dance({request});
  EXPECT_EQ(answer.status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(answer.status.error_message(),
            "config.continuation.fingerprint: has 1048576 bytes, at most 1024");
  EXPECT_TRUE(answer.events.empty());
}

// The server refuses a compressed request before it inflates it.
TEST_F(LimitsTest, CompressedRequestsAreRefused) {
  Start();
  for (const auto algorithm : {GRPC_COMPRESS_GZIP, GRPC_COMPRESS_DEFLATE}) {
    grpc::ClientContext context;
    context.set_compression_algorithm(algorithm);
    v1::GenerateTransitionRequest request;
    *request.mutable_config() = Config();
    request.set_frames(10);
    request.mutable_audio()->set_data(std::string(1 << 16, '\0'));
    const auto reader = stub().GenerateTransition(&context, request);
    v1::GenerateTransitionResponse response;
    EXPECT_FALSE(reader->Read(&response));
    EXPECT_EQ(reader->Finish().error_code(), grpc::StatusCode::UNIMPLEMENTED);
  }
  ExpectIdle();
}

// The server sends GOAWAY. The connection ends after its dance, and the next call opens another.
TEST_F(LimitsTest, AnOldConnectionTakesNoNewCalls) {
  Start(1, [](ServerConfig& config) { config.max_connection_seconds = 0.2; });
  DanceClient dance(stub());
  v1::DanceConfig config = Config();
  config.set_frames(60);
  dance.Send(config);
  dance.SendGenerateUntil(30);
  ASSERT_TRUE(dance.ReadFrames(30));
  ExpectEventually([&] { return channel->GetState(false) != GRPC_CHANNEL_READY; }, "it is told");
  v1::GenerateTransitionRequest request;
  *request.mutable_config() = Config();
  request.set_frames(5);
  EXPECT_TRUE(Generate(request).status.ok());
  EXPECT_EQ(dance.Finish().Join().count, 60);
  EXPECT_TRUE(dance.answer().status.ok());
}

// The limits that gRPC's SETTINGS announce (HTTP/2, RFC 9113, 6.5).
TEST_F(LimitsTest, CallsPerConnectionAreLimited) {
  Start(1, [](ServerConfig& config) { config.max_streams = 7; });
  const int connection = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<uint16_t>(server->port()));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(connect(connection, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  const std::string preface = std::string("PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n") +
                              std::string("\0\0\0\4\0\0\0\0\0", 9);  // and SETTINGS without any
  ASSERT_EQ(write(connection, preface.data(), preface.size()),
            static_cast<ssize_t>(preface.size()));
  std::string head(9, '\0');
  ASSERT_EQ(recv(connection, head.data(), head.size(), MSG_WAITALL), 9);
  ASSERT_EQ(head[3], 4) << "SETTINGS come first";
  std::string settings(static_cast<size_t>(head[2]), '\0');
  ASSERT_EQ(recv(connection, settings.data(), settings.size(), MSG_WAITALL),
            static_cast<ssize_t>(settings.size()));
  close(connection);
  const std::string streams("\0\3\0\0\0\x6b", 6);  // MAX_CONCURRENT_STREAMS: 7 and 100 spare
  EXPECT_THAT(settings, HasSubstr(streams));
}

}  // namespace choreo::limits_test
