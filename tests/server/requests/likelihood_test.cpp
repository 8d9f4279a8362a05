#include <algorithm>
#include <functional>

#include "model/samplers/samplers.h"
#include "tests/server/fixture.h"

/// A real server with paper F's flow, which has an exact likelihood, and `default`, which has none.
namespace choreo::likelihood_test {

class LikelihoodTest : public ServerTest {
 protected:
  void SetUp() override {
    SetTorchThreads(1);
    std::vector<Server::Samplers> models(2);
    models[0].push_back(MakeSampler(PAPER_F_CHECKPOINT, {}));
    models[1].push_back(MakeSampler(SHIPPED_CHECKPOINT, {}));
    ServerConfig config;
    config.listen = "127.0.0.1:0";
    Connect(std::make_unique<Server>(config, std::move(models)));
  }

  static v1::GenerateTransitionRequest Request(const std::string& model, v1::RankBy rank_by) {
    v1::GenerateTransitionRequest request;
    request.mutable_config()->set_model(model);
    request.mutable_config()->set_seed(3);
    request.set_frames(20);
    *request.mutable_target() = KeyPose(0.2, 0.2, 0.5F);
    request.set_candidates(6);
    request.set_rank_by(rank_by);
    return request;
  }

  // Log-likelihoods of a request's candidates, best first.
  std::vector<double> Likelihoods(v1::RankBy rank_by) {
    const Answer answer = Generate(Request("paper-f", rank_by));
    EXPECT_TRUE(answer.status.ok()) << answer.status.error_message();
    std::vector<double> likelihoods;
    for (const v1::Candidate& candidate : answer.transition_summary->candidates())
      likelihoods.push_back(candidate.report().log_likelihood());
    return likelihoods;
  }
};

TEST_F(LikelihoodTest, RanksPaperFCandidatesByItOnRequest) {
  std::vector<double> by_quality = Likelihoods(v1::RANK_BY_QUALITY);
  const std::vector<double> by_likelihood = Likelihoods(v1::RANK_BY_LIKELIHOOD);
  EXPECT_EQ(by_quality, Likelihoods(v1::RANK_BY_UNSPECIFIED));
  EXPECT_NE(by_quality, by_likelihood);
  std::ranges::sort(by_quality, std::greater());
  EXPECT_EQ(by_quality, by_likelihood);  // the same candidates, in another order
}

TEST_F(LikelihoodTest, ModelWithoutOneSaysSoAndRefuses) {
  v1::GetServerInfoResponse info;
  grpc::ClientContext context;
  ASSERT_TRUE(stub().GetServerInfo(&context, {}, &info).ok());
  for (const v1::ModelInfo& model : info.models())
    EXPECT_EQ(model.likelihood(), model.name() == "paper-f") << model.name();
  const Answer answer = Generate(Request("default", v1::RANK_BY_LIKELIHOOD));
  EXPECT_EQ(answer.status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(answer.status.error_message(),
            "rank_by: \"default\" has no likelihood, only quality is possible");
  EXPECT_TRUE(Generate(Request("default", v1::RANK_BY_QUALITY)).status.ok());
}

}  // namespace choreo::likelihood_test
