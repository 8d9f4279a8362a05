#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "model/fit/sources/position_clip.h"
#include "model/fit/sources/sources.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"
#include "model/training/prepare/beat_grid.h"
#include "model/training/prepare/prepare.h"

/// Reads the layouts of `choreo-lab prepare` as Recordings.
namespace choreo {

/// A recording, read but uncorrected. Layouts with SMPL rotations have `motion`, the others
/// `positions`.
struct Recording {
  std::string genre;                    ///< stored with the clip; empty: unknown
  std::vector<std::string> notes = {};  ///< remarks of the reader
  PositionClip positions;
  std::optional<Motion> motion;
  SourceMapping mapping;
  Skeleton skeleton = Skeleton::Smpl24();  ///< the skeleton of the rotations, fitted or read
  bool ground = false;                     ///< put the body of `motion` on the floor
  bool tilted_floor = false;               ///< fit and level a floor plane, remove height drift
  double cutoff_hz = 0;                    ///< low-pass filter before resampling; 0: none
  double time_scale = 1;
  std::filesystem::path music;    ///< empty: none
  double music_start_s = 0;       ///< position of the motion's first frame in the music
  bool expects_music = false;     ///< warn if there is none
  std::optional<BeatGrid> beats;  ///< of the motion, in the motion's time
};

/// The value of the first prefix with which a clip's name starts, or `otherwise`.
double ForClip(const std::vector<std::pair<std::string, double>>& values, const std::string& name,
               double otherwise);

/// A clip's name and a function that reads the clip, or throws Error, naming the file.
struct RecordingSource {
  std::string name;
  std::function<Recording()> read;
};
/// Lists all recordings in the options' layout, sorted by name. Throws Error for none.
std::vector<RecordingSource> ListRecordings(const PrepareOptions& options);

/// The names in each group, {"train": [names], ...}; null for layouts that define none.
nlohmann::ordered_json SplitsOf(const PrepareOptions& options);

/// Reads a BVH with any hierarchy that fit/sources/sources.h knows. The length of the dancer's legs
/// determines the unit. The rate is the options' for this name, or the file's.
Recording ReadBvhRecording(const std::filesystem::path& path, const std::string& name,
                           const PrepareOptions& options);

/// Reads a dance of "Dance with Melody" (Tang et al. 2018), 25 fps, centimetres. Layout tang2018:
/// NAME.npy [frames, 24, 3] beside NAME.ogg (.wav, .mp3), which begins with the motion. Row 0 is
/// the world's centre; the others are joints relative to it.
Recording ReadTang2018Npy(const std::filesystem::path& path, const PrepareOptions& options);
/// Reads the same as published: NAME/skeletons.json, config.json (the dance's start and end frame
/// in the music), audio.mp3.
Recording ReadTang2018Folder(const std::filesystem::path& folder, const PrepareOptions& options);
/// Reads layout tang61: NAME.npy [frames, 21, 3] in the world, beside its music. Dances are not
/// aligned to their songs. They have a beat grid of their own, if their speed shows it.
Recording ReadTang61(const std::filesystem::path& path, const PrepareOptions& options);

/// Lists AIST++ as distributed:
///   motions/NAME.pkl     smpl_poses [frames, 72], smpl_trans [frames, 3], smpl_scaling: 60 fps
///   splits/crossmodal_train.txt, _val.txt, _test.txt     a NAME per line
///   ignore_list.txt      names whose reconstruction failed; optional
///
/// and, anywhere below, the songs of the AIST Dance Database, whose name is a NAME's last part but
/// one: gBR_sBM_cAll_d04_mBR0_ch01 dances to mBR0.wav (.mp3, .ogg, .flac), from its beginning.
std::vector<RecordingSource> ListAistRecordings(const PrepareOptions& options);
/// The groups of the lists. A motion in no list shares a song or dance with the tests: it is in
/// "unused", and never used. Throws Error for a missing list and for a name in two lists.
nlohmann::ordered_json AistSplits(const PrepareOptions& options);

/// Lists LAFAN1 (Harvey et al. 2020) as distributed: one folder of THEMETAKE_subjectN.bvh, such as
/// walk1_subject5.bvh, 30 fps, centimetres, 22 joints. The theme ("walk") is the genre. Reading one
/// throws Error(kInvalidArgument), naming a joint that is missing or is not LAFAN1's.
std::vector<RecordingSource> ListLafan1Recordings(const PrepareOptions& options);
/// Subject 5 is in "test", as in Harvey et al. 2020, and subject 4 in "validation", so that
/// validation sees no training dancer, either. All others are in "train".
nlohmann::ordered_json Lafan1Splits(const PrepareOptions& options);
/// LAFAN1's 22 joints, in file order.
const std::vector<std::string>& Lafan1JointNames();

}  // namespace choreo
