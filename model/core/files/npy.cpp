#include "model/core/files/npy.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <limits>
#include <optional>
#include <set>
#include <type_traits>

#include "model/core/error.h"
#include "model/core/files/atomic_file.h"

namespace choreo {
namespace {

static_assert(std::endian::native == std::endian::little, ".npy values are copied as they lie");

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr size_t kMaxDimensions = 4;
/// NumPy pads the header so that the values start at a multiple of this.
constexpr size_t kAlignment = 64;

/// Parses the header's Python literal, such as {'descr': '<f4', 'fortran_order': False, 'shape':
/// (3, 4), }. Keys come in any order; all are required.
class HeaderParser {
 public:
  HeaderParser(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  NpyParts Parse() {
    NpyParts header;
    std::set<std::string> keys;
    Expect('{');
    while (!Accept('}')) {
      const std::string key = String();
      Expect(':');
      if (key == "descr") {
        header.descr = String();
      } else if (key == "fortran_order") {
        header.fortran_order = Bool();
      } else if (key == "shape") {
        header.shape = Tuple();
      } else {
        Fail("unknown key '" + key + "'");
      }
      keys.insert(key);
      if (!Accept(',')) {
        Expect('}');
        break;
      }
    }
    if (keys.size() < 3) Fail("one of descr, fortran_order, shape is missing");
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
    SkipSpace();
    const bool value = text_.substr(at_).starts_with("True");
    if (!value && !text_.substr(at_).starts_with("False")) Fail("expected True or False");
    at_ += value ? 4 : 5;
    return value;
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

/// Reorders values from Fortran order (first index fastest) to C order (last index fastest).
template <typename T>
std::vector<T> FromFortranOrder(const std::vector<T>& values, const std::vector<int64_t>& shape) {
  std::vector<T> result(values.size());
  for (size_t i = 0; i < values.size(); ++i) {
    size_t rest = i, to = 0;
    for (const int64_t extent : shape) {
      to = to * static_cast<size_t>(extent) + rest % static_cast<size_t>(extent);
      rest /= static_cast<size_t>(extent);
    }
    result[to] = values[i];
  }
  return result;
}

/// Reads a number as stored in the file. `big`: big-endian.
template <typename Stored>
Stored Load(const char* at, bool big) {
  std::array<char, sizeof(Stored)> bytes{};
  std::memcpy(bytes.data(), at, bytes.size());
  if (big) std::ranges::reverse(bytes);
  return std::bit_cast<Stored>(bytes);
}

/// IEEE 754 binary16.
struct Half {
  uint16_t bits;
  operator float() const { return Eigen::numext::bit_cast<Eigen::half>(bits); }
};

template <typename T, typename Stored = T>
std::vector<T> ReadValues(const NpyParts& parts, const std::string& name) {
  const std::optional<int64_t> count = Product(parts.shape);
  if (!count || *count > std::numeric_limits<int64_t>::max() / int64_t{sizeof(T)}) {
    throw InvalidArgument(name, "shape " + ShapeText(parts.shape) + " is too large");
  }
  const size_t held = parts.values.size(), expected = static_cast<size_t>(*count) * sizeof(Stored);
  if (held != expected) {
    throw InvalidArgument(name, std::to_string(held) + " bytes of values, but shape " +
                                    ShapeText(parts.shape) + " of '" + parts.descr + "' takes " +
                                    std::to_string(expected) +
                                    (held < expected ? " (the file is truncated)" : ""));
  }
  const bool big = parts.descr.starts_with('>');
  std::vector<T> values(static_cast<size_t>(*count));
  for (size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<T>(Load<Stored>(parts.values.data() + i * sizeof(Stored), big));
  return parts.fortran_order ? FromFortranOrder(values, parts.shape) : values;
}

/// The readable kinds, without byte order, and the type to which NpyArray widens each.
struct NpyKind {
  std::string_view name;
  NpyArray::Values (*read)(const NpyParts& parts, const std::string& name);
};
template <typename T, typename Stored = T>
constexpr NpyKind Kind(std::string_view kind) {
  return {kind, [](const NpyParts& parts, const std::string& name) -> NpyArray::Values {
            return ReadValues<T, Stored>(parts, name);
          }};
}
constexpr NpyKind kNpyKinds[] = {
    Kind<float>("f4"),
    Kind<double>("f8"),
    Kind<int32_t>("i4"),
    Kind<int64_t>("i8"),
    Kind<float, Half>("f2"),
    Kind<int32_t, int8_t>("i1"),
    Kind<int32_t, int16_t>("i2"),
    Kind<int32_t, uint8_t>("u1"),
    Kind<int32_t, uint16_t>("u2"),
    Kind<int64_t, uint32_t>("u4"),
    Kind<int64_t, uint64_t>("u8"),
    Kind<int32_t, uint8_t>("b1"),
};

/// NumPy's name of T, such as "<f4": byte order, kind, bytes.
template <typename T>
std::string Descr() {
  return (std::is_floating_point_v<T> ? "<f" : "<i") + std::to_string(sizeof(T));
}

}  // namespace

int64_t NpyArray::size() const { return Product(shape).value_or(-1); }

NpyParts SplitNpy(std::string_view bytes, const std::string& name) {
  if (bytes.size() < kMagic.size() + 4 || !bytes.starts_with(kMagic)) {
    throw InvalidArgument(name, "not an .npy array: its first bytes are not \\x93NUMPY");
  }
  const int version = static_cast<unsigned char>(bytes[kMagic.size()]);
  if (version < 1 || version > 3) {
    throw InvalidArgument(name,
                          ".npy version " + std::to_string(version) + " is not one of 1 to 3");
  }
  const size_t length_size = version == 1 ? 2 : 4;
  const size_t start = kMagic.size() + 2 + length_size;
  if (bytes.size() < start) throw InvalidArgument(name, "the .npy header is truncated");
  uint32_t length = 0;
  std::memcpy(&length, &bytes[kMagic.size() + 2], length_size);
  if (bytes.size() - start < length) {
    throw InvalidArgument(
        name, "the .npy header is truncated: " + std::to_string(bytes.size() - start) + " of " +
                  std::to_string(length) + " bytes");
  }
  NpyParts parts = HeaderParser(bytes.substr(start, length), name).Parse();
  parts.values = bytes.substr(start + length);
  return parts;
}

std::string JoinNpy(const NpyParts& parts) {
  std::string header = "{'descr': '" + parts.descr +
                       "', 'fortran_order': False, 'shape': " + ShapeText(parts.shape) + ", }";
  const size_t unpadded = kMagic.size() + 4 + header.size() + 1;
  header.append((kAlignment - unpadded % kAlignment) % kAlignment, ' ');
  header += '\n';
  std::string bytes(kMagic);
  bytes += {'\x01', '\x00', static_cast<char>(header.size() & 0xff),
            static_cast<char>(header.size() >> 8)};
  return bytes.append(header).append(parts.values);
}

NpyArray ReadNpyParts(const NpyParts& parts, const std::string& name) {
  if (parts.shape.size() > kMaxDimensions) {
    throw InvalidArgument(name, std::to_string(parts.shape.size()) + " dimensions, at most " +
                                    std::to_string(kMaxDimensions) + " are read");
  }
  // One-byte kinds have no byte order: "|u1".
  const std::string_view order("<>|=");
  const bool ordered = !parts.descr.empty() && order.find(parts.descr[0]) != order.npos;
  const auto* kind = std::ranges::find(
      kNpyKinds, std::string_view(parts.descr).substr(ordered ? 1 : 0), &NpyKind::name);
  if (kind == std::end(kNpyKinds)) {
    throw InvalidArgument(name, "values of type '" + parts.descr +
                                    "', must be floats of 2 to 8 bytes, integers or booleans");
  }
  return {parts.shape, kind->read(parts, name)};
}

NpyArray ParseNpy(std::string_view bytes, const std::string& name) {
  return ReadNpyParts(SplitNpy(bytes, name), name);
}

NpyArray ReadNpy(const std::filesystem::path& path) {
  return ParseNpy(ReadFile(path), path.string());
}

std::string SerializeNpy(const NpyArray& array) {
  return std::visit(
      [&](const auto& values) {
        using T = typename std::decay_t<decltype(values)>::value_type;
        if (array.size() != static_cast<int64_t>(values.size())) {
          throw InvalidArgument("shape", ShapeText(array.shape) + " does not hold " +
                                             std::to_string(values.size()) + " values");
        }
        return JoinNpy(
            {.descr = Descr<T>(),
             .shape = array.shape,
             .values = {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)}});
      },
      array.values);
}

void WriteNpy(const std::filesystem::path& path, const NpyArray& array) {
  WriteFile(path, SerializeNpy(array));
}

}  // namespace choreo
