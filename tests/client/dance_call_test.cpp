#include "client/dance_call.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "client/choreo_client.h"
#include "tests/client/scripted_server.h"
#include "tests/support/expect_error.h"

/// Dances in the API's own messages.
namespace choreo::client::dance_call_test {

using Requests = std::vector<v1::StreamDanceRequest>;
using Responses = std::vector<v1::StreamDanceResponse>;

v1::StreamDanceResponse FramesFrom(int64_t first, int count) {
  v1::StreamDanceResponse response;
  v1::Frames& frames = *response.mutable_frames();
  frames.set_first_frame(first);
  frames.set_count(count);
  frames.mutable_root_positions()->Resize(3 * count, 1);
  frames.mutable_rotations()->Resize(3 * 24 * count, 0);
  frames.mutable_contacts()->Resize(4 * count, 0);
  return response;
}

v1::StreamDanceResponse SummaryOf(int64_t frames) {
  v1::StreamDanceResponse response;
  response.mutable_summary()->mutable_report()->set_frames(frames);
  return response;
}

v1::StreamDanceResponse WarningAt(int64_t frame) {
  v1::StreamDanceResponse response;
  response.mutable_event()->set_frame(frame);
  response.mutable_event()->mutable_warning()->set_message("short");
  return response;
}

/// Requests up to the end of keys.
Requests ReadAll(ScriptedServer::Stream& stream) {
  Requests read(1);
  while (stream.Read(&read.back()) && !read.back().has_keyframes_complete()) read.emplace_back();
  return read;
}

grpc::Status Answer(ScriptedServer::Stream& stream, const Responses& responses,
                    const grpc::Status& status = grpc::Status::OK) {
  for (const v1::StreamDanceResponse& response : responses) stream.Write(response);
  return status;
}

std::string Text(const DanceCall::Answer& answer) {
  if (std::holds_alternative<Resumed>(answer)) return "resumed";
  return std::get<v1::StreamDanceResponse>(answer).SerializeAsString();
}

TEST(DanceCallTest, PassesOnAnswersAsTheyCome) {
  Responses sent = {ScriptedServer::Header(), FramesFrom(0, 2), WarningAt(1), {}, SummaryOf(2)};
  AddUnknownField(sent[0].mutable_header());
  AddUnknownField(sent[1].mutable_frames());
  AddUnknownField(sent[2].mutable_event()->mutable_warning());
  sent[2].mutable_event()->mutable_warning()->set_code(static_cast<v1::WarningCode>(99));
  sent[3].mutable_continuation()->set_frame(2);
  AddUnknownField(sent[4].mutable_summary());
  const ScriptedServer server([&](auto& stream) { return Answer(stream, sent); });
  const auto dance = Client({.addresses = {server.address()}}).StartDance({});
  for (const v1::StreamDanceResponse& response : sent)
    EXPECT_EQ(Text(CallOf(*dance).Next().value()), response.SerializeAsString());
  EXPECT_FALSE(CallOf(*dance).Next());
}

TEST(DanceCallTest, RepeatsRequestsButNoAnswers) {
  std::vector<Requests> calls;
  const ScriptedServer server([&](auto& stream) {
    calls.push_back(ReadAll(stream));
    if (calls.size() == 1)
      return Answer(stream, {ScriptedServer::Header(), FramesFrom(0, 2), WarningAt(1)},
                    {grpc::StatusCode::UNAVAILABLE, "gone"});
    return Answer(stream, {ScriptedServer::Header(), FramesFrom(0, 1), WarningAt(1),
                           FramesFrom(1, 3), SummaryOf(4)});
  });
  const Client client({.addresses = {server.address()}, .first_backoff_s = 0.01});
  const auto dance = client.StartDance({.audio = {AudioKind::kPcmFloat, 16000, 2}});
  Requests sent(4);
  sent[0].mutable_keyframe()->set_id("key");
  AddUnknownField(sent[0].mutable_keyframe());
  sent[1].mutable_audio()->set_data(std::string(16, 'x'));
  sent[1].mutable_audio()->set_first_sample(99);
  sent[2].mutable_audio()->set_data(std::string(8, 'x'));
  sent[3].mutable_keyframes_complete();
  for (const v1::StreamDanceRequest& request : sent) CallOf(*dance).Send(request);
  std::vector<std::string> answers;
  while (const auto answer = CallOf(*dance).Next()) answers.push_back(Text(*answer));

  std::vector<std::string> wanted;
  for (const v1::StreamDanceResponse& response :
       {ScriptedServer::Header(), FramesFrom(0, 2), WarningAt(1), FramesFrom(2, 2), SummaryOf(4)})
    wanted.push_back(response.SerializeAsString());
  wanted.insert(wanted.begin() + 3, "resumed");
  EXPECT_EQ(answers, wanted);
  sent[1].mutable_audio()->set_first_sample(0);
  sent[2].mutable_audio()->set_first_sample(2);
  ASSERT_EQ(calls.size(), 2U);
  for (const Requests& call : calls) {
    ASSERT_EQ(call.size(), 5U);
    EXPECT_TRUE(call[0].has_config());
    for (size_t i = 0; i < sent.size(); ++i)
      EXPECT_EQ(call[i + 1].SerializeAsString(), sent[i].SerializeAsString()) << i;
  }
}

TEST(DanceCallTest, RefusesAnswersThatBreakTheProtocol) {
  v1::StreamDanceResponse cut = FramesFrom(0, 2);
  cut.mutable_frames()->mutable_contacts()->Truncate(1);
  for (const Responses& sent : {Responses{FramesFrom(0, 2)}, Responses{SummaryOf(2)},
                                Responses{ScriptedServer::Header(), cut},
                                Responses{ScriptedServer::Header(), FramesFrom(1, 2)}}) {
    const ScriptedServer server([&](auto& stream) { return Answer(stream, sent); });
    const auto dance = Client({.addresses = {server.address()}}).StartDance({});
    ExpectError(ErrorCode::kInternal, "the server", [&] {
      while (CallOf(*dance).Next()) continue;
    });
  }
}

}  // namespace choreo::client::dance_call_test
