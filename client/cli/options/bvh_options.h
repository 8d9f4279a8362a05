#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "model/motion/floor/contacts.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo::cli {

/// `--names` and `--unit`, for commands that write motions: the layout of BVH files for animators'
/// tools.
struct BvhOptions {
  std::string names;  ///< empty: SMPL's
  std::string unit;   ///< "m" or "cm"; empty: centimetres

  void AddTo(CLI::App& command);
  /// Throws Error(kInvalidArgument), whose field is the option, if one is given and `out` is not a
  /// BVH, and for unknown names.
  void Check(const std::filesystem::path& out) const;
  /// Writes a motion like WriteMotion (motion_file.h); a BVH gets this layout.
  void Write(const std::filesystem::path& out, const Skeleton& skeleton, const Motion& motion,
             const std::vector<Contacts>& contacts) const;
};

}  // namespace choreo::cli
