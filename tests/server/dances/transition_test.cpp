#include <algorithm>
#include <functional>
#include <set>

#include "tests/server/dances/merge.h"

namespace choreo::transition_test {

class TransitionTest : public ServerTest {
 protected:
  static v1::GenerateTransitionRequest Request() {
    v1::GenerateTransitionRequest request;
    *request.mutable_config() = Config();
    request.set_frames(41);
    *request.mutable_target() = KeyPose(0.3, 0.4, 0.8F);
    return request;
  }
};

TEST_F(TransitionTest, SeveralCandidatesRanked) {
  Start();
  v1::GenerateTransitionRequest request = Request();
  request.set_candidates(5);
  const Answer answer = Generate(request);
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  ASSERT_TRUE(answer.header);
  EXPECT_EQ(answer.header->seed(), 7U);
  ASSERT_TRUE(answer.transition_summary);
  ASSERT_EQ(answer.transition_summary->candidates_size(), 5);
  std::set<uint32_t> numbers;
  for (const v1::Candidate& candidate : answer.transition_summary->candidates()) {
    numbers.insert(candidate.candidate());
    EXPECT_EQ(candidate.report().frames(), 41);
    ASSERT_EQ(candidate.report().keyframes_size(), 1);
    EXPECT_LE(candidate.report().keyframes(0).errors().final_error_m(), 1e-3);
    EXPECT_EQ(candidate.continuation().frame(), 41);
    const Answer::Joined joined = answer.Join(candidate.candidate());
    EXPECT_EQ(joined.first_frame, 0);
    EXPECT_EQ(joined.count, 41);
    EXPECT_NEAR(joined.root_positions[40 * 3], 0.3, 1e-5);
  }
  EXPECT_EQ(numbers, (std::set<uint32_t>{0, 1, 2, 3, 4}));
  EXPECT_FALSE(answer.Join(0) == answer.Join(1));
  ExpectIdle();
}

TEST_F(TransitionTest, RanksCandidatesByLikelihoodOnRequest) {
  Start();
  v1::GenerateTransitionRequest request = Request();
  request.set_candidates(8);
  request.set_rank_by(v1::RANK_BY_LIKELIHOOD);
  const Answer answer = Generate(request);
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  std::vector<double> likelihoods;
  for (const v1::Candidate& candidate : answer.transition_summary->candidates())
    likelihoods.push_back(candidate.report().log_likelihood());
  ASSERT_EQ(likelihoods.size(), 8U);
  EXPECT_TRUE(std::ranges::is_sorted(likelihoods, std::greater()));
  EXPECT_GT(likelihoods.front(), likelihoods.back());
}

// A chain of GenerateTransitions, candidate 0 each, is the StreamDance with the same keys.
TEST_F(TransitionTest, ChainEqualsAStream) {
  Start();
  const std::string music = Music(4);
  DanceClient client(stub());
  v1::DanceConfig config = Config(31);
  *config.mutable_audio_format() = MusicFormat();
  config.set_frames(91);
  client.Send(config);
  client.SendKeyframe(Key("a", 40));
  client.SendKeyframe(Key("b", 90, -0.2, 0.9, 1.5F));
  client.SendAudio(music, 0);
  client.SendEndOfAudio();
  const Answer& stream = client.Finish();
  ASSERT_TRUE(stream.status.ok()) << stream.status.error_message();

  v1::GenerateTransitionRequest request = Request();
  *request.mutable_config() = config;
  request.mutable_config()->clear_frames();
  request.mutable_audio()->set_data(music);
  request.set_candidates(2);
  const Answer first = Generate(request);
  ASSERT_TRUE(first.status.ok()) << first.status.error_message();

  v1::Continuation continuation;
  for (const auto& candidate : first.transition_summary->candidates()) {
    if (candidate.candidate() == 0) continuation = candidate.continuation();
  }
  *request.mutable_config()->mutable_continuation() = continuation;
  const int64_t from = continuation.audio_from_sample();
  request.mutable_config()->mutable_audio_format()->set_first_sample(from);
  request.mutable_audio()->set_first_sample(from);
  request.mutable_audio()->set_data(music.substr(static_cast<size_t>(2 * from)));
  request.set_frames(50);
  *request.mutable_target() = KeyPose(-0.2, 0.9, 1.5F);
  const Answer second = Generate(request);
  ASSERT_TRUE(second.status.ok()) << second.status.error_message();

  Answer::Joined chain = first.Join(0);
  const Answer::Joined tail = second.Join(0);
  EXPECT_EQ(tail.first_frame, 41);
  chain.count += tail.count;
  for (auto part :
       {&Answer::Joined::root_positions, &Answer::Joined::rotations, &Answer::Joined::contacts}) {
    (chain.*part).insert((chain.*part).end(), (tail.*part).begin(), (tail.*part).end());
  }
  EXPECT_TRUE(chain == stream.Join());
}

TEST_F(TransitionTest, StartsInTheMiddleOfADance) {
  Start();
  v1::GenerateTransitionRequest request = Request();
  v1::History* history = request.mutable_config()->mutable_history();
  history->set_first_frame(300);
  for (int i = 0; i < 12; ++i) *history->add_poses() = KeyPose(0.01 * i, 0, 0);
  *request.add_after() = KeyPose(0.32, 0.4, 0.8F);
  const Answer answer = Generate(request);
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  EXPECT_EQ(answer.Join().first_frame, 300);
  EXPECT_EQ(answer.header->first_frame(), 300);
}

struct BadRequestCase {
  std::string name;
  std::function<void(v1::GenerateTransitionRequest&)> change;
  std::string field, says;
  grpc::StatusCode code = grpc::StatusCode::INVALID_ARGUMENT;
};

class BadTransitionTest : public ServerTest, public testing::WithParamInterface<BadRequestCase> {};

TEST_P(BadTransitionTest, IsNamed) {
  Start();
  v1::GenerateTransitionRequest request;
  *request.mutable_config() = Config();
  request.set_frames(41);
  *request.mutable_target() = KeyPose(0.3, 0.4, 0.8F);
  const v1::GenerateTransitionRequest good = request;
  GetParam().change(request);
  const Answer answer = Generate(request);
  EXPECT_EQ(answer.status.error_code(), GetParam().code) << answer.status.error_message();
  EXPECT_NE(answer.status.error_message().find(GetParam().says), std::string::npos)
      << answer.status.error_message();
  const Details details = DetailsOf(answer.status);
  ASSERT_TRUE(details.bad_request);
  EXPECT_EQ(details.bad_request->field_violations(0).field(), GetParam().field);
  EXPECT_TRUE(Generate(good).status.ok());
  ExpectIdle();
}

auto With(const std::string& text) {
  return [text](v1::GenerateTransitionRequest& request) { Merge(text, &request); };
}

auto WithoutTarget(const std::string& text) {
  return [text](v1::GenerateTransitionRequest& request) {
    request.clear_target();
    Merge(text, &request);
  };
}

// So many poses after the target, the last of them changed.
auto WithAfter(int count, const std::function<void(v1::Pose&)>& change = {}) {
  return [=](v1::GenerateTransitionRequest& request) {
    for (int i = 0; i < count; ++i) *request.add_after() = request.target();
    if (change) change(*request.mutable_after(count - 1));
  };
}

INSTANTIATE_TEST_SUITE_P(
    All, BadTransitionTest,
    testing::ValuesIn(std::vector<BadRequestCase>{
        {"NoConfig", [](auto& r) { r.clear_config(); }, "config", "missing"},
        {"NoFrames", [](auto& r) { r.clear_frames(); }, "frames", "0"},
        {"TooManyFrames", With("frames: 1801"), "frames", "1800"},
        {"TooManyCandidates", With("candidates: 33"), "candidates", "32"},
        {"UnknownRanking", With("rank_by: 7"), "rank_by", "7 is not a RankBy; 0 to 2 are"},
        {"UnknownModel", With("config { model: 'nope' }"), "config.model", "\"fake\"",
         grpc::StatusCode::NOT_FOUND},
        {"GenerateUntil", With("config { generate_until: 5 }"), "config.generate_until",
         "StreamDance"},
        {"RejectInvalidKeys", With("config { reject_invalid_keys: true }"),
         "config.reject_invalid_keys", "StreamDance"},
        {"EmptyHistory", With("config { history {} }"), "config.history.poses", "at least 1"},
        {"HistoryWithoutRoot",
         [](auto& r) {
           *r.mutable_config()->mutable_history()->add_poses() = r.target();
           r.mutable_config()->mutable_history()->mutable_poses(0)->clear_root_position();
         },
         "config.history.poses[0].root_position", "missing"},
        {"LongTargetId", With("target_id: '" + std::string(257, 'x') + "'"), "target_id",
         "257 bytes, not 1 to 256"},
        {"AfterWithoutTarget",
         [](auto& r) {
           *r.add_after() = r.target();
           r.clear_target();
         },
         "after", "target"},
        {"AfterOfAnotherSkeleton",
         WithAfter(2, [](auto& pose) { pose.mutable_rotations()->Truncate(69); }),
         "after[1].rotations", "23 joints"},
        {"AfterFarAway", WithAfter(2, [](auto& pose) { pose.mutable_root_position()->set_x(2e4); }),
         "after[1].root_position.x", "10000"},
        {"TooManyAfter", WithAfter(61), "after", "61 poses, more than 60"},
        {"AudioWithoutFormat", With("audio { data: 'abcd' }"), "audio", "config.audio_format"},
        {"FormatWithoutAudio",
         With("config { audio_format { encoding: AUDIO_ENCODING_PCM_S16LE sample_rate: 22050 "
              "channels: 1 } }"),
         "audio", "missing"},
        {"MaskedToNothing",
         [](auto& r) {
           r.mutable_target()->clear_root_position();
           r.mutable_target_mask();
         },
         "target_mask", "nothing"},
        {"AnIdOfNoTarget", WithoutTarget("target_id: 'landing'"), "target_id", "no target"},
        {"HitTooHard", With("target_hit: 3.5"), "target_hit", "3.5 is not in [0, 3]"},
        {"AHitOfNoTarget", WithoutTarget("target_hit: 1"), "target_hit", "no target"},
        {"NotAFile",
         With("config { audio_format { encoding: AUDIO_ENCODING_FILE } } "
              "audio { data: 'this is no music' }"),
         "audio", ""}}),
    [](const auto& suite) { return suite.param.name; });

}  // namespace choreo::transition_test
