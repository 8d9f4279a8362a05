#include "model/core/npy.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>

#include "model/core/atomic_file.h"
#include "model/core/error.h"

namespace choreo {
namespace {

static_assert(std::endian::native == std::endian::little, ".npy values are copied as they lie");

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr size_t kMaxDimensions = 4;
/// NumPy pads the header so that the values start at a multiple of this.
constexpr size_t kAlignment = 64;

struct Header {
  std::string descr;
  bool fortran_order = false;
  std::vector<int64_t> shape;
};

/// Reads the header's Python literal, as in {'descr': '<f4', 'fortran_order': False, 'shape': (3,
/// 4), }. Keys come in any order; every key is required.
class HeaderParser {
 public:
  HeaderParser(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  Header Parse() {
    Header header;
    bool has_descr = false, has_order = false, has_shape = false;
    Expect('{');
    while (!Accept('}')) {
      const std::string key = String();
      Expect(':');
      if (key == "descr") {
        header.descr = String();
        has_descr = true;
      } else if (key == "fortran_order") {
        header.fortran_order = Bool();
        has_order = true;
      } else if (key == "shape") {
        header.shape = Tuple();
        has_shape = true;
      } else {
        Fail("unknown key '" + key + "'");
      }
      if (!Accept(',')) {
        Expect('}');
        break;
      }
    }
    if (!has_descr || !has_order || !has_shape)
      Fail("a key of descr, fortran_order, shape is absent");
    return header;
  }

 private:
  [[noreturn]] void Fail(const std::string& why) const {
    throw InvalidArgument(
        name_, "cannot read the .npy header: " + why + " at character " + std::to_string(at_));
  }
  void SkipSpace() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) ++at_;
  }
  bool Accept(char c) {
    SkipSpace();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void Expect(char c) {
    if (!Accept(c)) Fail(std::string("expected '") + c + "'");
  }
  bool AcceptWord(std::string_view word) {
    SkipSpace();
    if (text_.substr(at_, word.size()) != word) return false;
    at_ += word.size();
    return true;
  }
  std::string String() {
    SkipSpace();
    const char quote = at_ < text_.size() ? text_[at_] : '\0';
    if (quote != '\'' && quote != '"') Fail("expected a string (records are not read)");
    const size_t end = text_.find(quote, at_ + 1);
    if (end == std::string_view::npos) Fail("a string does not end");
    const std::string value(text_.substr(at_ + 1, end - at_ - 1));
    at_ = end + 1;
    return value;
  }
  bool Bool() {
    if (AcceptWord("True")) return true;
    if (AcceptWord("False")) return false;
    Fail("expected True or False");
  }
  std::vector<int64_t> Tuple() {
    std::vector<int64_t> shape;
    Expect('(');
    while (!Accept(')')) {
      SkipSpace();
      int64_t extent = 0;
      const auto [end, error] =
          std::from_chars(text_.data() + at_, text_.data() + text_.size(), extent);
      if (error != std::errc() || extent < 0) Fail("expected an extent of 0 or more");
      at_ = static_cast<size_t>(end - text_.data());
      shape.push_back(extent);
      if (!Accept(',')) {
        Expect(')');
        break;
      }
    }
    return shape;
  }

  std::string_view text_;
  const std::string& name_;
  size_t at_ = 0;
};

std::optional<int64_t> Product(const std::vector<int64_t>& shape) {
  int64_t product = 1;
  for (const int64_t extent : shape) {
    if (__builtin_mul_overflow(product, extent, &product)) return std::nullopt;
  }
  return product;
}

std::string ShapeText(const std::vector<int64_t>& shape) {
  std::string text = "(";
  for (size_t i = 0; i < shape.size(); ++i) text += (i ? ", " : "") + std::to_string(shape[i]);
  return text + (shape.size() == 1 ? ",)" : ")");
}

/// Values whose first index is fastest, brought into the order whose last index is.
template <typename T>
std::vector<T> FromFortranOrder(const std::vector<T>& values, const std::vector<int64_t>& shape) {
  std::vector<T> result(values.size());
  std::vector<int64_t> index(shape.size(), 0);
  for (T& out : result) {
    size_t from = 0;
    for (size_t d = shape.size(); d-- > 0;) {
      from = from * static_cast<size_t>(shape[d]) + static_cast<size_t>(index[d]);
    }
    out = values[from];
    for (size_t d = shape.size(); d-- > 0 && ++index[d] == shape[d];) index[d] = 0;
  }
  return result;
}

template <typename T>
std::vector<T> ReadValues(std::span<const std::byte> bytes, const Header& header,
                          const std::string& name) {
  const std::optional<int64_t> count = Product(header.shape);
  if (!count || *count > std::numeric_limits<int64_t>::max() / int64_t{sizeof(T)}) {
    throw InvalidArgument(name, "shape " + ShapeText(header.shape) + " is too large");
  }
  const size_t expected = static_cast<size_t>(*count) * sizeof(T);
  if (bytes.size() != expected) {
    throw InvalidArgument(name, std::to_string(bytes.size()) + " bytes of values, but shape " +
                                    ShapeText(header.shape) + " of '" + header.descr + "' takes " +
                                    std::to_string(expected) +
                                    (bytes.size() < expected ? " (the file is truncated)" : ""));
  }
  std::vector<T> values(static_cast<size_t>(*count));
  if (expected > 0) std::memcpy(values.data(), bytes.data(), expected);
  return header.fortran_order ? FromFortranOrder(values, header.shape) : values;
}

template <typename T>
constexpr std::string_view kDescr = "";
template <>
constexpr std::string_view kDescr<float> = "<f4";
template <>
constexpr std::string_view kDescr<double> = "<f8";
template <>
constexpr std::string_view kDescr<int32_t> = "<i4";
template <>
constexpr std::string_view kDescr<int64_t> = "<i8";

uint32_t LittleEndian(std::span<const std::byte> bytes) {
  uint32_t value = 0;
  for (size_t i = bytes.size(); i-- > 0;) value = value << 8 | std::to_integer<uint32_t>(bytes[i]);
  return value;
}

}  // namespace

int64_t NpyArray::size() const { return Product(shape).value_or(-1); }

NpyArray ParseNpy(std::span<const std::byte> bytes, const std::string& name) {
  if (bytes.size() < kMagic.size() + 4 ||
      std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) != 0) {
    throw InvalidArgument(name, "not an .npy array: its first bytes are not \\x93NUMPY");
  }
  const int version = std::to_integer<int>(bytes[kMagic.size()]);
  if (version < 1 || version > 3) {
    throw InvalidArgument(name,
                          ".npy version " + std::to_string(version) + " is not one of 1 to 3");
  }
  const size_t length_size = version == 1 ? 2 : 4;
  const size_t start = kMagic.size() + 2 + length_size;
  if (bytes.size() < start) throw InvalidArgument(name, "the .npy header is truncated");
  const size_t length = LittleEndian(bytes.subspan(kMagic.size() + 2, length_size));
  if (bytes.size() - start < length) {
    throw InvalidArgument(
        name, "the .npy header is truncated: " + std::to_string(bytes.size() - start) + " of " +
                  std::to_string(length) + " bytes");
  }
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()) + start, length);
  Header header = HeaderParser(text, name).Parse();
  if (header.shape.size() > kMaxDimensions) {
    throw InvalidArgument(name, std::to_string(header.shape.size()) + " dimensions, at most " +
                                    std::to_string(kMaxDimensions) + " are read");
  }
  const std::span<const std::byte> body = bytes.subspan(start + length);
  NpyArray array;
  if (header.descr == kDescr<float>) {
    array.values = ReadValues<float>(body, header, name);
  } else if (header.descr == kDescr<double>) {
    array.values = ReadValues<double>(body, header, name);
  } else if (header.descr == kDescr<int32_t>) {
    array.values = ReadValues<int32_t>(body, header, name);
  } else if (header.descr == kDescr<int64_t>) {
    array.values = ReadValues<int64_t>(body, header, name);
  } else {
    throw InvalidArgument(name,
                          "values of type '" + header.descr + "', not one of <f4, <f8, <i4, <i8");
  }
  array.shape = std::move(header.shape);
  return array;
}

NpyArray ReadNpy(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path)) {
    throw Error(ErrorCode::kNotFound, path.string(), "cannot be opened");
  }
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  return ParseNpy(std::as_bytes(std::span(bytes)), path.string());
}

std::string SerializeNpy(const NpyArray& array) {
  return std::visit(
      [&](const auto& values) {
        using T = typename std::decay_t<decltype(values)>::value_type;
        if (array.size() != static_cast<int64_t>(values.size())) {
          throw InvalidArgument("shape", ShapeText(array.shape) + " does not hold " +
                                             std::to_string(values.size()) + " values");
        }
        std::string header = "{'descr': '" + std::string(kDescr<T>) +
                             "', 'fortran_order': False, 'shape': " + ShapeText(array.shape) +
                             ", }";
        const size_t unpadded = kMagic.size() + 4 + header.size() + 1;
        header.append((kAlignment - unpadded % kAlignment) % kAlignment, ' ');
        header += '\n';

        std::string bytes(kMagic);
        bytes += {'\x01', '\x00', static_cast<char>(header.size() & 0xff),
                  static_cast<char>(header.size() >> 8)};
        bytes += header;
        bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        return bytes;
      },
      array.values);
}

void WriteNpy(const std::filesystem::path& path, const NpyArray& array) {
  WriteFile(path, SerializeNpy(array));
}

}  // namespace choreo
