#include <gmock/gmock.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/support/byte_buffer.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <condition_variable>
#include <iostream>
#include <mutex>
#include <sstream>

#include "tests/server/fixture.h"
#include "tests/server/requests/raw_call.h"

namespace choreo::info_test {

// Calls health and reflection with raw bytes, because we do not generate their messages.
std::string CallRaw(const std::shared_ptr<grpc::Channel>& channel, const std::string& method,
                    const std::string& request, bool stream) {
  grpc::GenericStub stub(channel);
  grpc::ClientContext context;
  grpc::CompletionQueue queue;
  const auto call = stub.PrepareCall(&context, method, &queue);
  auto next = [&queue] {
    void* tag = nullptr;
    bool ok = false;
    return queue.Next(&tag, &ok) && ok;
  };
  call->StartCall(nullptr);
  EXPECT_TRUE(next());
  const grpc::Slice slice(request);
  call->Write(grpc::ByteBuffer(&slice, 1), nullptr);
  EXPECT_TRUE(next());
  if (!stream) {
    call->WritesDone(nullptr);
    EXPECT_TRUE(next());
  }
  grpc::ByteBuffer answer;
  call->Read(&answer, nullptr);
  EXPECT_TRUE(next());
  grpc::Slice flat;
  EXPECT_TRUE(answer.DumpToSingleSlice(&flat).ok());
  if (stream) context.TryCancel();
  grpc::Status status;
  call->Finish(&status, nullptr);
  EXPECT_TRUE(next());
  return {reinterpret_cast<const char*>(flat.begin()), flat.size()};
}

class InfoTest : public ServerTest {};

TEST_F(InfoTest, ReportsModelLimitsAndDevices) {
  Start(3);
  grpc::ClientContext context;
  v1::GetServerInfoResponse info;
  ASSERT_TRUE(stub().GetServerInfo(&context, {}, &info).ok());
  ASSERT_EQ(info.models_size(), 1);
  const v1::ModelInfo& model = info.models(0);
  EXPECT_EQ(model.name(), "fake");
  EXPECT_EQ(model.fingerprint(), "fake-1");
  EXPECT_EQ(model.skeleton().joint_names_size(), 24);
  EXPECT_EQ(model.skeleton().offsets_size(), 72);
  EXPECT_EQ(model.skeleton().parents(0), -1);
  EXPECT_EQ(model.model_frame_rate(), 30);
  EXPECT_EQ(model.history_frames(), 10);
  EXPECT_EQ(model.controls_size(), 0);
  // Ten frames of history and half a window, at least.
  EXPECT_GT(model.audio_lead_s(), 10.0 / 30 + 1024.0 / 22050 - 1e-9);
  EXPECT_LT(model.audio_lead_s(), 0.5);
  EXPECT_GE(model.latency_frames(), 2);
  EXPECT_EQ(info.limits().max_message_bytes(), 16 << 20);
  EXPECT_EQ(info.limits().max_keyframes(), 1000);
  EXPECT_EQ(info.limits().max_candidates(), 32);
  EXPECT_EQ(info.limits().max_streams(), 64);
  EXPECT_EQ(info.limits().max_streams_of_peer(), 56);
  EXPECT_EQ(info.limits().first_message_s(), 10);
  EXPECT_EQ(info.limits().idle_s(), 120);
  EXPECT_EQ(info.limits().unread_s(), 60);
  ASSERT_EQ(info.devices_size(), 1);
  EXPECT_EQ(info.devices(0), "fake:0");
  EXPECT_EQ(info.slots(), 3);
  EXPECT_EQ(info.version(), CHOREO_VERSION);
}

class BriefSampler : public FakeSampler {
 public:
  explicit BriefSampler(int longest) { model_.max_transition_frames = longest; }
};

// The server's limit and the model's limit are different things.
// Old clients, which cannot ask, get them.
TEST_F(InfoTest, CardsCanBeLeftOut) {
  Start(1);
  for (const bool without : {false, true}) {
    grpc::ClientContext context;
    v1::GetServerInfoRequest request;
    request.set_without_cards(without);
    v1::GetServerInfoResponse info;
    ASSERT_TRUE(stub().GetServerInfo(&context, request, &info).ok());
    EXPECT_EQ(info.models(0).card().empty(), without);
    EXPECT_EQ(info.models(0).name(), "fake");
  }
}

TEST_F(InfoTest, ReportsEachModelsLongestTransition) {
  for (const auto& [of_model, told] : {std::pair{150, 150}, {5'000, 1'800}}) {
    StartWith(std::make_unique<BriefSampler>(of_model));
    grpc::ClientContext context;
    v1::GetServerInfoResponse info;
    ASSERT_TRUE(stub().GetServerInfo(&context, {}, &info).ok());
    EXPECT_EQ(info.models(0).max_transition_frames(), told);
    EXPECT_EQ(info.limits().max_transition_frames(), 1'800);
    v1::GenerateTransitionRequest request;
    *request.mutable_config() = Config();
    request.set_frames(told);
    EXPECT_TRUE(Generate(request).status.ok());
    request.set_frames(told + 1);
    EXPECT_EQ(Generate(request).status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  }
}

TEST_F(InfoTest, SeveralModels) {
  Start(1, {}, {"first", "second"});
  auto dancer = [this](const std::string& model) {
    DanceClient client(stub());
    v1::DanceConfig config = Config();
    config.set_model(model);
    client.Send(config);
    client.SendKeyframe(Key("a", 5));
    const Answer& answer = client.Finish();
    EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
    return answer.header ? answer.header->model() : "";
  };
  EXPECT_EQ(dancer(""), "first");
  EXPECT_EQ(dancer("second"), "second");
  EXPECT_THROW(Start(1, {}, {"twin", "twin"}), Error);
}

TEST_F(InfoTest, NamesATakenPort) {
  Start();
  ServerConfig config;
  config.listen = "127.0.0.1:" + std::to_string(server->port());
  std::vector<Server::Samplers> models(1);
  models[0].push_back(std::make_unique<FakeSampler>());
  try {
    const Server second(config, std::move(models));
    FAIL() << "two servers listen on one port";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kUnavailable);
    EXPECT_NE(std::string(error.what()).find(config.listen), std::string::npos);
  }
}

TEST_F(InfoTest, HealthServes) {
  Start();
  const std::string serving("\x08\x01", 2);  // HealthCheckResponse{status: SERVING}
  EXPECT_EQ(CallRaw(channel, "/grpc.health.v1.Health/Check", "", false), serving);
  const std::string name = v1::Choreography::service_full_name();
  const std::string request = std::string("\x0a") + static_cast<char>(name.size()) + name;
  EXPECT_EQ(CallRaw(channel, "/grpc.health.v1.Health/Check", request, false), serving);
}

/// Fails on request, like a lost device.
class FailingSampler final : public FakeSampler {
 public:
  explicit FailingSampler(const std::atomic<bool>* fails) : fails_(fails) {}
  void OnFrame(const TransitionSpec& /*spec*/, Plan* /*plan*/) override {
    if (*fails_) throw std::runtime_error("the device is gone");
  }

 private:
  const std::atomic<bool>* const fails_;
};

TEST_F(InfoTest, HealthReportsABrokenEngine) {
  const auto before = spdlog::default_logger();
  std::ostringstream log;
  spdlog::set_default_logger(std::make_shared<spdlog::logger>(
      "log", std::make_shared<spdlog::sinks::ostream_sink_mt>(log)));
  std::atomic<bool> fails = true;
  StartWith(std::make_unique<FailingSampler>(&fails));
  const auto health = [this] {
    return CallRaw(channel, "/grpc.health.v1.Health/Check", "", false);
  };
  const std::string serving("\x08\x01", 2), not_serving("\x08\x02", 2);
  v1::GenerateTransitionRequest request;
  *request.mutable_config() = Config();
  request.set_frames(5);
  EXPECT_EQ(health(), serving);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(Generate(request).status.error_code(), grpc::StatusCode::INTERNAL);
  }
  const auto begin = std::chrono::steady_clock::now();
  ExpectEventually([&] { return health() == not_serving; }, "health tells of it");
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  std::cout << "NOT_SERVING " << took.count() << " s after the third failure\n";
  fails = false;
  EXPECT_TRUE(Generate(request).status.ok());
  ExpectEventually([&] { return health() == serving; }, "and of its recovery");
  server.reset();  // it looks at `fails`, and writes to the log
  spdlog::set_default_logger(before);
  EXPECT_THAT(log.str(),
              testing::ContainsRegex(R"(\[error\] model "fake": its engine has failed)"));
}

TEST_F(InfoTest, HealthReportsEachModel) {
  std::atomic<bool> fails = true;
  ServerConfig config;
  config.listen = "127.0.0.1:0";
  std::vector<Server::Samplers> models(2);
  models[0].push_back(std::make_unique<ProbedSampler>("sound", probe));
  models[1].push_back(std::make_unique<FailingSampler>(&fails));
  Connect(std::make_unique<Server>(config, std::move(models)));
  const auto health = [this](const std::string& model) {
    const std::string name = v1::Choreography::service_full_name() + ("/" + model);
    return CallRaw(channel, "/grpc.health.v1.Health/Check", WireField(1, name), false);
  };
  const std::string serving("\x08\x01", 2), not_serving("\x08\x02", 2);
  v1::GenerateTransitionRequest request;
  *request.mutable_config() = Config();
  request.mutable_config()->set_model("fake");
  request.set_frames(5);
  EXPECT_EQ(health("fake"), serving);
  for (int i = 0; i < 3; ++i) Generate(request);
  ExpectEventually([&] { return health("fake") == not_serving; }, "health tells of it");
  EXPECT_EQ(health("sound"), serving);
  server.reset();  // it looks at `fails`
}

TEST_F(InfoTest, HealthReportsAddedAndRemovedModels) {
  Start(1, {}, {"first"});
  const auto health = [this](const std::string& model) {
    const std::string name = v1::Choreography::service_full_name() + ("/" + model);
    return CallRaw(channel, "/grpc.health.v1.Health/Check", WireField(1, name), false);
  };
  const std::string serving("\x08\x01", 2), not_serving("\x08\x02", 2);
  EXPECT_EQ(health("first"), serving);
  std::vector<Server::Samplers> fresh(1);
  fresh[0].push_back(std::make_unique<ProbedSampler>("second", probe));
  server->SetModels({"first", "second"}, std::move(fresh));
  EXPECT_EQ(health("second"), serving);
  server->SetModels({"second"}, {});
  EXPECT_EQ(health("first"), not_serving);
  EXPECT_EQ(health("second"), serving);
  EXPECT_THROW(server->SetModels({}, {}), Error);
  EXPECT_THROW(server->SetModels({"first"}, {}), Error);
  EXPECT_THROW(server->SetModels({"second", "second"}, {}), Error);
  EXPECT_EQ(health("second"), serving);
}

TEST_F(InfoTest, ReflectionCanBeSwitchedOff) {
  Start(1, [](ServerConfig& config) { config.reflection = false; });
  const grpc::Status status =
      RawCall(channel, "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo", "");
  EXPECT_EQ(status.error_code(), grpc::StatusCode::UNIMPLEMENTED);
}

TEST_F(InfoTest, ReflectionListsTheService) {
  Start();
  const std::string list_services("\x3a\x00", 2);
  const std::string answer =
      CallRaw(channel, "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo",
              list_services, true);
  EXPECT_NE(answer.find("choreo.v1.Choreography"), std::string::npos);
  EXPECT_NE(answer.find("grpc.health.v1.Health"), std::string::npos);
}

}  // namespace choreo::info_test
