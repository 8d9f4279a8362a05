#include "model/formats/motion_file.h"

#include <algorithm>
#include <boost/algorithm/string/case_conv.hpp>
#include <cmath>
#include <iterator>
#include <new>
#include <optional>
#include <utility>

#include "model/core/atomic_file.h"
#include "model/core/error.h"
#include "model/core/grid.h"
#include "model/core/npy.h"
#include "model/fit/retarget.h"
#include "model/formats/amass_npz.h"
#include "model/formats/bvh.h"
#include "model/formats/frame_rows.h"
#include "model/formats/gltf.h"
#include "model/formats/joint_arrays.h"
#include "model/formats/motion_check.h"
#include "model/formats/node_motion.h"
#include "model/formats/npz.h"
#include "model/formats/pickle.h"
#include "model/motion/pose_limits.h"
#include "model/motion/rotation.h"
#include "model/motion/skeleton_json.h"

namespace choreo {
namespace {

SkeletonMotion ReadPickled(std::string_view pickle, const std::filesystem::path& path,
                           const MotionReading& reading) {
  return {Skeleton::Smpl24(), ReadSmplMotion(ParsePickledArrays(pickle, path.string()), reading)};
}

// Python objects among the arrays: numbers, dicts, or things that the motion does not need.
void TakePickled(const std::string& key, const std::string& pickle, NpzArchive* npz) {
  try {
    npz->SetArray(key, ParsePickledArray(pickle, key));
  } catch (const Error&) {
    try {
      npz->SetNested(key, ParsePickledArrays(pickle, key));
    } catch (const Error&) {
      // Refused on access.
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

// The joints that move: those whose values differ between frames; if none do, those that have
// channels.
std::vector<bool> MovedJoints(const BvhFile& file) {
  std::vector<bool> moves, has;
  Eigen::Index row = 0;
  for (const BvhJoint& joint : file.joints) {
    bool differs = false;
    for (size_t i = 0; i < joint.channels.size(); ++i, ++row)
      differs = differs || file.values.row(row).maxCoeff() > file.values.row(row).minCoeff();
    moves.push_back(differs);
    has.push_back(!joint.channels.empty());
  }
  return std::ranges::find(moves, true) == moves.end() ? has : moves;
}

Motion FitBvh(const BvhFile& file, const MotionReading& reading) {
  NodeMotion motion{
      .fps = file.fps(), .rests = {PlaceBvhAtRest(file)}, .count = file.frames(), .frame = {}};
  motion.frame = [&](int64_t frame) { return PlaceBvh(file, frame); };
  RigNodes nodes{.names = file.JointNames(),
                 .parents = {},
                 .places = motion.rests[0].places,
                 .joints = std::vector<bool>(file.joints.size(), true),
                 .moves = MovedJoints(file),
                 .meshes = std::vector<bool>(file.joints.size())};
  for (const BvhJoint& joint : file.joints) nodes.parents.push_back(joint.parent);
  return FitNodes(std::move(nodes), motion, reading);
}

// Converts angles that look like radians to degrees: some exceed 1, and none exceeds a whole turn,
// except those of a root that keeps turning slowly.
std::optional<BvhFile> FromRadians(const BvhFile& file, const MotionReading& reading) {
  constexpr Eigen::Index kMinFrames = 10;  // fewer frames prove nothing
  constexpr double kTurn = 2 * M_PI + 1e-3, kLimb = 1;
  if (reading.angles == "degrees" || (reading.angles.empty() && file.frames() < kMinFrames))
    return std::nullopt;
  BvhFile turned = file;
  double farthest = 0, fastest = 0;
  int spinning = 0;
  Eigen::Index row = 0;
  for (const BvhJoint& joint : file.joints) {
    const bool is_root = joint.parent < 0 || joint.channels.size() > 3;
    bool exceeds = false;
    for (const BvhChannel channel : joint.channels) {
      if (channel >= BvhChannel::kXRotation && channel <= BvhChannel::kZRotation) {
        const Eigen::RowVectorXd angles = file.values.row(row);
        const double most = angles.cwiseAbs().maxCoeff();
        if (most < kTurn) {
          farthest = std::max(farthest, most);
        } else {
          exceeds = true;
          for (Eigen::Index frame = 1; frame < angles.size(); ++frame)
            fastest = std::max(fastest, std::abs(angles[frame] - angles[frame - 1]));
        }
        turned.values.row(row) *= kDegrees;
      }
      ++row;
    }
    if (exceeds) spinning += is_root ? 1 : 2;
  }
  const bool may_be = farthest > kLimb && spinning <= 1 && fastest < kLimb;
  return reading.angles == "radians" || may_be ? std::optional(std::move(turned)) : std::nullopt;
}

SkeletonMotion TakeBvh(const BvhFile& file, const Skeleton* wanted, const MotionReading& reading) {
  const Skeleton& smpl = Skeleton::Smpl24();
  const auto own = BvhSkeleton(file);
  for (const Skeleton* known : {wanted, &smpl, own ? &*own : nullptr}) {
    if (known == nullptr || reading.chooses()) continue;
    if (auto motion = BvhToMotion(file, *known)) return {*known, std::move(*motion)};
  }
  return {smpl, FitBvh(file, reading)};
}

SkeletonMotion ReadAnyBvh(const std::filesystem::path& path, const Skeleton* wanted,
                          const MotionReading& reading) {
  BvhFile file = ReadBvh(path);
  for (const std::string& note : file.notes) reading.Note(note);
  if (!file.states_rate && reading.fps > 0) file.frame_time = 1 / reading.fps;
  if (!file.states_rate && !(reading.fps > 0) && file.frames() > 1) reading.NoteRate(file.fps());
  if (file.frames() == 0) return {Skeleton::Smpl24(), {}};
  if (const std::optional<BvhFile> turned = FromRadians(file, reading)) {
    if (!reading.angles.empty()) return TakeBvh(*turned, wanted, reading);
    std::vector<std::string> notes;
    MotionReading quietly = reading;
    quietly.notes = &notes;
    SkeletonMotion read = TakeBvh(*turned, wanted, quietly);
    // A dancer who sways a little in degrees would bend knees and elbows backwards in radians.
    if (ShareOfFaults(read.skeleton, read.motion) < 0.1) {
      reading.Note(
          "its angles are taken as radians, as they are so small; --angles degrees says otherwise");
      for (const std::string& note : notes) reading.Note(note);
      return read;
    }
    reading.Note(
        "its angles are taken as degrees, though they are small; --angles radians says otherwise");
  }
  return TakeBvh(file, wanted, reading);
}

// A format of motion files. A new one is a new row below.
struct Format {
  const char* extension;
  // `wanted`: a skeleton to try first, or none.
  SkeletonMotion (*read)(const std::filesystem::path& path, const Skeleton* wanted,
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

// Other formats that people try, and how to convert them.
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
  throw InvalidArgument(path.string(), "has the extension '" + path.extension().string() +
                                           "', must be " + Extensions(to_write) + way_out);
}

SkeletonMotion Read(const std::filesystem::path& path, const Skeleton* wanted,
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
  SkeletonMotion read = FormatOf(path, false).read(path, wanted, reading);
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

std::string SmallExtension(const std::filesystem::path& path) {
  return boost::algorithm::to_lower_copy(path.extension().string(), std::locale::classic());
}

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
