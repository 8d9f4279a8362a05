#pragma once

#include <vector>

#include "model/training/prepare.h"

namespace choreo {

/// AIST++ as it is distributed:
///   motions/NAME.pkl     smpl_poses [frames, 72], smpl_trans [frames, 3], smpl_scaling: 60 fps
///   splits/crossmodal_train.txt, _val.txt, _test.txt     a NAME a line
///   ignore_list.txt      names whose reconstruction failed; optional
/// and, anywhere below the folder, the songs of the AIST Dance Database, named by the song that a
/// NAME has in its last part but one: gBR_sBM_cAll_d04_mBR0_ch01 dances to mBR0.wav (.mp3, .ogg,
/// .flac), from its beginning.

/// The motions that are not ignored, sorted by name. Throws Error where there are none.
std::vector<RecordingSource> ListAistRecordings(const PrepareOptions& options);

/// Writes OUT/splits.json: the lists as train, validation and test, and as unused, which no run
/// sees, every motion that is in none (they share songs or dances with the tests). Throws Error
/// for a list that is absent and for a name that is in two.
void WriteAistSplits(const PrepareOptions& options);

}  // namespace choreo
