#pragma once

#include <string>
#include <string_view>

#include "model/formats/containers/npz.h"

namespace choreo {

/// Reads a Python pickle (protocols 0 to 5) of one dict whose keys are texts or numbers, such as
/// AIST++'s motions; numpy.save wraps the dict in an array of objects. Values may be NumPy arrays
/// (as in NpyArray), numbers (arrays without dimensions), texts, lists with one of these, and dicts
/// of them (NpzArchive::Nested). Ignores values of other kinds. A pickle is a program, but none of
/// it runs: the reader knows only the opcodes and globals that build such a dict. Throws
/// Error(kInvalidArgument), which names `name`, the opcode and its position, for everything else.
NpzArchive ParsePickledArrays(std::string_view bytes, const std::string& name);

/// Reads a pickle of one array or number, which may be wrapped in an array of objects.
NpyArray ParsePickledArray(std::string_view bytes, const std::string& name);

}  // namespace choreo
