#include "client/cli/edit/edit_whole.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "client/arrange.h"
#include "client/cli/options/options.h"
#include "client/cli/report/dance_file.h"
#include "client/cli/report/report.h"
#include "client/cli/report/report_controls.h"
#include "model/core/limits.h"
#include "model/core/rounded.h"
#include "model/motion/kinematics/mirror.h"
#include "model/motion/resample.h"

namespace choreo::cli {
namespace {

constexpr double kDefaultGapSeconds = 1;  // seconds

/// A dance being edited, with its keys and beats at the model's rate.
class Whole {
 public:
  Whole(const EditOptions& options, const std::string& path, const std::string& report)
      : options_(options), path_(path) {
    auto [skeleton, dance] = ReadDance(path);
    skeleton_ = std::move(skeleton);
    dance_ = std::move(dance);
    if (report.empty()) return;
    const ReportFile read = ReadReport(report);
    known_.fps = read.fps;
    known_ = FitReport(read, report, Frames(), read.fps, dance_.motion);
  }

  void Cut() {
    const double fps = dance_.motion.fps;
    const auto total = std::ssize(dance_.motion.frames);
    const auto in_counts = [](const std::string& time) {
      return !time.empty() && authoring::ParseTime(time, "time").counts;
    };
    authoring::Counts counts;
    if (in_counts(options_.from) || in_counts(options_.until))
      counts = ReadCounts(options_, Duration(dance_.motion));
    const auto second = [&](const char* option, const std::string& time) {
      return authoring::ParseTime(time, option).In(counts, option);
    };
    if (!options_.from.empty() && !options_.until.empty())
      RequireBefore(second("--from", options_.from), second("--until", options_.until));
    // Starts on a frame of the model, because keys are on these.
    const double start_s =
        options_.from.empty()
            ? 0
            : std::round(second("--from", options_.from) * known_.fps) / known_.fps;
    const int64_t first = FirstFrameFrom(start_s, fps);
    const int64_t end =
        options_.until.empty()
            ? total
            : std::min<int64_t>(total, FirstFrameFrom(second("--until", options_.until), fps));
    if (first >= end) {
      throw InvalidArgument(!options_.from.empty() ? "--from" : "--until",
                            "nothing of " + path_ + " is left: it ends at " +
                                Rounded(static_cast<double>(total) / fps) +
                                " s, and at least one frame must remain");
    }
    dance_ = client::PartOf(dance_, first, end);
    const int64_t by = std::llround(start_s * known_.fps);
    std::erase_if(known_.keys, [&](const auto& key) { return key.first < by; });
    Shift(-by);
    known_.settings = known_.settings.From(start_s, known_.fps);
    std::erase_if(known_.keys, [&](const auto& key) { return key.first >= Frames(); });
    std::erase_if(known_.warnings, [&](const client::Warning& warning) {
      return warning.frame < 0 || warning.frame >= Frames();
    });
  }

  void Mirror() {
    dance_ = client::Mirrored(skeleton_, dance_);
    known_.settings.controls = cli::Mirrored(std::move(known_.settings.controls));
    for (client::Warning& warning : known_.warnings) warning.message = Mirrored(warning.message);
  }

  /// Appends another dance.
  void Join(Whole next) {
    if (!SameBones(skeleton_, next.skeleton_)) {
      throw InvalidArgument("--join", next.path_ + " is of the skeleton " +
                                          next.skeleton_.Describe() + ", " + path_ + " of " +
                                          skeleton_.Describe());
    }
    next.dance_ = client::AtRate(std::move(next.dance_), dance_.motion.fps);
    const Pose last = dance_.motion.frames.back();
    const bool as_it_is = options_.gap_s == 0.0;
    if (!as_it_is) next.dance_ = client::BegunAt(last, std::move(next.dance_));
    const auto frames = std::ssize(dance_.motion.frames);
    auto begin = frames;  // of the other dance
    if (as_it_is) {
      dance_ = client::Join(std::move(dance_), next.dance_);
      std::cout << "joined as they are";
    } else if (!options_.gap_s && client::BeginsIn(skeleton_, next.dance_, last)) {
      --begin;  // both dances have the frame at which they meet
      dance_ = client::Join(client::PartOf(dance_, 0, begin), next.dance_);
      std::cout << "joined where they meet";
    } else {
      begin = DanceOver(next.dance_);
      std::cout << "joined: frames " << frames << " to " << begin - 1 << " are new";
    }
    std::cout << "; the second begins at "
              << Rounded(static_cast<double>(begin) / dance_.motion.fps) << " s\n";
    next.Shift(std::llround(static_cast<double>(begin) / dance_.motion.fps * known_.fps));
    known_.keys.merge(next.known_.keys);
    known_.warnings.insert(known_.warnings.end(), next.known_.warnings.begin(),
                           next.known_.warnings.end());
  }

  void Write() const { WriteEdited(options_, skeleton_, dance_, known_, Frames()); }

 private:
  /// Exchanges the sides of joints and parts in a message, but not in the ids of keys.
  std::string Mirrored(std::string_view message) const {
    std::vector<std::string> kept, sides = {"left_", "right_"};
    for (const auto& [frame, key] : known_.keys) kept.push_back('"' + key.id + '"');
    std::string mirrored;
    while (!message.empty()) {
      const auto begins = [&](const std::string& word) { return message.starts_with(word); };
      const auto id = std::ranges::find_if(kept, begins),
                 side = std::ranges::find_if(sides, begins);
      const size_t length = id != kept.end() ? id->size() : side != sides.end() ? side->size() : 1;
      const std::string word(message.substr(0, length));
      mirrored += id == kept.end() && side != sides.end() ? OtherSide(word) : word;
      message.remove_prefix(length);
    }
    return mirrored;
  }

  /// Frames at the model's rate.
  int64_t Frames() const {
    return static_cast<int64_t>(std::floor(Duration(dance_.motion) * known_.fps + kOnFrame)) + 1;
  }

  /// Moves keys and beats to later frames.
  void Shift(int64_t by) {
    known_.keys = Moved(std::move(known_.keys), by);
    for (client::Warning& warning : known_.warnings) warning.frame += by;
  }

  /// Generates the transition to the other dance, and returns the frame at which that begins.
  int64_t DanceOver(const client::FinishedDance& next) {
    const Connection connection(options_.server, options_.model);
    const client::ModelDescription& model = connection.model(options_.model);
    if (!SameBones(model.skeleton, skeleton_)) {
      throw InvalidArgument(path_, "is of the skeleton " + skeleton_.Describe() + ", the model \"" +
                                       model.name + "\" of " + model.skeleton.Describe());
    }
    const double gap_s = options_.gap_s.value_or(kDefaultGapSeconds);
    const int64_t gap = std::llround(gap_s * model.fps);
    const int64_t most = model.max_transition_frames;
    if (gap < kMinKeyDistance || gap > most) {
      throw InvalidArgument("--gap", Rounded(gap_s) + " s, must be 0, or " +
                                         Rounded(kMinKeyDistance / model.fps) + " to " +
                                         Rounded(static_cast<double>(most) / model.fps) + " s");
    }
    auto [how, counts] = HowToDance(options_, connection, Duration(dance_.motion) + gap_s);
    // The transition leads to the other dance, not along the path of this one.
    if (!options_.controls.IsOption(kRootPath)) how.controls.root_path.reset();
    const auto before = std::ssize(dance_.motion.frames) + std::ssize(next.motion.frames);
    client::EditedDance joined;
    try {
      joined = client::Join(connection.client(), dance_, next, how, gap);
    } catch (const Error& error) {
      throw options_.controls.InTermsOf(error);
    }
    ShowWarnings(joined.warnings, {known_.fps});
    known_.warnings.insert(known_.warnings.end(), joined.warnings.begin(), joined.warnings.end());
    const auto added = std::ssize(joined.dance.motion.frames) - before;
    const int64_t begin = std::ssize(dance_.motion.frames) + added;
    dance_ = std::move(joined.dance);
    return begin;
  }

  const EditOptions& options_;
  std::string path_;
  Skeleton skeleton_;
  client::FinishedDance dance_;
  ReportFile known_;
};

}  // namespace

void EditWhole(const EditOptions& options) {
  Whole whole(options, options.dance, options.report);
  if (!options.from.empty() || !options.until.empty()) whole.Cut();
  if (options.mirror) whole.Mirror();
  if (!options.join.empty()) whole.Join({options, options.join, options.join_report});
  whole.Write();
}

}  // namespace choreo::cli
