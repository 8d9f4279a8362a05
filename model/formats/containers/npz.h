#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "model/core/files/npy.h"

namespace choreo {

/// NumPy's `.npz`: a zip of named arrays and texts (zero-dimensional arrays of characters, such as
/// AMASS's gender or our metadata). Writes without compression and with a fixed date, so that equal
/// content gives equal bytes. Reads compressed files, too. Parses members on demand, so unreadable
/// arrays (pickled objects) matter only if requested. Not thread-safe while it changes.
class NpzArchive {
 public:
  /// Throws Error(kNotFound) for a file that cannot be opened, Error(kInvalidArgument) for a file
  /// that is no zip, is damaged, or holds more than 4 GiB.
  static NpzArchive Read(const std::filesystem::path& path);
  /// Replaces the file atomically. Throws Error(kInternal) if it cannot be written.
  void Write(const std::filesystem::path& path) const;

  bool Has(const std::string& key) const { return members_.contains(key); }
  /// Returns an array. Throws Error(kInvalidArgument) for a missing key, listing the existing ones,
  /// and for an array of another kind.
  NpyArray Array(const std::string& key) const;
  std::string Text(const std::string& key) const;
  /// Whether the key's array is one of characters.
  bool IsText(const std::string& key) const;
  std::vector<std::string> Names() const;
  /// The pickle of an array of objects (pickle.h). Empty for other arrays.
  std::string_view Pickle(const std::string& key) const;

  /// Sets the file's name, for messages.
  void SetName(const std::string& name) { name_ = name; }

  /// Arrays of nested dicts: adds a dict, lists the dicts' names, returns a dict.
  void SetNested(const std::string& name, const NpzArchive& archive);
  std::vector<std::string> NestedNames() const;
  NpzArchive Nested(const std::string& name) const;

  void SetArray(const std::string& key, const NpyArray& array);
  /// Stores UTF-8 text as NumPy's str. Throws Error(kInvalidArgument) for text that is not UTF-8.
  void SetText(const std::string& key, const std::string& text);

 private:
  const std::string& Member(const std::string& key) const;

  std::string name_ = "npz";
  std::map<std::string, std::string> members_;  // bytes of each .npy, by key
};

}  // namespace choreo
