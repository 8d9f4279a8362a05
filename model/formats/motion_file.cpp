#include "model/formats/motion_file.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "model/core/error.h"
#include "model/fit/bvh_source.h"
#include "model/fit/fit_clip.h"
#include "model/fit/retarget.h"
#include "model/formats/amass_npz.h"
#include "model/formats/bvh.h"
#include "model/formats/gltf.h"
#include "model/formats/npz.h"
#include "model/motion/pose_limits.h"

namespace choreo {
namespace {

SkeletonMotion FromNpz(const NpzArchive& npz) {
  if (HasSkeletonMotion(npz)) return ReadSkeletonMotion(npz);
  return {Skeleton::Smpl24(), ReadSmplMotion(npz)};
}

SkeletonMotion FromBvh(const BvhFile& file, const Skeleton* wanted) {
  const Skeleton& smpl = Skeleton::Smpl24();
  if (file.frames() == 0) return {smpl, {}};
  for (const Skeleton* known : {wanted, &smpl}) {
    if (known != nullptr && IsBvhOf(file, *known)) return {*known, BvhToMotion(file, *known)};
  }
  if (const auto own = BvhSkeleton(file)) return {*own, BvhToMotion(file, *own)};
  // The fit sizes the source by its legs: the file's unit does not matter.
  const PositionClip clip = BvhToPositions(file, 0.01);
  return {smpl, FitClip(clip, BvhSource(clip), smpl).motion};
}

// `wanted`: a skeleton to try first, or none.
SkeletonMotion Read(const std::filesystem::path& path, const Skeleton* wanted) try {
  RequireMotionFile(path);
  const std::string extension = SmallExtension(path);
  SkeletonMotion read = extension == ".glb"   ? ReadGlb(path, wanted)
                        : extension == ".npz" ? FromNpz(NpzArchive::Read(path))
                                              : FromBvh(ReadBvh(path), wanted);
  if (read.motion.frames.empty()) throw InvalidArgument("", "has no frames");
  CheckMotionLimits(read.motion);
  return read;
} catch (const Error& error) {
  if (error.field().starts_with(path.string())) throw;
  throw Error(error.code(), path.string(), error.what());
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

SkeletonMotion ReadMotion(const std::filesystem::path& path) { return Read(path, nullptr); }

Motion ReadMotion(const std::filesystem::path& path, const Skeleton& skeleton,
                  OtherSkeleton other) {
  SkeletonMotion read = Read(path, &skeleton);
  if (SameBones(read.skeleton, skeleton)) return std::move(read.motion);
  if (other == OtherSkeleton::kRefuse) {
    throw InvalidArgument(path.string(), "its skeleton is " + read.skeleton.Describe() + ", not " +
                                             skeleton.Describe());
  }
  try {
    return Retarget(read.skeleton, read.motion, skeleton);
  } catch (const Error& error) {
    throw Error(error.code(), path.string(), error.what());
  }
}

void WriteMotion(const std::filesystem::path& path, const Skeleton& skeleton, const Motion& motion,
                 const std::vector<Contacts>* contacts) {
  RequireMotionFile(path);
  const std::string extension = SmallExtension(path);
  if (extension == ".glb") {
    WriteGlb(path, skeleton, motion);
  } else if (extension == ".npz") {
    NpzArchive npz;
    if (SameBones(skeleton, Skeleton::Smpl24())) {
      AddSmplMotion(skeleton, motion, contacts, npz);
    } else {
      AddSkeletonMotion(skeleton, motion, contacts, npz);
    }
    npz.Write(path);
  } else {
    WriteBvh(path, MotionToBvh(skeleton, motion));
  }
}

}  // namespace choreo
