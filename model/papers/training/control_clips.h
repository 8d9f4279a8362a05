#pragma once

#include <array>
#include <vector>

#include "model/core/numbers/random.h"
#include "model/motion/controls/velocity_factors.h"
#include "model/motion/skeleton.h"
#include "model/papers/networks/controlled_frames.h"
#include "model/training/clips/prepared_clip.h"
#include "model/training/windows/window_picker.h"

namespace choreo {

/// A batch of windows of real motion, with controls that describe them.
struct ControlBatch {
  ControlledTransition transition;
  FrameTensors truth;     ///< the N frames
  torch::Tensor factors;  ///< [batch, N, 5] expected factors: the real ones, scaled if the controls
                          ///< are scaled
  torch::Tensor
      weight;  ///< [batch] weight of the real motion: small if it does not match the controls
};

/// Draws training windows for the controllers network from clips at several tempi, mirrored or not.
/// Immutable after construction; thread-safe.
class ControlClips {
 public:
  explicit ControlClips(const std::vector<PreparedClip>& clips);

  /// The probability of each variation in training. All zero: real windows with their own controls.
  struct Variation {
    double mirror = 0;
    double tempo = 0;  ///< played faster or slower
    double no_target = 0;
    double smooth_path = 0;     ///< the path is smoothed, as if drawn by hand
    double smooth_factors = 0;  ///< the factors are averaged over time
    double scale_factors = 0;   ///< the factors are 0.5 to 1.5 times the real ones
  };
  /// Draws `batch` windows of N = `frames` after `history` frames.
  ControlBatch Draw(int batch, int history, int frames, const Variation& variation,
                    Random* random) const;

  /// The longest window at the clips' own tempo, frames.
  int64_t Longest() const;
  /// The median of each velocity factor over all frames, metres per frame.
  std::array<double, kBodyParts> MedianFactors() const;

 private:
  struct Track {
    int64_t frames = 0;
    // Row-major: [frames, ...]
    std::vector<float> root, heading, joints, contacts, factors;
  };
  // A window's place in a track.
  struct Place {
    const Track& track;
    int64_t start;
  };

  Track MakeTrack(const PreparedClip& clip, double tempo, bool mirrored) const;
  Place DrawPlace(const WindowPicker& picker, int window, const Variation& variation,
                  Random* random) const;
  const Track& At(size_t clip, size_t tempo, bool mirrored) const {
    return tracks_[(clip * tempi_ + tempo) * 2 + (mirrored ? 1 : 0)];
  }

  Skeleton skeleton_;
  size_t clips_ = 0, tempi_ = 0;
  std::vector<Track> tracks_;
};

}  // namespace choreo
