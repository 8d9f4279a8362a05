#include "client/cli/options/bvh_options.h"

#include "model/core/error.h"
#include "model/core/files/small_extension.h"
#include "model/formats/bvh/bvh.h"
#include "model/formats/motion_file.h"

namespace choreo::cli {
namespace {

bool IsBvh(const std::filesystem::path& path) { return SmallExtension(path) == ".bvh"; }

JointNames NamesOf(const std::string& names) {
  return names.empty() ? JointNames::kSmpl : ParseJointNames(names, "--names");
}

}  // namespace

void BvhOptions::AddTo(CLI::App& command) {
  command.add_option("--names", names,
                     "Joint names of a .bvh: smpl (default), mixamo, humanik (MotionBuilder, Maya) "
                     "or ue (Unreal's mannequin).");
  command.add_option("--unit", unit, "Unit of a .bvh: cm (default) or m.")
      ->check([](const std::string& text) {
        return text == "m" || text == "cm" ? "" : '"' + text + "\" is neither m nor cm";
      });
}

void BvhOptions::Check(const std::filesystem::path& out) const {
  NamesOf(names);
  for (const auto& [option, value] : {std::pair("--names", names), std::pair("--unit", unit)}) {
    if (!value.empty() && !IsBvh(out))
      throw InvalidArgument(option, "is for a .bvh, not for " + out.string());
  }
}

void BvhOptions::Write(const std::filesystem::path& out, const Skeleton& skeleton,
                       const Motion& motion, const std::vector<Contacts>& contacts) const {
  if (!IsBvh(out)) return WriteMotion(out, skeleton, motion, &contacts);
  const BvhLayout layout{NamesOf(names), unit == "m" ? kMetres : kCentimetres};
  WriteBvh(out, MotionToBvh(skeleton, motion, layout));
}

}  // namespace choreo::cli
