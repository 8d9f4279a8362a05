#include "model/formats/motion_file.h"

#include <algorithm>
#include <boost/algorithm/string/case_conv.hpp>
#include <iterator>
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

SkeletonMotion ReadAnyNpz(const std::filesystem::path& path, const Skeleton*) {
  const NpzArchive npz = NpzArchive::Read(path);
  if (!npz.Has("skeleton")) return {Skeleton::Smpl24(), ReadSmplMotion(npz)};
  const Skeleton skeleton = SkeletonFromJson(npz.Text("skeleton"));
  return {skeleton, ReadOwnArrays(skeleton, npz)};
}

void WriteNpz(const std::filesystem::path& path, const Skeleton& skeleton, const Motion& motion,
              const std::vector<Contacts>* contacts) {
  NpzArchive npz;
  if (SameBones(skeleton, Skeleton::Smpl24())) {
    AddSmplMotion(motion, contacts, npz);
  } else {
    AddOwnArrays(skeleton, motion, contacts, npz);
    npz.SetText("skeleton", SkeletonToJson(skeleton));
  }
  npz.Write(path);
}

SkeletonMotion ReadAnyBvh(const std::filesystem::path& path, const Skeleton* wanted) {
  const BvhFile file = ReadBvh(path);
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

// What a motion file may be. One more is a row.
struct Format {
  const char* extension;
  // `wanted`: a skeleton to try first, or none.
  SkeletonMotion (*read)(const std::filesystem::path& path, const Skeleton* wanted);
  void (*write)(const std::filesystem::path& path, const Skeleton& skeleton, const Motion& motion,
                const std::vector<Contacts>* contacts);
};
constexpr Format kFormats[] = {
    {".npz", ReadAnyNpz, WriteNpz},
    {".bvh", ReadAnyBvh,
     [](const auto& path, const auto& skeleton, const auto& motion, const auto*) {
       WriteBvh(path, MotionToBvh(skeleton, motion));
     }},
    {".glb", ReadGlb,
     [](const auto& path, const auto& skeleton, const auto& motion, const auto*) {
       WriteGlb(path, skeleton, motion);
     }},
};

const Format* FindFormat(const std::filesystem::path& path) {
  const auto found = std::ranges::find(kFormats, SmallExtension(path), &Format::extension);
  return found == std::end(kFormats) ? nullptr : found;
}

const Format& FormatOf(const std::filesystem::path& path) {
  if (const Format* format = FindFormat(path)) return *format;
  throw InvalidArgument(path.string(), "has the extension '" + path.extension().string() +
                                           "', must be " + MotionFileExtensions());
}

SkeletonMotion Read(const std::filesystem::path& path, const Skeleton* wanted) try {
  SkeletonMotion read = FormatOf(path).read(path, wanted);
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

std::string MotionFileExtensions() {
  std::string known;
  for (const Format& format : kFormats) {
    const bool last = &format == std::end(kFormats) - 1;
    known += std::string(known.empty() ? "" : last ? " or " : ", ") + format.extension;
  }
  return known;
}

bool IsMotionFile(const std::filesystem::path& path) { return FindFormat(path) != nullptr; }

void RequireMotionFile(const std::filesystem::path& path) { FormatOf(path); }

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
  FormatOf(path).write(path, skeleton, motion, contacts);
}

}  // namespace choreo
