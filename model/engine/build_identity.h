#pragma once

namespace choreo {

/// What this program was built from, as in "GNU 12.2.0 Release 0123456789abcdef": compiler, build
/// type, and a hash of its flags and of every source that can change a bit of a dance. Builds of
/// the same sources have the same, wherever they were made. cmake/write_build_identity.cmake makes
/// it.
const char* BuildIdentity();

}  // namespace choreo
