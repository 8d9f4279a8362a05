#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <vector>

#include "model/flow/flow_sampler.h"
#include "tests/flow/flow_scene.h"

/// Sampling with networks that tests make up.
namespace choreo {

inline std::vector<Pose> Window(const FlowModelParts& model, const FlowNetwork& network,
                                const WindowRequest& request, const TransitionNoise& noise) {
  return SampleWindow(model, network, request, noise).Finish();
}

inline std::vector<Pose> Transition(const FlowModelParts& model, const FlowNetwork& network,
                                    const WindowRequest& request, const TransitionNoise& noise) {
  SpareFrames spare = SpareFrames::Of(request.frames);
  return SampleTransition(model, network, request, noise, &spare).Finish();
}

/// Has learnt nothing: its dances are the prior's.
class Silent : public FlowNetwork {
 public:
  Eigen::MatrixXf Condition(const Eigen::VectorXf& whole,
                            std::span<const float> times) const override {
    EXPECT_TRUE(whole.allFinite());
    Eigen::MatrixXf condition(whole.size() + 1, std::ssize(times));
    condition.topRows(whole.size()).colwise() = whole;
    std::ranges::copy(times, condition.bottomRows<1>().begin());
    return condition;
  }
  Eigen::MatrixXf Evaluate(const Eigen::MatrixXf& z, const Eigen::MatrixXf& poses,
                           const Eigen::MatrixXf& joints, const Eigen::MatrixXf& mean,
                           const Eigen::MatrixXf& frames,
                           const Eigen::VectorXf& condition) const override {
    EXPECT_EQ(joints.cols(), z.cols() + kTau);
    EXPECT_EQ(joints.rows(), z.rows() - 3);
    EXPECT_TRUE(joints.row(1).minCoeff() > 0.3);  // the pelvis stands above the floor
    EXPECT_EQ(poses.cols(), z.cols() + kTau);
    EXPECT_EQ(mean.cols(), z.cols() + kTau);
    EXPECT_EQ(frames.rows(), FrameFeatures());
    EXPECT_TRUE(frames.allFinite());
    EXPECT_TRUE(condition.tail<1>()[0] >= 0 && condition.tail<1>()[0] < 1);
    ++evaluations;
    return Eigen::MatrixXf::Zero(z.rows(), z.cols());
  }
  mutable int evaluations = 0;
};

}  // namespace choreo
