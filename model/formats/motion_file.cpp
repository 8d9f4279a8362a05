#include "model/formats/motion_file.h"

#include <boost/algorithm/string/case_conv.hpp>
#include <utility>

#include "model/core/error.h"
#include "model/fit/fit_clip.h"
#include "model/fit/retarget.h"
#include "model/fit/sources.h"
#include "model/formats/amass_npz.h"
#include "model/formats/bvh.h"
#include "model/formats/gltf.h"
#include "model/formats/npz.h"
#include "model/motion/pose_limits.h"
#include "model/motion/skeleton_json.h"

namespace choreo {
namespace {

SkeletonMotion FromNpz(const NpzArchive& npz) {
  if (!npz.Has("skeleton")) return {Skeleton::Smpl24(), ReadSmplMotion(npz)};
  const Skeleton skeleton = SkeletonFromJson(npz.Text("skeleton"));
  return {skeleton, ReadOwnArrays(skeleton, npz)};
}

SkeletonMotion FromBvh(const BvhFile& file, const Skeleton* wanted) {
  const Skeleton& smpl = Skeleton::Smpl24();
  if (file.frames() == 0) return {smpl, {}};
  const auto own = BvhSkeleton(file);
  for (const Skeleton* known : {wanted, &smpl, own ? &*own : nullptr}) {
    if (known == nullptr) continue;
    if (auto motion = BvhToMotion(file, *known)) return {*known, std::move(*motion)};
  }
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
  return boost::algorithm::to_lower_copy(path.extension().string(), std::locale::classic());
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
      AddSmplMotion(motion, contacts, npz);
    } else {
      AddOwnArrays(skeleton, motion, contacts, npz);
      npz.SetText("skeleton", SkeletonToJson(skeleton));
    }
    npz.Write(path);
  } else {
    WriteBvh(path, MotionToBvh(skeleton, motion));
  }
}

}  // namespace choreo
