#include "studio/company.h"

#include <filesystem>
#include <utility>

#include "client/authoring/formation.h"
#include "client/authoring/music_beats.h"
#include "model/core/atomic_file.h"
#include "model/formats/gltf.h"
#include "model/formats/motion_file.h"
#include "studio/from_page.h"
#include "studio/scratch_folder.h"

namespace choreo::studio {
namespace {

void Describe(const authoring::Dancers& stage, Formation* formation) {
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
    said->set_has_keys(!dancer.keyframes.empty());
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
  Response response;
  Formation* formation = response.mutable_formation();
  Describe(stage, formation);
  if (request.dances().empty()) return response;

  const std::vector<double> beats(request.beats().begin(), request.beats().end());
  authoring::CheckBeats(beats, "company.beats");
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
    const int64_t later = authoring::FramesLater(stage.dancers[i], beats, fps, frames, field);
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
