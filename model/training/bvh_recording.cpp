#include "model/training/bvh_recording.h"

#include "model/fit/bone_normaliser.h"
#include "model/fit/bvh_source.h"
#include "model/formats/bvh.h"

namespace choreo {

Recording ReadBvhRecording(const std::filesystem::path& path, const std::string& name,
                           const PrepareOptions& options) {
  Recording recording;
  recording.name = name;
  const BvhFile bvh = ReadBvh(path);
  recording.positions = BvhToPositions(bvh, 1.0);
  recording.positions.fps = ForClip(options.frame_rates, name, bvh.fps());
  recording.mapping = BvhSource(recording.positions);
  // Units are not stated anywhere in a BVH: the dancer's legs tell centimetres from inches.
  const BoneNormaliser normaliser(recording.skeleton, recording.mapping,
                                  recording.positions.joint_names);
  const double scale = normaliser.Measure(recording.positions).scale;
  for (auto& frame : recording.positions.frames) frame *= scale;
  recording.time_scale = ForClip(options.time_scales, name, 1.0);
  return recording;
}

}  // namespace choreo
