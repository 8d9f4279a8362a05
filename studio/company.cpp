#include "studio/company.h"

#include <filesystem>
#include <fstream>
#include <utility>

#include "client/authoring/dance_keys.h"
#include "client/authoring/formation.h"
#include "client/authoring/key_file.h"
#include "client/convert.h"
#include "model/core/atomic_file.h"
#include "model/formats/gltf.h"
#include "model/formats/motion_file.h"
#include "studio/from_page.h"
#include "studio/scratch_folder.h"

namespace choreo::studio {
namespace {

/// Keeps files for reading in a folder of ours, by name: the page knows no paths.
void Keep(const google::protobuf::RepeatedPtrField<File>& files, const ScratchFolder& folder) {
  for (const File& file : files) {
    const std::filesystem::path name = std::filesystem::path(file.name()).filename();
    std::ofstream(folder.path() / name, std::ios::binary) << file.data();
  }
}

/// A dancer's own keys, of these files or in the dancer's own text.
void DescribeKeys(const authoring::Dancer& dancer, const ScratchFolder& folder,
                  const Skeleton& skeleton, const authoring::Counts& counts, StageDancer* said) {
  said->set_has_keys(!dancer.keyframes.empty());
  for (const std::string& source : authoring::KeySources(dancer.keyframes)) {
    const bool is_text = source.starts_with('{');
    const std::string kept =
        is_text ? source : (folder.path() / std::filesystem::path(source).filename()).string();
    if (!is_text && !std::filesystem::exists(authoring::FileOf(kept))) {
      throw Error(ErrorCode::kNotFound, std::filesystem::path(source).filename().string(),
                  "has keys of " + dancer.id + ": open it together with the project");
    }
    try {
      for (const client::KeyPose& key : authoring::ReadKeys(kept, skeleton, nullptr, counts))
        *said->add_keys() = client::ToProto(key);
    } catch (const Error& error) {
      std::string message = error.what();
      const std::string path = folder.path().string() + "/";
      if (message.starts_with(path)) message.erase(0, path.size());
      throw Error(error.code(), "", message);
    }
  }
}

void Describe(const authoring::Dancers& stage, const ScratchFolder& folder,
              const Skeleton& skeleton, const authoring::Counts& counts, Formation* formation) {
  formation->set_apart(stage.apart);
  for (const authoring::Dancer& dancer : stage.dancers) {
    StageDancer* said = formation->add_dancers();
    said->set_id(dancer.id);
    said->set_x(dancer.place.x());
    said->set_z(dancer.place.y());
    said->set_facing(dancer.facing);
    said->set_mirrored(dancer.mirrored);
    said->set_after(dancer.after ? dancer.after->amount : 0);
    said->set_in_counts(dancer.after && dancer.after->counts);
    if (dancer.seed) said->set_seed(*dancer.seed);
    said->set_style(dancer.style);
    DescribeKeys(dancer, folder, skeleton, counts, said);
  }
}

void AddFile(const std::string& name, const std::filesystem::path& path, Formation* formation) {
  File* file = formation->add_files();
  file->set_name(name);
  file->set_data(ReadFile(path));
}

void WriteAll(const Skeleton& skeleton, const authoring::Dancers& stage,
              const std::vector<client::FinishedDance>& dances, const std::string& name,
              Formation* formation) {
  RequireWrittenMotionFile(name);
  const ScratchFolder folder;
  const std::filesystem::path path = folder.path() / ("file" + SmallExtension(name));
  if (path.extension() == ".glb") {
    std::vector<NamedMotion> motions;
    for (size_t i = 0; i < dances.size(); ++i)
      motions.push_back({stage.dancers[i].id, dances[i].motion});
    WriteGlb(path, skeleton, motions);
    return AddFile(name, path, formation);
  }
  const std::filesystem::path named(name);
  for (size_t i = 0; i < dances.size(); ++i) {
    const auto& [motion, contacts] = dances[i];
    WriteMotion(path, skeleton, motion, contacts.empty() ? nullptr : &contacts);
    AddFile(named.stem().string() + "." + stage.dancers[i].id + named.extension().string(), path,
            formation);
  }
}

}  // namespace

Response FormCompany(const StudioContext& context, const Company& request) {
  const Skeleton& skeleton = context.model().skeleton;
  const std::string& name = request.dancers().name();
  const authoring::Dancers stage = authoring::ParseDancers(request.dancers().data(), name, "");
  const ScratchFolder folder;
  Keep(request.key_files(), folder);
  Response response;
  Formation* formation = response.mutable_formation();
  Describe(stage, folder, skeleton, CountsIn(request), formation);
  if (request.dances().empty()) return response;

  const std::vector<double> beats(request.beats().begin(), request.beats().end());
  CheckBeats(beats, "company.beats");
  if (request.dance_of_size() != formation->dancers_size())
    throw InvalidArgument("company.dance_of", "is not of each dancer");
  std::vector<client::FinishedDance> dances;
  for (size_t i = 0; i < stage.dancers.size(); ++i) {
    const uint32_t nth = request.dance_of(static_cast<int>(i));
    if (nth >= static_cast<uint32_t>(request.dances_size()))
      throw InvalidArgument("company.dance_of", std::to_string(nth) + " is none of the dances");
    client::FinishedDance dance = FromProto(request.dances(static_cast<int>(nth)), skeleton);
    const double fps = dance.motion.fps;
    const auto frames = std::ssize(dance.motion.frames);
    if (!dances.empty() &&
        (frames != std::ssize(dances.front().motion.frames) || fps != dances.front().motion.fps))
      throw InvalidArgument("company.dances", "are not equally long");
    const std::string field = name + ":dancers[" + std::to_string(i) + "].after";
    const int64_t later = authoring::FramesLater(stage.dancers[i].after, beats, fps, frames, field);
    dances.push_back(authoring::OnStage(skeleton, stage.dancers[i], std::move(dance), later));
  }
  const authoring::Formed formed =
      authoring::KeepApart(stage.dancers, stage.apart, skeleton, &dances);
  formation->set_widened(formed.factor);
  if (const auto& nearest = formed.nearest) {
    formation->set_least(nearest->distance.metres);
    formation->set_one(static_cast<uint32_t>(nearest->one));
    formation->set_other(static_cast<uint32_t>(nearest->other));
    formation->set_at(static_cast<double>(nearest->distance.frame) / dances.front().motion.fps);
  }
  if (!request.name().empty()) WriteAll(skeleton, stage, dances, request.name(), formation);
  return response;
}

}  // namespace choreo::studio
