#include <gmock/gmock.h>
#include <grpc/support/log.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "server/telemetry/log.h"
#include "tests/server/fixture.h"

/// What a server logs.
namespace choreo::log_test {

using testing::HasSubstr;

class LogTest : public ServerTest {
 protected:
  // Makes a call with this traceparent, and returns the lines logged.
  std::vector<std::string> LinesOfCall(bool json, const std::string& traceparent) {
    const auto before = spdlog::default_logger();
    testing::internal::CaptureStderr();
    StartLog("info", json);
    Start();
    grpc::ClientContext context;
    context.AddMetadata("traceparent", traceparent);
    v1::GetServerInfoResponse info;
    EXPECT_TRUE(stub().GetServerInfo(&context, {}, &info).ok());
    v1::GenerateTransitionRequest request;
    *request.mutable_config() = Config();
    request.mutable_config()->set_model("\"\n");
    EXPECT_FALSE(Generate(request).status.ok());
    DanceClient client(stub());
    client.Send(Config());
    client.SendKeyframe(Key("a", 20));
    EXPECT_TRUE(client.Finish().status.ok());
    const auto& headers = client.context.GetServerInitialMetadata();
    const auto id = headers.find("choreo-stream-id");
    if (id != headers.end()) stream_id_.assign(id->second.data(), id->second.size());
    server.reset();
    std::istringstream said(testing::internal::GetCapturedStderr());
    StartLog("info", false);
    spdlog::set_default_logger(before);
    std::vector<std::string> lines;
    for (std::string line; std::getline(said, line);) lines.push_back(line);
    return lines;
  }
  std::string stream_id_;  // that the client of the dance was told
  static constexpr const char* kTraceparent =
      "00-4bf92f3577b34da6a3ce929d0e0e4736-00f067aa0ba902b7-01";
};

TEST_F(LogTest, CallLogsOneLineWithItsTrace) {
  const auto lines = LinesOfCall(false, kTraceparent);
  EXPECT_THAT(lines, testing::Contains(HasSubstr("GetServerInfo ipv4:127.0.0.1")).Times(1));
  EXPECT_THAT(lines, testing::Contains(HasSubstr("trace 4bf92f3577b34da6a3ce929d0e0e4736: OK")));
  EXPECT_THAT(lines, testing::Contains(HasSubstr("NOT_FOUND")).Times(1));
  EXPECT_THAT(lines, testing::Contains(testing::AllOf(HasSubstr(" stream " + stream_id_ + ": OK"),
                                                      HasSubstr(", model \"fake\", seed 7"))));
}

TEST_F(LogTest, AsJsonEachLineIsAnObject) {
  std::vector<nlohmann::json> calls;
  for (const std::string& line : LinesOfCall(true, kTraceparent)) {
    const auto object = nlohmann::json::parse(line);
    EXPECT_TRUE(object.contains("time") && object.contains("level")) << line;
    if (object.at("message") == "call") calls.push_back(object);
  }
  ASSERT_EQ(calls.size(), 3U);
  // Lines of calls that end together come in any order. Sort those without a model first.
  std::ranges::stable_partition(calls, [](const auto& call) { return !call.contains("model"); });
  EXPECT_EQ(calls[0].at("method"), "GetServerInfo");
  EXPECT_EQ(calls[0].at("trace_id"), "4bf92f3577b34da6a3ce929d0e0e4736");
  EXPECT_EQ(calls[0].at("span_id"), "00f067aa0ba902b7");
  EXPECT_EQ(calls[1].at("status"), "NOT_FOUND");
  EXPECT_FALSE(calls[1].contains("trace_id"));
  EXPECT_FALSE(calls[1].contains("model"));
  EXPECT_EQ(calls[2].at("model"), "fake");
  EXPECT_EQ(calls[2].at("seed"), 7);
  EXPECT_EQ(stream_id_.size(), 16U);
  EXPECT_EQ(calls[2].at("stream_id"), stream_id_);
}

// A dance that moves from server to server has one id in their logs.
TEST_F(LogTest, AResumedDanceNamesTheCallInWhichItBegan) {
  const auto before = spdlog::default_logger();
  Start();
  testing::internal::CaptureStderr();
  StartLog("info", false);
  const std::string first = "0123456789abcdef";
  const auto dance = [&](const std::string& resumed_from) {
    DanceClient client(stub(), std::nullopt, {{"choreo-resumed-from", resumed_from}});
    client.Send(Config());
    client.SendKeyframe(Key("a", 20));
    EXPECT_TRUE(client.Finish().status.ok());
    const auto& headers = client.context.GetServerInitialMetadata();
    const auto echo = headers.find("choreo-resumed-from");
    return std::pair(std::string(headers.find("choreo-stream-id")->second.data(), first.size()),
                     echo == headers.end() ? "" : std::string(echo->second.data(), first.size()));
  };
  const auto [id, echo] = dance(first);
  EXPECT_EQ(echo, first);
  EXPECT_EQ(dance("no id of ours").second, "");
  server.reset();
  const std::string said = testing::internal::GetCapturedStderr();
  StartLog("info", false);
  spdlog::set_default_logger(before);
  EXPECT_THAT(said, HasSubstr(" stream " + id + " resumes stream " + first + " at frame 0"));
  EXPECT_THAT(said, HasSubstr(" stream " + id + " from " + first + ": OK"));
  EXPECT_THAT(said, testing::Not(HasSubstr("no id of ours")));
}

// On Linux, file names may contain any bytes.
TEST_F(LogTest, JsonReplacesInvalidUtf8) {
  const auto before = spdlog::default_logger();
  testing::internal::CaptureStderr();
  StartLog("info", true);
  spdlog::error("models/\xff\xc3(\"\n.safetensors");
  StartLog("info", false);
  spdlog::set_default_logger(before);
  const auto object = nlohmann::json::parse(testing::internal::GetCapturedStderr());
  EXPECT_EQ(object.at("message"), "models/\uFFFD\uFFFD(\"\n.safetensors");
}

TEST_F(LogTest, WhatIsHarmlessIsNoErrorOfGrpc) {
  const auto before = spdlog::default_logger();
  testing::internal::CaptureStderr();
  gpr_log_verbosity_init();  // which servers do when they start
  StartLog("info", false);
  gpr_log(GPR_ERROR, "cancel_check_peer error: UNKNOWN:Listener stopped serving. {}");
  gpr_log(GPR_ERROR, "No match found for server name: example.com.");
  StartLog("info", false);
  spdlog::set_default_logger(before);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_THAT(said, HasSubstr("[info] gRPC: cancel_check_peer"));
  EXPECT_THAT(said, HasSubstr("[warning] gRPC: No match found")) << "a harmless client's";
}

// Calls without a token could fill the log, so some are left out. Logged and left-out ones add up.
TEST_F(LogTest, LinesOfRefusedCallsAreBounded) {
  const auto before = spdlog::default_logger();
  std::ostringstream text;
  spdlog::set_default_logger(std::make_shared<spdlog::logger>(
      "refused", std::make_shared<spdlog::sinks::ostream_sink_mt>(text)));
  Caller caller;
  caller.peer = "ipv4:192.0.2.1:7";
  const grpc::Status refused(grpc::StatusCode::UNAUTHENTICATED, "a token is needed");
  constexpr int kCalls = 1'000;
  for (int i = 0; i < kCalls; ++i) {
    LogCall(
        {.method = "StreamDance", .caller = caller, .status = refused, .refusal = Refusal::kToken});
    LogCall({.method = "GetServerInfo", .caller = caller, .status = grpc::Status::OK});
  }
  int lines = 0, served = 0, left_out = 0;
  ExpectEventually(
      [&] {
        LogLeftOutCalls();
        lines = served = left_out = 0;
        std::istringstream said(text.str());
        std::smatch found;
        for (std::string line; std::getline(said, line);) {
          lines += line.find("UNAUTHENTICATED") != line.npos ? 1 : 0;
          served += line.find("GetServerInfo") != line.npos ? 1 : 0;
          if (std::regex_search(line, found,
                                std::regex("([0-9]+) lines of refused calls were left")))
            left_out += std::stoi(found[1]);
        }
        return lines + left_out == kCalls;
      },
      "all are told of");
  spdlog::set_default_logger(before);
  EXPECT_EQ(served, kCalls);
  EXPECT_GT(lines, 0);
  EXPECT_GT(left_out, lines);
}

// Anybody who connects can make gRPC log, so it writes ten lines in ten seconds and counts the
// rest.
TEST_F(LogTest, GrpcsLinesAreBounded) {
  const auto before = spdlog::default_logger();
  testing::internal::CaptureStderr();
  gpr_log_verbosity_init();  // which servers do when they start
  StartLog("info", false);
  for (int i = 0; i < 1'000; ++i) gpr_log(GPR_ERROR, "handshake %d failed", i);
  StartLog("info", false);
  spdlog::set_default_logger(before);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_LE(std::ranges::count(said, '\n'), 2 * 11) << "at most two periods long";
  std::cout << std::ranges::count(said, '\n') << " lines of 1000\n";
  EXPECT_THAT(said, HasSubstr("failed"));
}

TEST_F(LogTest, StartLogsWhoMayConnect) {
  const auto lines = LinesOfCall(false, kTraceparent);
  EXPECT_THAT(lines, testing::Contains(HasSubstr(
                         "TLS is off, certificates of clients are not asked for, tokens are not")));
}

TEST_F(LogTest, OmitsAnInvalidTraceparent) {
  for (const char* bad : {"00-4bf92f3577b34da6a3ce929d0e0e4736-00f067aa0ba902b7",
                          "00-4BF92F3577B34DA6A3CE929D0E0E4736-00f067aa0ba902b7-01",
                          "00-00000000000000000000000000000000-00f067aa0ba902b7-01",
                          "ff-4bf92f3577b34da6a3ce929d0e0e4736-00f067aa0ba902b7-01", "x"}) {
    EXPECT_THAT(LinesOfCall(false, bad), testing::Not(testing::Contains(HasSubstr("trace"))))
        << bad;
  }
}

}  // namespace choreo::log_test
