#include "client/cli/report/dance_file.h"

#include <utility>
#include <vector>

#include "client/authoring/keys/motion_input.h"
#include "model/core/error.h"
#include "model/core/files/small_extension.h"
#include "model/formats/containers/npz.h"

namespace choreo::cli {
namespace {

std::vector<Contacts> ReadContacts(const std::filesystem::path& path, size_t frames) {
  if (SmallExtension(path) != ".npz") return {};
  const NpzArchive npz = NpzArchive::Read(path);
  if (!npz.Has("contacts")) return {};
  const NpyArray array = npz.Array("contacts");
  if (array.shape != std::vector{static_cast<int64_t>(frames), int64_t{4}}) {
    throw InvalidArgument(path.string() + ":contacts", "has not four values for each of the " +
                                                           std::to_string(frames) + " frames");
  }
  const std::vector<float> values = array.As<float>();
  std::vector<Contacts> contacts(frames);
  for (size_t i = 0; i < values.size(); ++i) contacts[i / 4][i % 4] = values[i];
  return contacts;
}

}  // namespace

DanceFile ReadDance(const std::filesystem::path& path) {
  SkeletonMotion read = authoring::ReadMotionNoting(path);
  std::vector<Contacts> contacts = ReadContacts(path, read.motion.frames.size());
  return {std::move(read.skeleton), {std::move(read.motion), std::move(contacts)}};
}

client::FinishedDance ReadDance(const std::filesystem::path& path, const Skeleton& skeleton) {
  client::FinishedDance dance;
  dance.motion = authoring::ReadMotionNoting(path, skeleton, OtherSkeleton::kRefuse);
  dance.contacts = ReadContacts(path, dance.motion.frames.size());
  return dance;
}

}  // namespace choreo::cli
