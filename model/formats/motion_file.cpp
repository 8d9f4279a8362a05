#include "model/formats/motion_file.h"

#include "model/core/error.h"
#include "model/formats/amass_npz.h"
#include "model/formats/bvh.h"
#include "model/formats/npz.h"
#include "model/motion/fit.h"
#include "model/motion/fit_sources.h"

namespace choreo {
namespace {

Error UnknownExtension(const std::filesystem::path& path) {
  return InvalidArgument(
      path.string(), "has the extension '" + path.extension().string() + "', must be .npz or .bvh");
}

Motion MotionFromBvh(const BvhFile& file, const Skeleton& skeleton) {
  if (IsBvhOf(file, skeleton)) return BvhToMotion(file, skeleton);
  // The fit sizes the source by its legs: the file's unit does not matter.
  const PositionClip clip = BvhToPositions(file, 0.01);
  return FitClip(clip, BvhSource(clip), skeleton).motion;
}

}  // namespace

Motion ReadMotion(const std::filesystem::path& path, const Skeleton& skeleton) {
  const std::string extension = path.extension().string();
  Motion motion;
  if (extension == ".npz") {
    const NpzArchive npz = NpzArchive::Read(path);
    try {
      motion = ReadSmplMotion(npz);
    } catch (const Error& error) {
      throw Error(error.code(), path.string(), error.what());
    }
  } else if (extension == ".bvh") {
    const BvhFile file = ReadBvh(path);
    try {
      if (file.frames() > 0) motion = MotionFromBvh(file, skeleton);
    } catch (const Error& error) {
      throw Error(error.code(), path.string(), error.what());
    }
  } else {
    throw UnknownExtension(path);
  }
  if (motion.frames.empty()) throw InvalidArgument(path.string(), "has no frames");
  if (motion.frames.front().rotations.cols() != skeleton.joints()) {
    throw InvalidArgument(path.string(),
                          "has " + std::to_string(motion.frames.front().rotations.cols()) +
                              " joints, the skeleton has " + std::to_string(skeleton.joints()));
  }
  return motion;
}

void WriteMotion(const std::filesystem::path& path, const Skeleton& skeleton, const Motion& motion,
                 const std::vector<Contacts>* contacts) {
  const std::string extension = path.extension().string();
  if (extension == ".npz") {
    NpzArchive npz;
    AddSmplMotion(skeleton, motion, contacts, npz);
    npz.Write(path);
  } else if (extension == ".bvh") {
    WriteBvh(path, MotionToBvh(skeleton, motion));
  } else {
    throw UnknownExtension(path);
  }
}

}  // namespace choreo
