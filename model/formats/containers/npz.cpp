#include "model/formats/containers/npz.h"

#include <zip.h>

#include <algorithm>
#include <boost/locale/encoding_utf.hpp>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>

#include "model/core/error.h"
#include "model/core/files/atomic_file.h"
#include "model/core/joined.h"

namespace choreo {
namespace {

using boost::locale::conv::conversion_error;
using boost::locale::conv::utf_to_utf;

constexpr uint64_t kMaxBytes = uint64_t{4} << 30;

struct Discard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};

std::string ErrorText(int code) {
  zip_error_t error;
  zip_error_init_with_code(&error, code);
  std::string text = zip_error_strerror(&error);
  zip_error_fini(&error);
  return text;
}

// A zip's directory is at its end.
bool BeginsAsZip(const std::filesystem::path& path) {
  char begin[2] = {};
  std::ifstream(path, std::ios::binary).read(begin, sizeof begin);
  return begin[0] == 'P' && begin[1] == 'K';
}

// Reads exactly `size` bytes; libzip verifies their checksum at the end. Reads in pieces, so that
// memory use depends on the data, not on the size that the directory states.
bool ReadAll(zip_file_t* file, uint64_t size, std::string* bytes) {
  constexpr uint64_t kPiece = 1 << 20;
  while (bytes->size() < size) {
    const size_t start = bytes->size();
    bytes->resize(start + std::min(size - start, kPiece));
    const zip_int64_t count = zip_fread(file, bytes->data() + start, bytes->size() - start);
    if (count != static_cast<zip_int64_t>(bytes->size() - start)) return false;
  }
  char beyond;
  return zip_fread(file, &beyond, 1) == 0;
}

}  // namespace

NpzArchive NpzArchive::Read(const std::filesystem::path& path) {
  const std::string name = path.string();
  int code = 0;
  const std::unique_ptr<zip_t, Discard> archive(zip_open(name.c_str(), ZIP_RDONLY, &code));
  if (!archive) {
    throw Error(code == ZIP_ER_NOENT || code == ZIP_ER_OPEN ? ErrorCode::kNotFound
                                                            : ErrorCode::kInvalidArgument,
                name,
                "not a readable npz: " + ErrorText(code) +
                    (BeginsAsZip(path) ? "; it may be cut off" : ""));
  }
  NpzArchive npz;
  npz.name_ = name;
  uint64_t total = 0;
  const zip_int64_t entries = zip_get_num_entries(archive.get(), 0);
  for (zip_int64_t i = 0; i < entries; ++i) {
    zip_stat_t stat;
    if (zip_stat_index(archive.get(), i, 0, &stat) != 0 || !(stat.valid & ZIP_STAT_SIZE) ||
        !(stat.valid & ZIP_STAT_NAME)) {
      throw InvalidArgument(name, "its directory is damaged");
    }
    total += stat.size;
    if (total > kMaxBytes) throw InvalidArgument(name, "holds more than 4 GiB");
    std::string key = stat.name;
    if (!key.ends_with(".npy")) continue;
    key.resize(key.size() - 4);
    const std::unique_ptr<zip_file_t, Discard> file(zip_fopen_index(archive.get(), i, 0));
    std::string bytes;
    if (!file || !ReadAll(file.get(), stat.size, &bytes))
      throw InvalidArgument(name, "its member '" + key + "' is damaged");
    npz.members_[key] = std::move(bytes);
  }
  return npz;
}

void NpzArchive::Write(const std::filesystem::path& path) const {
  const std::string name = path.string();
  const auto fail = [&](const std::string& why) {
    return Error(ErrorCode::kInternal, name, "cannot be written: " + why);
  };
  AtomicFile file(path);
  int code = 0;
  std::unique_ptr<zip_t, Discard> archive(
      zip_open(file.partial().c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code));
  if (!archive) throw fail(ErrorText(code));
  for (const auto& [key, bytes] : members_) {
    zip_source_t* source = zip_source_buffer(archive.get(), bytes.data(), bytes.size(), 0);
    const zip_int64_t index =
        source ? zip_file_add(archive.get(), (key + ".npy").c_str(), source, ZIP_FL_ENC_UTF_8) : -1;
    if (index < 0) {
      zip_source_free(source);
      throw fail(zip_strerror(archive.get()));
    }
    zip_set_file_compression(archive.get(), index, ZIP_CM_STORE, 0);
    zip_file_set_dostime(archive.get(), index, 0, 0x21, 0);  // 1 January 1980
  }
  if (zip_close(archive.get()) != 0) throw fail(zip_strerror(archive.get()));
  archive.release();
  file.Commit();
}

const std::string& NpzArchive::Member(const std::string& key) const {
  const auto found = members_.find(key);
  if (found != members_.end()) return found->second;
  throw InvalidArgument(name_, "has no array '" + key + "' (it has: " + Joined(Names()) + ")");
}

NpyArray NpzArchive::Array(const std::string& key) const {
  return ParseNpy(Member(key), name_ + ":" + key);
}

// numpy's str is UCS-4.
std::string NpzArchive::Text(const std::string& key) const {
  const std::string name = name_ + ":" + key;
  const NpyParts parts = SplitNpy(Member(key), name);
  const auto fail = [&] {
    return InvalidArgument(name, "is not a text (a str or bytes array of one element)");
  };
  const bool wide = parts.descr.starts_with("<U");
  const size_t length = parts.values.size() / (wide ? sizeof(char32_t) : 1);
  if ((!wide && !parts.descr.starts_with("|S")) || parts.shape.size() > 1 ||
      (parts.shape.size() == 1 && parts.shape[0] != 1) ||
      parts.descr.substr(2) != std::to_string(length)) {
    throw fail();
  }
  std::string text(parts.values);
  if (wide) {
    std::u32string points(length, 0);
    std::memcpy(points.data(), parts.values.data(), length * sizeof(char32_t));
    try {
      text = utf_to_utf<char>(points, boost::locale::conv::stop);
    } catch (const conversion_error&) {
      throw fail();
    }
  }
  text.resize(text.find_last_not_of('\0') + 1);  // numpy pads with zeros
  return text;
}

bool NpzArchive::IsText(const std::string& key) const {
  const std::string descr = SplitNpy(Member(key), name_ + ":" + key).descr;
  return descr.size() > 1 && (descr[1] == 'U' || descr[1] == 'S');
}

std::vector<std::string> NpzArchive::Names() const {
  std::vector<std::string> names;
  for (const auto& [key, bytes] : members_) names.push_back(key);
  return names;
}

std::string_view NpzArchive::Pickle(const std::string& key) const {
  const NpyParts parts = SplitNpy(Member(key), name_ + ":" + key);
  return parts.descr == kNpyObjects ? parts.values : std::string_view();
}

// Stored as "name.key", which no program uses for arrays.
void NpzArchive::SetNested(const std::string& name, const NpzArchive& archive) {
  for (const auto& [key, bytes] : archive.members_) members_[name + '.' + key] = bytes;
}

std::vector<std::string> NpzArchive::NestedNames() const {
  std::vector<std::string> names;
  for (const auto& [key, bytes] : members_) {
    const std::string name = key.substr(0, key.find('.'));
    if (name != key && (names.empty() || names.back() != name)) names.push_back(name);
  }
  return names;
}

NpzArchive NpzArchive::Nested(const std::string& name) const {
  NpzArchive nested;
  nested.name_ = name_;
  for (const auto& [key, bytes] : members_) {
    if (key.starts_with(name + '.')) nested.members_[key.substr(name.size() + 1)] = bytes;
  }
  return nested;
}

void NpzArchive::SetArray(const std::string& key, const NpyArray& array) {
  members_[key] = SerializeNpy(array);
}

void NpzArchive::SetText(const std::string& key, const std::string& text) try {
  std::u32string points = utf_to_utf<char32_t>(text, boost::locale::conv::stop);
  if (points.empty()) points.push_back(0);  // numpy has no strings of length 0
  members_[key] = JoinNpy(
      {.descr = "<U" + std::to_string(points.size()),
       .shape = {},
       .values = {reinterpret_cast<const char*>(points.data()), points.size() * sizeof(char32_t)}});
} catch (const conversion_error&) {
  throw InvalidArgument("text", "is not UTF-8");
}

}  // namespace choreo
