#include "model/formats/npz.h"

#include <zip.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>
#include <vector>

#include "model/core/atomic_file.h"
#include "model/core/error.h"

namespace choreo {
namespace {

constexpr uint64_t kMaxBytes = uint64_t{4} << 30;
constexpr std::string_view kMagic("\x93NUMPY\x01\x00", 8);

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

// Exactly `size` bytes, whose checksum libzip verifies where they end. In pieces: memory goes with
// what is there, not with what a directory claims.
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

// numpy's str is UCS-4. Refuses what RFC 3629 does not allow, as far as the decoding shows it.
std::u32string DecodeUtf8(const std::string& text) {
  std::u32string points;
  for (size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const int length = first < 0x80   ? 1
                       : first < 0xC2 ? 0
                       : first < 0xE0 ? 2
                       : first < 0xF0 ? 3
                       : first < 0xF5 ? 4
                                      : 0;
    if (length == 0 || i + length > text.size()) throw InvalidArgument("text", "is not UTF-8");
    char32_t point = length == 1 ? first : first & (0x7F >> length);
    for (int k = 1; k < length; ++k) {
      const auto next = static_cast<unsigned char>(text[i + k]);
      if ((next & 0xC0) != 0x80) throw InvalidArgument("text", "is not UTF-8");
      point = point << 6 | (next & 0x3F);
    }
    points.push_back(point);
    i += length;
  }
  return points;
}

void AppendUtf8(char32_t point, std::string& text) {
  if (point < 0x80) {
    text += static_cast<char>(point);
  } else if (point < 0x800) {
    text += static_cast<char>(0xC0 | point >> 6);
    text += static_cast<char>(0x80 | (point & 0x3F));
  } else if (point < 0x10000) {
    text += static_cast<char>(0xE0 | point >> 12);
    text += static_cast<char>(0x80 | (point >> 6 & 0x3F));
    text += static_cast<char>(0x80 | (point & 0x3F));
  } else {
    text += static_cast<char>(0xF0 | point >> 18);
    text += static_cast<char>(0x80 | (point >> 12 & 0x3F));
    text += static_cast<char>(0x80 | (point >> 6 & 0x3F));
    text += static_cast<char>(0x80 | (point & 0x3F));
  }
}

}  // namespace

NpzArchive NpzArchive::Read(const std::filesystem::path& path) {
  const std::string name = path.string();
  int code = 0;
  const std::unique_ptr<zip_t, Discard> archive(zip_open(name.c_str(), ZIP_RDONLY, &code));
  if (!archive) {
    throw Error(code == ZIP_ER_NOENT || code == ZIP_ER_OPEN ? ErrorCode::kNotFound
                                                            : ErrorCode::kInvalidArgument,
                name, "not a readable npz: " + ErrorText(code));
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
  std::string present;
  for (const auto& [other, bytes] : members_) present += (present.empty() ? "" : ", ") + other;
  throw InvalidArgument(name_, "has no array '" + key + "' (it has: " + present + ")");
}

NpyArray NpzArchive::Array(const std::string& key) const {
  const std::string& bytes = Member(key);
  return ParseNpy(std::as_bytes(std::span(bytes)), name_ + ":" + key);
}

std::string NpzArchive::Text(const std::string& key) const {
  const std::string& bytes = Member(key);
  const auto fail = [&] {
    return InvalidArgument(name_ + ":" + key,
                           "is not a text (a str or bytes array of one element)");
  };
  // Version 1 and a header such as {'descr': '<U7', 'fortran_order': False, 'shape': (), }.
  if (!bytes.starts_with(kMagic) || bytes.size() < 10) throw fail();
  const size_t header_size =
      static_cast<unsigned char>(bytes[8]) + size_t{256} * static_cast<unsigned char>(bytes[9]);
  if (bytes.size() < 10 + header_size) throw fail();
  const std::string_view header(bytes.data() + 10, header_size);
  const std::string_view data = std::string_view(bytes).substr(10 + header_size);
  const auto value_of = [&](std::string_view name) {
    const size_t at = header.find(name);
    return at == std::string_view::npos ? std::string_view() : header.substr(at + name.size());
  };
  const std::string_view shape = value_of("'shape': ");
  if (!shape.starts_with("()") && !shape.starts_with("(1,)")) throw fail();
  const std::string_view type = value_of("'descr': '");
  const bool wide = type.starts_with("<U");
  if (!wide && !type.starts_with("|S")) throw fail();
  size_t length = 0;
  std::from_chars(type.data() + 2, type.data() + type.size(), length);
  if (length > data.size() || data.size() != length * (wide ? 4 : 1)) throw fail();
  std::string text;
  for (size_t i = 0; i < length; ++i) {
    char32_t point = static_cast<unsigned char>(data[wide ? 4 * i : i]);
    if (wide) std::memcpy(&point, data.data() + 4 * i, 4);
    if (point > 0x10FFFF) throw fail();
    wide ? AppendUtf8(point, text) : text.push_back(static_cast<char>(point));
  }
  text.resize(text.find_last_not_of('\0') + 1);  // numpy pads with zeros
  return text;
}

void NpzArchive::SetArray(const std::string& key, const NpyArray& array) {
  members_[key] = SerializeNpy(array);
}

void NpzArchive::SetText(const std::string& key, const std::string& text) {
  std::u32string points = DecodeUtf8(text);
  if (points.empty()) points.push_back(0);  // numpy has no strings of length 0
  std::string header =
      "{'descr': '<U" + std::to_string(points.size()) + "', 'fortran_order': False, 'shape': (), }";
  while ((header.size() + 11) % 64 != 0) header += ' ';
  header += '\n';
  std::string bytes(kMagic);
  bytes += static_cast<char>(header.size() % 256);
  bytes += static_cast<char>(header.size() / 256);
  bytes += header;
  bytes.append(reinterpret_cast<const char*>(points.data()), points.size() * sizeof(char32_t));
  members_[key] = std::move(bytes);
}

}  // namespace choreo
