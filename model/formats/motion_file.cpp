#include "model/formats/motion_file.h"

#include <algorithm>
#include <cctype>

#include "model/core/error.h"
#include "model/formats/amass_npz.h"
#include "model/formats/bvh.h"
#include "model/formats/gltf.h"
#include "model/formats/npz.h"
#include "model/motion/fit.h"
#include "model/motion/fit_sources.h"

namespace choreo {
namespace {

Motion MotionFromBvh(const BvhFile& file, const Skeleton& skeleton) {
  if (IsBvhOf(file, skeleton)) return BvhToMotion(file, skeleton);
  // The fit sizes the source by its legs: the file's unit does not matter.
  const PositionClip clip = BvhToPositions(file, 0.01);
  return FitClip(clip, BvhSource(clip), skeleton).motion;
}

}  // namespace

std::string SmallExtension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return extension;
}

bool IsMotionFile(const std::filesystem::path& path) {
  const std::string extension = SmallExtension(path);
  return extension == ".npz" || extension == ".bvh" || extension == ".glb";
}

void RequireMotionFile(const std::filesystem::path& path) {
  if (!IsMotionFile(path)) {
    throw InvalidArgument(path.string(), "has the extension '" + path.extension().string() +
                                             "', must be .npz, .bvh or .glb");
  }
}

Motion ReadMotion(const std::filesystem::path& path, const Skeleton& skeleton) {
  RequireMotionFile(path);
  const std::string extension = SmallExtension(path);
  Motion motion;
  if (extension == ".glb") {
    motion = ReadGlb(path, skeleton);
  } else if (extension == ".npz") {
    const NpzArchive npz = NpzArchive::Read(path);
    try {
      motion = ReadSmplMotion(npz);
    } catch (const Error& error) {
      throw Error(error.code(), path.string(), error.what());
    }
  } else {
    const BvhFile file = ReadBvh(path);
    try {
      if (file.frames() > 0) motion = MotionFromBvh(file, skeleton);
    } catch (const Error& error) {
      throw Error(error.code(), path.string(), error.what());
    }
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
  RequireMotionFile(path);
  const std::string extension = SmallExtension(path);
  if (extension == ".glb") {
    WriteGlb(path, skeleton, motion);
  } else if (extension == ".npz") {
    NpzArchive npz;
    AddSmplMotion(skeleton, motion, contacts, npz);
    npz.Write(path);
  } else {
    WriteBvh(path, MotionToBvh(skeleton, motion));
  }
}

}  // namespace choreo
