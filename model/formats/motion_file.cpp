#include "model/formats/motion_file.h"

#include <algorithm>
#include <iterator>
#include <new>
#include <utility>

#include "model/core/error.h"
#include "model/core/files/atomic_file.h"
#include "model/core/files/npy.h"
#include "model/core/files/small_extension.h"
#include "model/core/grid.h"
#include "model/fit/retarget.h"
#include "model/formats/arrays/amass_npz.h"
#include "model/formats/arrays/frame_rows.h"
#include "model/formats/arrays/joint_arrays.h"
#include "model/formats/bvh/any_bvh.h"
#include "model/formats/bvh/bvh.h"
#include "model/formats/containers/npz.h"
#include "model/formats/containers/pickle.h"
#include "model/formats/gltf/gltf.h"
#include "model/motion/pose/pose_limits.h"
#include "model/motion/skeleton_json.h"

namespace choreo {
namespace {

SkeletonMotion ReadPickled(std::string_view pickle, const std::filesystem::path& path,
                           const MotionReading& reading) {
  return {Skeleton::Smpl24(), ReadSmplMotion(ParsePickledArrays(pickle, path.string()), reading)};
}

// Adds Python objects among the arrays: numbers and dicts. Other objects do not matter for the
// motion.
void TakePickled(const std::string& key, const std::string& pickle, NpzArchive* npz) {
  try {
    npz->SetArray(key, ParsePickledArray(pickle, key));
  } catch (const Error&) {
    try {
      npz->SetNested(key, ParsePickledArrays(pickle, key));
    } catch (const Error&) {
      // Reading it refuses it.
    }
  }
}

SkeletonMotion ReadAnyNpz(const std::filesystem::path& path, const Skeleton*,
                          const MotionReading& reading) {
  NpzArchive npz = NpzArchive::Read(path);
  const std::vector<std::string> names = npz.Names();
  for (const std::string& name : names) {
    const std::string_view pickle = npz.Pickle(name);
    if (pickle.empty()) continue;
    if (names.size() == 1) return ReadPickled(pickle, path, reading);
    TakePickled(name, std::string(pickle), &npz);
  }
  if (!npz.Has("skeleton")) return {Skeleton::Smpl24(), ReadSmplMotion(npz, reading)};
  reading.RefuseBody();
  const Skeleton skeleton = SkeletonFromJson(npz.Text("skeleton"));
  return {skeleton, ReadOwnArrays(skeleton, npz)};
}

SkeletonMotion ReadPickle(const std::filesystem::path& path, const Skeleton*,
                          const MotionReading& reading) {
  return ReadPickled(ReadFile(path), path, reading);
}

// A .npy file: a dict that numpy.save wrote, or an array of joint positions.
SkeletonMotion ReadObjects(const std::filesystem::path& path, const Skeleton*,
                           const MotionReading& reading) {
  const std::string bytes = ReadFile(path);
  const NpyParts parts = SplitNpy(bytes, path.string());
  if (parts.descr != kNpyObjects) {
    const NpyArray array = ReadNpyParts(parts, path.string());
    if (AreJointPlaces(array)) {
      const double fps = reading.fps > 0 ? reading.fps : kModelFps;
      if (!(reading.fps > 0)) reading.NoteRate(fps);
      return {Skeleton::Smpl24(), ReadJointPlaces(array, fps, reading)};
    }
    if (auto motion = ReadFrameRows(array, reading))
      return {Skeleton::Smpl24(), std::move(*motion)};
    throw InvalidArgument(path.string(), "holds one array and does not say of what, as rows of " +
                                             FrameRowWidths() + " numbers do: " + kWriteArrays);
  }
  return ReadPickled(parts.values, path, reading);
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

// A format of motion files. A new one is a new row below.
struct Format {
  const char* extension;
  // `preferred`: a skeleton to try first, or none.
  SkeletonMotion (*read)(const std::filesystem::path& path, const Skeleton* preferred,
                         const MotionReading& reading);
  // Null if it can only be read.
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
    {".gltf", ReadGlb, nullptr},
    {".vrma", ReadGlb,
     [](const auto& path, const auto& skeleton, const auto& motion, const auto*) {
       WriteVrma(path, skeleton, motion);
     }},
    {".pkl", ReadPickle, nullptr},
    {".npy", ReadObjects, nullptr},
};

// Other common formats and how to convert them.
constexpr std::pair<const char*, const char*> kOtherFormats[] = {
    {".fbx", "Blender imports it, and exports .glb or .bvh"},
    {".dae", "Blender imports it, and exports .glb or .bvh"},
    {".blend", "Blender exports .glb or .bvh"},
    {".usd", "Blender imports it, and exports .glb or .bvh"},
    {".usdz", "Blender imports it, and exports .glb or .bvh"},
    {".vrm", "it is a character (--character); its motions are .vrma"},
    {".vmd", "Blender's MMD tools import it, and export .bvh"},
    {".amc", "Blender imports it with its .asf, and exports .bvh"},
    {".c3d", "markers alone do not say how a body turns: solve them to .bvh"},
    {".pt", "write the arrays by numpy.savez"},
    {".pth", "write the arrays by numpy.savez"},
    {".pickle", "call it .pkl"},
};

const Format* FindFormat(const std::filesystem::path& path) {
  const auto found = std::ranges::find(kFormats, SmallExtension(path), &Format::extension);
  return found == std::end(kFormats) ? nullptr : found;
}

std::string Extensions(bool written) {
  std::vector<std::string> known;
  for (const Format& format : kFormats) {
    if (!written || format.write != nullptr) known.emplace_back(format.extension);
  }
  std::string text;
  for (size_t i = 0; i < known.size(); ++i)
    text += (i == 0 ? "" : i + 1 < known.size() ? ", " : " or ") + known[i];
  return text;
}

const Format& FormatOf(const std::filesystem::path& path, bool to_write) {
  const Format* format = FindFormat(path);
  if (format != nullptr && (!to_write || format->write != nullptr)) return *format;
  std::string way_out;
  for (const auto& [extension, way] : kOtherFormats) {
    if (!to_write && SmallExtension(path) == extension) way_out = std::string("; ") + way;
  }
  if (to_write && SmallExtension(path) == ".fbx") way_out = "; Blender exports FBX from these";
  throw InvalidArgument(path.string(), "has the extension '" + path.extension().string() +
                                           "', must be " + Extensions(to_write) + way_out);
}

SkeletonMotion Read(const std::filesystem::path& path, const Skeleton* preferred,
                    const MotionReading& reading) try {
  const std::string extension = SmallExtension(path);
  const bool gltf = extension == ".glb" || extension == ".gltf" || extension == ".vrma";
  CheckAngles(reading.angles);
  if (!reading.angles.empty() && gltf)
    throw InvalidArgument("--angles", "is for arrays and .bvh, not for " + path.string());
  if (!reading.animation.empty() && !gltf)
    throw InvalidArgument("--animation", "is for .glb, .gltf and .vrma, not for " + path.string());
  if (!reading.bones.empty() && !gltf && extension != ".bvh")
    throw InvalidArgument("--map",
                          "is for rigs, .bvh, .glb, .gltf and .vrma, not for " + path.string());
  SkeletonMotion read = FormatOf(path, false).read(path, preferred, reading);
  if (read.motion.frames.empty()) throw InvalidArgument("", "has no frames");
  CheckMotionLimits(read.motion);
  return read;
} catch (const UnknownBones& error) {
  throw UnknownBones(path.string(), error.missing(), error.rig(), error.found());
} catch (const Error& error) {
  const std::string& field = error.field();
  const bool named =
      field.starts_with("--") ||
      std::ranges::any_of(reading.bones, [&](const auto& choice) { return field == choice.field; });
  if (named || field.starts_with(path.string())) throw;
  throw Error(error.code(), path.string(), error.what());
} catch (const std::bad_alloc&) {
  throw InvalidArgument(path.string(), "takes more memory than there is");
}

}  // namespace

std::string MotionFileExtensions() { return Extensions(false); }

bool IsMotionFile(const std::filesystem::path& path) { return FindFormat(path) != nullptr; }

void RequireMotionFile(const std::filesystem::path& path) { FormatOf(path, false); }

void RequireWrittenMotionFile(const std::filesystem::path& path) { FormatOf(path, true); }

SkeletonMotion ReadMotion(const std::filesystem::path& path, const MotionReading& reading) {
  return Read(path, nullptr, reading);
}

Motion ReadMotion(const std::filesystem::path& path, const Skeleton& skeleton, OtherSkeleton other,
                  const MotionReading& reading) {
  SkeletonMotion read = Read(path, &skeleton, reading);
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
  FormatOf(path, true).write(path, skeleton, motion, contacts);
}

}  // namespace choreo
