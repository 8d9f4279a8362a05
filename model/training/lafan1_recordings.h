#pragma once

#include <string>
#include <vector>

#include "model/training/prepare.h"

namespace choreo {

/// LAFAN1 (Harvey et al. 2020) as it is distributed: one folder of THEMETAKE_subjectN.bvh, as in
/// walk1_subject5.bvh, 30 fps, centimetres, 22 joints. Paper C trains and compares on its walking
/// and running (Section 4.4, "cyclic motion").

/// The 22 joints, in file order.
const std::vector<std::string>& Lafan1JointNames();

/// The recordings, sorted by name; each has its theme ("walk") as genre. Throws Error where there
/// are none. Reading one throws Error(kInvalidArgument) naming a joint that is missing or is not
/// LAFAN1's.
std::vector<RecordingSource> ListLafan1Recordings(const PrepareOptions& options);

/// Writes OUT/splits.json. Subject 5 is the test, as in Harvey et al. 2020; subject 4 validates, so
/// that nobody of the training is seen there either; the others train.
void WriteLafan1Splits(const PrepareOptions& options);

}  // namespace choreo
