#pragma once

namespace choreo {

/// The program choreo-lab: prepares data, trains models and measures them; choreod serves them.
/// Takes main's arguments, returns its exit code.
int RunLab(int argc, const char* const* argv);

}  // namespace choreo
