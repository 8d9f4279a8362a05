#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "model/flow/energy_curve.h"
#include "model/flow/energy_prior.h"
#include "model/flow/energy_response.h"
#include "model/flow/flow_window.h"
#include "model/flow/turn_prior.h"
#include "model/flow/window_features.h"

namespace choreo {

/// The network of a continuous flow, on any engine. Thread-safe.
class FlowNetwork {
 public:
  virtual ~FlowNetwork() = default;
  /// The conditioning of a window (WindowFeatures::whole) at each of `times`, in [0, 1], one per
  /// column, for Evaluate.
  virtual Eigen::MatrixXf Condition(const Eigen::VectorXf& whole,
                                    std::span<const float> times) const = 0;
  /// F of one window at the time of `condition`, [dimensions, w]. `z` [dimensions, w]: the flow's
  /// white coordinates; `poses` [dimensions, tau + w]: the history's displacements from its last
  /// pose, then the same of z; `joints` [3 joints, tau + w]: the body's joints there, metres in the
  /// canonical frame; `mean`: the prior's mean in the shape of `poses`; `frames`:
  /// WindowFeatures::frames.
  virtual Eigen::MatrixXf Evaluate(const Eigen::MatrixXf& z, const Eigen::MatrixXf& poses,
                                   const Eigen::MatrixXf& joints, const Eigen::MatrixXf& mean,
                                   const Eigen::MatrixXf& frames,
                                   const Eigen::VectorXf& condition) const = 0;
};

/// Everything that sampling a window needs besides the request.
struct FlowModelParts {
  Skeleton skeleton;
  ContinuousFlowConfig config;
  MotionPrior prior;
  Eigen::MatrixXd mixing;  ///< [dimensions, dimensions] lower Cholesky factor of the noise's
                           ///< correlation over dimensions
  EnergyPrior energy = EnergyPrior();
  TurnPrior turns = {};
  EnergyCurve curve = {};
  EnergyResponse response = {};
};

/// Nobody dances farther beyond the sampled way.
inline constexpr double kMaxFlowTemperature = 1.25;

struct FlowNoise {
  uint64_t seed = 0;
  uint32_t candidate = 0;
  int64_t first_frame = 0;  ///< absolute number of the window's first frame
  /// For each frame from the first on, the absolute frame whose numbers it repeats, with this much
  /// `variation` (FillNormalLike). Empty: all have their own.
  std::vector<int64_t> like = {};
  double variation = 0;
  /// Interpolates from the mean motion (0, in one step) to a sampled one (1) and slightly beyond,
  /// at most kMaxFlowTemperature. Noise itself is never scaled: the network would see a calm
  /// dancer.
  double temperature = 0;

  /// The numbers of a frame, counted from the first.
  void Fill(int frame, std::span<float> out) const;
};

/// What a window and its request say about its energy.
EnergyPrior::Known KnownOfEnergy(const FlowModelParts& model, const WindowRequest& request,
                                 const FlowWindow& window);

/// Samples one window: from noise at t = 0 to motion at t = 1 along dz/dt = (2t - 1)/a z +
/// F/sqrt(a), a = t² + (1 - t)² (flow matching, Lipman et al. 2023). With w = z/sqrt(a) and the
/// angle tan = t/(1 - t) that is dw = F, solved by second-order Adams-Bashforth steps: motion keeps
/// the energy that the prior expects, however few steps are taken. The poses [w] are in the
/// request's frame. Meets a requested path exactly. Parts without velocity factors take their
/// energy from the energy prior and curve: the mean at temperature 0, else a sample.
std::vector<Pose> SampleWindow(const FlowModelParts& model, const FlowNetwork& network,
                               WindowRequest request, const FlowNoise& noise);

/// The same in steps of one network evaluation. Model and network must outlive it.
class WindowSampler {
 public:
  WindowSampler(const FlowModelParts& model, const FlowNetwork& network, WindowRequest request,
                const FlowNoise& noise);
  ~WindowSampler();
  WindowSampler(WindowSampler&&) noexcept;
  WindowSampler& operator=(WindowSampler&&) noexcept;

  /// Makes the next evaluation; true while more are left.
  bool Continue();
  /// The result of SampleWindow, once none is left.
  std::vector<Pose> TakePoses();

 private:
  class Pass;
  const FlowModelParts* model_;
  const FlowNetwork* network_;
  FlowNoise noise_;
  WindowRequest request_;
  std::unique_ptr<Pass> pass_;            // running; null: not begun
  std::vector<Pose> mirrored_, sampled_;  // results
};

}  // namespace choreo
