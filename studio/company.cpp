#include "studio/company.h"

#include <filesystem>
#include <utility>

#include "client/authoring/project/formation.h"
#include "model/core/files/atomic_file.h"
#include "model/core/files/small_extension.h"
#include "model/formats/gltf/gltf.h"
#include "model/formats/motion_file.h"
#include "studio/from_page.h"
#include "studio/page_project.h"
#include "studio/scratch_folder.h"

namespace choreo::studio {
namespace {

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
  const authoring::Dancers stage = StageOf(request.project());
  Response response;
  Formation* formation = response.mutable_formation();
  const std::vector<double> beats(request.beats().begin(), request.beats().end());
  CheckBeats(beats, "company.beats");
  if (request.dance_of_size() != std::ssize(stage.dancers))
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
    const std::string field = std::string(kUnnamed) + ":dancers[" + std::to_string(i) + "].after";
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
