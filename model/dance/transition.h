#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/engine/sampler.h"
#include "model/messages/dance_event.h"
#include "model/motion/canonical.h"
#include "model/motion/motion.h"
#include "model/plan/arrival.h"
#include "model/plan/footwork.h"

namespace choreo {

/// One transition as its caller knows it: a spec in the world frame. Its history may have any
/// number of poses: the last tau count, fewer are filled by holding the earliest, none is the
/// neutral stance at the origin. What height a target without a place has need not be said.
struct TransitionRequest : TransitionSpec {
  /// One frame after the key, where the motion that follows stands already.
  std::optional<Pose> after;
  // To measure the model alone: 0 and false.
  int arrival_frames = 12;  ///< Arrival's window
  bool footwork = true;
};

/// One finished frame.
struct DanceFrame {
  Pose pose;  ///< world; every number is a float's, as it is sent, and the chain goes on from these
  Contacts contacts = {};                    ///< the model's own without footwork
  std::optional<float> log_likelihood = {};  ///< nats; none where the model has no exact one
  /// What velocity factors ask of this frame, by BodyPart, metres a frame; none: nothing.
  std::optional<std::array<float, kBodyParts>> asked_speeds = {};
};

/// The end of a transition: all that a server elsewhere needs to go on with the dance.
struct Continuation {
  int64_t frame = 0;        ///< first frame that has not been danced; model rate, absolute
  std::vector<Pose> poses;  ///< tau poses before it, oldest first, world; every number is a float's
  std::string fingerprint;  ///< of the model and build that danced
  /// First sample that a resumed dance needs; none: unknown.
  std::optional<int64_t> audio_from_sample = {};
  std::optional<double> last_beat = {};       ///< MusicBeats::last at this frame
  std::optional<Eigen::Vector3d> stage = {};  ///< TransitionRequest::stage, its height unread
};

/// Speeds that the way to a key asks for on average. Paper F, Section 5.2: too short an interval
/// for too large a change fails.
struct RequiredSpeed {
  double root_m_per_s = 0;
  double joint_rad_per_s = 0;  ///< of the fastest joint
  int joint = 0;
  /// Limits beyond which the stream warns: a sprint, and the fastest limbs of real dances.
  static constexpr double kRootLimit = 5.0;
  static constexpr double kJointLimit = 15.0;
  bool TooFast() const { return root_m_per_s > kRootLimit || joint_rad_per_s > kJointLimit; }
};

/// One transition on its way to the dance: sampled, steered onto its key, put on its feet, slice by
/// slice. A pure function of the request and the model; the same code serves streams, single
/// transitions, training and evaluation. Not thread-safe.
class TransitionRun {
 public:
  /// Throws Error(kInvalidArgument) for a request of the wrong shape ("frames",
  /// "history[2].rotations", ...).
  TransitionRun(const ModelInfo& model, const TransitionRequest& request);

  const TransitionSpec& spec() const { return spec_; }

  /// Makes the next slice with this sampler, the same one each time. True while more are left.
  /// Throws Error(kInternal) for a value that is not finite, be it the model's or made of its frame
  /// here, and Error(kInvalidArgument) as Sampler::Begin does.
  bool Continue(Sampler& sampler);

  /// All of them, once Continue has returned false.
  const std::vector<DanceFrame>& frames() const { return frames_; }
  /// After the last frame of a transition with a target; its id is for the caller to say.
  const std::optional<KeyReached>& arrival() const { return arrival_result_; }
  /// TransitionRequest::stage for a dance that continues after so many of the frames. A path, or a
  /// key that places the root, moves it there.
  Eigen::Vector3d StageAfter(size_t frames) const;
  /// None without a target.
  std::optional<RequiredSpeed> required_speed() const;

 private:
  void Steer();
  void PutOnFeet();
  DanceFrame Finish(size_t at);
  void TellArrival();
  void CheckFinite(size_t frame, const Pose& pose, std::span<const float> contacts,
                   const std::string& whose) const;

  const ModelInfo* model_;
  TransitionSpec spec_;
  std::optional<Target> world_target_;
  GroundFrame ground_;
  int arrival_window_ = 0;  // 0: nothing is steered
  bool footwork_;
  Eigen::Vector3d stage_;  // of the request, world
  Pose world_;             // the newest frame, whose signs are kept

  std::unique_ptr<Sampling> sampling_;
  Plan drawn_;              // once it is sampled
  std::vector<Pose> plan_;  // canonical, steered; those of frames_ stand on their feet
  Eigen::Matrix<double, 3, 2> offset_ = Eigen::Matrix<double, 3, 2>::Zero();  // Footwork::offset
  std::vector<DanceFrame> frames_;
  std::optional<KeyReached> arrival_result_;
  double correction_m_ = 0;
};

/// All slices at once; `danced` is told how many frames were made. Throws as TransitionRun does.
TransitionRun DanceTransition(Sampler& sampler, const TransitionRequest& request,
                              const std::function<void(int)>& danced = {});

/// The history that a transition has when it is given `poses`: exactly tau poses, each number a
/// float's.
std::vector<Pose> FillHistory(const ModelInfo& model, std::span<const Pose> poses);
/// The oldest pose makes way for the newest; allocates nothing.
void MoveOn(const Pose& newest, std::vector<Pose>* history);

/// Rounds every number to float precision: what a client that got the frames as floats knows of
/// them.
Pose RoundToFloat(const Pose& pose);

/// Of the music's beats, in seconds, ascending, those of frames [first_frame, first_frame +
/// frames), one before and one behind, as TransitionRequest::beats: in frames from the first.
std::vector<double> BeatsAround(std::span<const double> seconds, double fps, int64_t first_frame,
                                int frames);

}  // namespace choreo
