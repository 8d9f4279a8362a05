#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "model/engine/flow_tile.h"
#include "model/engine/slot_engine.h"
#include "model/flow/flow_config.h"
#include "model/motion/contacts.h"
#include "model/motion/kinematics.h"
#include "model/motion/pose_codec.h"

namespace choreo {

/// What paper F's engine keeps of one transition in progress: the features of the last tau emitted
/// frames, the last tau + 1 music rows, and where it stands. Features are encoded anew from the
/// poses that StepInput::previous hands back, so a transition is a function of poses alone.
///
/// Per frame: Advance, FillRow, Finish. Nothing allocates there. Not thread-safe.
class TransitionWindow {
 public:
  /// The spec is valid (ValidateSpec); `model` must outlive this.
  TransitionWindow(const ModelInfo& model, const TransitionSpec& spec);

  SlotProgress progress() const { return progress_; }
  /// Moves the windows on by what was emitted and what is heard; `input` is what the next frame
  /// needs (ValidateStep).
  void Advance(const StepInput& input);
  /// What the frame to be stepped is made of. It looks into this window, until the next Advance.
  void FillRow(FlowRow* row) const;
  /// Decodes what the model made of that row; the frame is then done.
  void Finish(const FlowRow& row, StepOutput* output);

 private:
  Eigen::Map<Eigen::VectorXf> PastRow(int row) {
    return {past_.data() + static_cast<std::ptrdiff_t>(row) * codec_.width(), codec_.width()};
  }

  const ModelInfo* model_;
  PoseCodec codec_;
  std::vector<float> past_;   // [tau, width], oldest first
  std::vector<float> audio_;  // [tau + 1, audio_features]

  SlotProgress progress_;
  FrameNoise noise_;  // of the frame to be stepped
  Pose last_;         // emitted before it
  JointPlacement last_placement_;
  ContactDetector contacts_;

  // Kept for their memory.
  JointPlacement placement_;
  PoseCodec::Decoded decoded_;
};

/// Paper F's flow in slots, whatever computes its tile. Made by engines.h.
class FlowEngine : public SlotEngine<TransitionWindow> {
 public:
  FlowEngine(ModelInfo info, FlowConfig config, std::string device, int slots,
             std::unique_ptr<FlowTile> tile);

  int batch() const override { return tile_->rows(); }

 protected:
  TransitionWindow Begin(const TransitionSpec& spec, int slot) override;
  void StepSlots(std::span<const StepInput> in, std::span<StepOutput> out) override;

 private:
  FlowConfig config_;
  std::unique_ptr<FlowTile> tile_;
  std::vector<FlowRow> rows_;    // of one tile
  std::vector<float> features_;  // [rows of a tile, width]
};

}  // namespace choreo
