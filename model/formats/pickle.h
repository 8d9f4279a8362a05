#pragma once

#include <string>
#include <string_view>

#include "model/formats/npz.h"

namespace choreo {

/// Reads a Python pickle (protocols 0 to 5) of one dict whose keys are texts or numbers, such as
/// AIST++'s motions, or of such a dict in an array of objects, as numpy.save writes it: NumPy
/// arrays, numbers (arrays without dimensions here), texts, lists of one of these, dicts of them
/// (NpzArchive::Nested). Ignores values of other kinds. A pickle is a program, but nothing of it is
/// run: knows only the opcodes and globals that build such a dict, and refuses others. Arrays are
/// as in NpyArray. Throws Error(kInvalidArgument), which names `name`, the opcode and its place,
/// for everything else.
NpzArchive ParsePickledArrays(std::string_view bytes, const std::string& name);

/// The same, of a pickle of one array or number, or of such in an array of objects.
NpyArray ParsePickledArray(std::string_view bytes, const std::string& name);

}  // namespace choreo
