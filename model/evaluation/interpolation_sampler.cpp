#include "model/evaluation/interpolation_sampler.h"

#include <utility>

#include "model/motion/resample.h"

namespace choreo {
namespace {

ModelInfo Named(ModelInfo model) {
  model.name = model.fingerprint = "interpolation";
  return model;
}

class Interpolation : public Sampling {
 public:
  explicit Interpolation(const TransitionSpec& spec) : spec_(spec) {}

  bool Continue() override {
    const Pose& from = spec_.history.back();
    const Pose& to = spec_.target ? spec_.target->pose : from;
    for (int frame = 0; frame < spec_.frames; ++frame) {
      Pose& pose = plan_.poses.emplace_back(
          InterpolatePoses(from, to, (frame + 1.0) / static_cast<double>(spec_.frames)));
      if (spec_.controls[kRootPath].IsGiven())
        pose.root_position = spec_.controls[kRootPath].values.col(frame);
    }
    plan_.contacts.resize(plan_.poses.size());
    return false;
  }

 private:
  const TransitionSpec spec_;
};

}  // namespace

InterpolationSampler::InterpolationSampler(ModelInfo model)
    : Sampler(Named(std::move(model)), "cpu") {}

std::unique_ptr<Sampling> InterpolationSampler::BeginValid(const TransitionSpec& spec) {
  return std::make_unique<Interpolation>(spec);
}

}  // namespace choreo
