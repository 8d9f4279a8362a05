#include "model/formats/containers/pickle.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "model/core/error.h"
#include "model/core/files/npy.h"
#include "model/formats/containers/pickle_input.h"
#include "model/formats/containers/pickled_text.h"

namespace choreo {
namespace {

/// Limits time, memory and nesting. A dict of arrays needs about 40 operations per array.
constexpr int kMaxOperations = 4096;

/// NumPy's dtype of Python objects, with the byte order that this file gives every dtype.
constexpr const char* kObjects = "<O8";

enum Kind { kNone, kNumber, kText, kTuple, kList, kDict, kGlobal, kDtype, kArray };
constexpr const char* kKindNames[] = {"None", "number", "text",  "tuple", "list",
                                      "dict", "global", "dtype", "array"};

struct Object;
using Ref = std::shared_ptr<Object>;

struct Object {
  Kind kind;
  std::string text = {};        // texts and bytes alike; a global's name, a dtype as in "<f8"
  std::vector<Ref> items = {};  // of a tuple, a list, an array of objects
  NpzArchive dict = {};
  std::optional<NpyArray> array = {};  // of a number, too
};

const std::set<std::string> kKnownGlobals = {"numpy.ndarray",
                                             "numpy.dtype",
                                             "numpy.core.multiarray._reconstruct",
                                             "numpy.core.multiarray.scalar",
                                             "numpy.core.numeric._frombuffer",
                                             "_codecs.encode",
                                             "builtins.dict",
                                             "__builtin__.dict",
                                             "collections.defaultdict",
                                             "collections.OrderedDict"};

/// Runs the few operations of pickles that dicts of arrays need, on a stack, as Python does.
class Unpickler : PickleInput {
 public:
  using PickleInput::PickleInput;

  /// Runs all operations and returns the pickled object, which must be of this kind.
  Ref Run(Kind kind) {
    if (bytes_.starts_with("\x1f\x8b")) throw InvalidArgument(name_, "is compressed: gunzip it");
    if (bytes_.starts_with('x') || bytes_.starts_with("BZh") ||
        bytes_.starts_with("\xfd"
                           "7zXZ")) {
      throw InvalidArgument(
          name_, "is compressed, as joblib.dump does: write what joblib.load reads by numpy.savez");
    }
    if (bytes_.starts_with("PK")) {
      throw InvalidArgument(
          name_,
          "is a zip, as of torch.save or numpy.savez: call it .npz if numpy wrote "
          "it, else write its arrays by numpy.savez");
    }
    // Protocols 0 and 1 begin with their first operation.
    opcode_ = bytes_.empty() ? 0 : static_cast<unsigned char>(bytes_.front());
    if (opcode_ == 0x80) Take(1);
    if (opcode_ == 0x80 ? Byte() > 5 : !kOperations.contains(opcode_))
      Refuse("not a pickle of protocol 0 to 5");
    for (int operation = 0; operation < kMaxOperations; ++operation) {
      NextOpcode();
      if (opcode_ == '.') return Expect(TakeOnly(Pop()), kind);
      const auto known = kOperations.find(opcode_);
      if (known == kOperations.end()) Refuse("is not read");
      known->second(*this);
    }
    Refuse("more than " + std::to_string(kMaxOperations) + " operations");
  }

 private:
  static const std::map<int, void (*)(Unpickler&)> kOperations;

  // The stack; a null pointer is a mark.
  void Push(Ref object) { stack_.push_back(std::move(object)); }
  void Push(Object object) { Push(std::make_shared<Object>(std::move(object))); }
  Ref Pop() {
    if (stack_.empty() || !stack_.back()) Refuse("there is nothing on the stack");
    Ref top = std::move(stack_.back());
    stack_.pop_back();
    return top;
  }
  Ref Pop(Kind kind) { return Expect(Pop(), kind); }
  std::vector<Ref> PopSome(size_t count) {
    std::vector<Ref> items(count);
    for (size_t i = count; i-- > 0;) items[i] = Pop();
    return items;
  }
  std::vector<Ref> PopToMark() {
    const auto above = std::find(stack_.rbegin(), stack_.rend(), nullptr);
    if (above == stack_.rend()) Refuse("there is no mark on the stack");
    std::vector<Ref> items = PopSome(static_cast<size_t>(above - stack_.rbegin()));
    stack_.pop_back();
    return items;
  }
  Ref Expect(Ref object, Kind kind) const {
    if (object->kind != kind) Refuse(std::string("expected a ") + kKindNames[kind]);
    return object;
  }
  // Unwraps a list, or an array of objects, that has one item: numpy.save wraps a dict in one.
  // Several dicts, such as one for each body, become one dict whose keys are their numbers.
  static Ref TakeOnly(const Ref& object) {
    const bool holds = object->kind == kList || (object->kind == kArray && !object->array);
    if (!holds || object->items.empty()) return object;
    if (object->items.size() == 1) return object->items.front();
    if (object->items.front()->kind != kDict) return object;
    auto dicts = std::make_shared<Object>(Object{.kind = kDict});
    for (size_t i = 0; i < object->items.size(); ++i) {
      if (object->items[i]->kind == kDict)
        dicts->dict.SetNested(std::to_string(i), object->items[i]->dict);
    }
    return dicts;
  }
  Ref Item(const Ref& tuple, size_t index, Kind kind) const {
    if (index >= tuple->items.size()) Refuse("too short a tuple");
    return Expect(tuple->items[index], kind);
  }

  void PushNumber(NpyArray::Values value) {
    Push(Object{.kind = kNumber, .array = NpyArray{{}, std::move(value)}});
  }
  void PushInteger(int64_t value) { PushNumber(std::vector{value}); }
  // A number beyond int64, which no motion needs, counts as None.
  void PushInteger(std::string_view line) {
    if (line.ends_with('L')) line.remove_suffix(1);
    const std::optional<int64_t> value = NumberIn<int64_t>(line);
    value ? PushInteger(*value) : Push(Object{.kind = kNone});
  }
  void PushLong(uint64_t size) {
    if (size > 8) return Take(size), Push(Object{.kind = kNone});
    const int unused = static_cast<int>(64 - 8 * size);
    PushInteger(size == 0 ? 0 : static_cast<int64_t>(Unsigned(size) << unused) >> unused);
  }
  void PushText(std::string text) { Push(Object{.kind = kText, .text = std::move(text)}); }
  void PushText(uint64_t size) { PushText(std::string(Take(size))); }
  void PushWritten(std::optional<std::string> (*read)(std::string_view line)) {
    std::optional<std::string> text = read(Line());
    if (!text) Refuse("no text follows");
    PushText(std::move(*text));
  }
  void PushTuple(std::vector<Ref> items) {
    Push(Object{.kind = kTuple, .items = std::move(items)});
  }
  void Remember(uint64_t index) { Push(memo_[index] = Pop()); }
  void Recall(uint64_t index) {
    if (!memo_.contains(index)) Refuse("nothing was stored as " + std::to_string(index));
    Push(memo_[index]);
  }
  void PushGlobal(std::string_view module, std::string_view of_it) {
    std::string name = std::string(module).append(".").append(of_it);
    if (name.starts_with("numpy._core.")) name.erase(6, 1);  // since NumPy 2
    if (!kKnownGlobals.contains(name)) Refuse("it names '" + name + "'");
    Push(Object{.kind = kGlobal, .text = name});
  }

  /// Replaces the call of a global by its result, without calling anything.
  void Reduce() {
    const Ref given = Pop(kTuple);
    const std::string callee = Pop(kGlobal)->text;
    if (callee == "numpy.dtype") {
      Push(Object{.kind = kDtype, .text = "<" + Item(given, 0, kText)->text});
    } else if (callee == "numpy.core.multiarray._reconstruct") {
      Push(Object{.kind = kArray});  // BUILD fills it
    } else if (callee == "numpy.core.multiarray.scalar") {
      PushTuple({});  // the shape of one number
      const Ref shape = Pop();
      Push(Object{.kind = kArray});
      Fill(stack_.back(), shape, Item(given, 0, kDtype), false, Item(given, 1, kText));
    } else if (callee == "numpy.core.numeric._frombuffer") {
      Push(Object{.kind = kArray});
      Fill(stack_.back(), Item(given, 2, kTuple), Item(given, 1, kDtype),
           Item(given, 3, kText)->text == "F", Item(given, 0, kText));
    } else if (callee == "_codecs.encode" && Item(given, 1, kText)->text == "latin1") {
      // Protocols up to 2 have no bytes; Python 3 writes them as text with the same codes.
      Push(Object{.kind = kText, .text = Latin1(Item(given, 0, kText)->text)});
    } else if (callee.starts_with("collections.")) {
      Push(Object{.kind = kDict});
    } else {
      Refuse("a call of '" + callee + "'");
    }
  }

  /// Sets the state of the dtype or array below it on the stack.
  void Build() {
    const Ref state = Pop(kTuple);
    const Ref object = Pop();
    if (object->kind == kArray && Item(state, 2, kDtype)->text == kObjects) {
      object->items = Item(state, 4, kList)->items;
    } else if (object->kind == kArray) {
      Fill(object, Item(state, 1, kTuple), Item(state, 2, kDtype),
           Integer(Item(state, 3, kNumber)) != 0, Item(state, 4, kText));
    } else {
      const std::string& order = Item(state, 1, kText)->text;
      Expect(object, kDtype);
      if (order != "<" && order != ">" && order != "|")
        Refuse("values of the order '" + order + "' of bytes");
      if (order == ">") object->text.replace(0, 1, ">");
    }
    Push(object);
  }

  void Fill(const Ref& array, const Ref& shape, const Ref& dtype, bool fortran, const Ref& values) {
    // Counts each use, because a pickle may use the same bytes for many arrays.
    if ((filled_ += values->text.size()) > bytes_.size()) Refuse("more values than the file has");
    NpyParts parts{dtype->text, fortran, {}, values->text};
    for (const Ref& extent : shape->items) {
      parts.shape.push_back(Integer(Expect(extent, kNumber)));
      if (parts.shape.back() < 0) Refuse("an extent below 0");
    }
    array->array = ReadNpyParts(parts, name_);
  }
  int64_t Integer(const Ref& number) const {
    const auto* whole = std::get_if<std::vector<int64_t>>(&number->array->values);
    if (!whole) Refuse("a number that is not whole");
    return whole->front();
  }

  std::string Latin1(std::string_view utf8) const {
    std::string bytes;
    for (size_t i = 0; i < utf8.size(); ++i) {
      const auto lead = static_cast<unsigned char>(utf8[i]);
      if (lead >= 0x80 && (lead >> 2 != 0x30 || i + 1 == utf8.size()))
        Refuse("a character beyond Latin-1");
      bytes += lead < 0x80 ? utf8[i] : static_cast<char>(lead << 6 | (utf8[++i] & 0x3f));
    }
    return bytes;
  }

  void SetItems(const std::vector<Ref>& items) {
    const Ref dict = Pop(kDict);
    for (size_t i = 0; i + 1 < items.size(); i += 2) {
      // A key may be a number: people's tracks are numbered.
      const std::string key = items[i]->kind == kNumber ? std::to_string(Integer(items[i]))
                                                        : Expect(items[i], kText)->text;
      const auto holds = [](const Ref& item) { return item->array.has_value(); };
      if (items[i + 1]->kind == kList && std::ranges::count_if(items[i + 1]->items, holds) > 1)
        Refuse("'" + key + "' is a list of several arrays, as of several bodies");
      // Ignores values of other kinds, such as a gender: the motion does not need them.
      const Ref value = TakeOnly(items[i + 1]);
      if (value->array) dict->dict.SetArray(key, *value->array);
      if (value->kind == kDict) dict->dict.SetNested(key, value->dict);
      if (value->kind == kText) SetText(key, value->text, dict->dict);
    }
    Push(dict);
  }
  static void SetText(const std::string& key, const std::string& text, NpzArchive& dict) {
    try {
      dict.SetText(key, text);
    } catch (const Error&) {
      // Ignores bytes that are not text.
    }
  }

  void Append(const std::vector<Ref>& items) {
    const Ref list = Pop(kList);
    for (const Ref& item : items) {
      // Drops containers, because one of them might contain this list, which would be a cycle.
      const bool plain = item->array || item->kind == kText || item->kind == kDict;
      list->items.push_back(plain ? item : std::make_shared<Object>(Object{.kind = kNone}));
    }
    Push(list);
  }

  size_t filled_ = 0;  // bytes of values, in all arrays
  std::vector<Ref> stack_;
  std::map<uint64_t, Ref> memo_;
};

const std::map<int, void (*)(Unpickler&)> Unpickler::kOperations = {
    {0x95, [](Unpickler& u) { u.Take(8); }},                                          // FRAME
    {'(', [](Unpickler& u) { u.Push(nullptr); }},                                     // MARK
    {'N', [](Unpickler& u) { u.Push(Object{.kind = kNone}); }},                       // NONE
    {0x88, [](Unpickler& u) { u.PushInteger(1); }},                                   // NEWTRUE
    {0x89, [](Unpickler& u) { u.PushInteger(0); }},                                   // NEWFALSE
    {'K', [](Unpickler& u) { u.PushInteger(u.Byte()); }},                             // BININT1
    {'M', [](Unpickler& u) { u.PushInteger(static_cast<int64_t>(u.Unsigned(2))); }},  // BININT2
    {'J', [](Unpickler& u) { u.PushInteger(static_cast<int32_t>(u.Unsigned(4))); }},  // BININT
    {'G', [](Unpickler& u) { u.PushNumber(std::vector{u.BigEndianDouble()}); }},      // BINFLOAT
    {'I', [](Unpickler& u) { u.PushInteger(u.Line()); }},             // INT
    {'L', [](Unpickler& u) { u.PushInteger(u.Line()); }},             // LONG
    {0x8a, [](Unpickler& u) { u.PushLong(u.Unsigned(1)); }},          // LONG1
    {'F',
     [](Unpickler& u) {
       const auto value = u.NumberIn<double>(u.Line());
       value ? u.PushNumber(std::vector{*value}) : u.Push(Object{.kind = kNone});
     }},                                                              // FLOAT
    {'S', [](Unpickler& u) { u.PushWritten(ReadPickledString); }},    // STRING
    {'V', [](Unpickler& u) { u.PushWritten(ReadPickledUnicode); }},   // UNICODE
    {'U', [](Unpickler& u) { u.PushText(u.Unsigned(1)); }},           // SHORT_BINSTRING
    {'C', [](Unpickler& u) { u.PushText(u.Unsigned(1)); }},           // SHORT_BINBYTES
    {0x8c, [](Unpickler& u) { u.PushText(u.Unsigned(1)); }},          // SHORT_BINUNICODE
    {'T', [](Unpickler& u) { u.PushText(u.Unsigned(4)); }},           // BINSTRING
    {'B', [](Unpickler& u) { u.PushText(u.Unsigned(4)); }},           // BINBYTES
    {'X', [](Unpickler& u) { u.PushText(u.Unsigned(4)); }},           // BINUNICODE
    {0x8e, [](Unpickler& u) { u.PushText(u.Unsigned(8)); }},          // BINBYTES8
    {0x96, [](Unpickler& u) { u.PushText(u.Unsigned(8)); }},          // BYTEARRAY8
    {')', [](Unpickler& u) { u.PushTuple({}); }},                     // EMPTY_TUPLE
    {0x85, [](Unpickler& u) { u.PushTuple(u.PopSome(1)); }},          // TUPLE1
    {0x86, [](Unpickler& u) { u.PushTuple(u.PopSome(2)); }},          // TUPLE2
    {0x87, [](Unpickler& u) { u.PushTuple(u.PopSome(3)); }},          // TUPLE3
    {'t', [](Unpickler& u) { u.PushTuple(u.PopToMark()); }},          // TUPLE
    {'l',
     [](Unpickler& u) {
       const std::vector<Ref> items = u.PopToMark();
       u.Push(Object{.kind = kList});
       u.Append(items);
     }},                                                              // LIST
    {'d',
     [](Unpickler& u) {
       const std::vector<Ref> items = u.PopToMark();
       u.Push(Object{.kind = kDict});
       u.SetItems(items);
     }},                                                              // DICT
    {']', [](Unpickler& u) { u.Push(Object{.kind = kList}); }},       // EMPTY_LIST
    {'a', [](Unpickler& u) { u.Append(u.PopSome(1)); }},              // APPEND
    {'e', [](Unpickler& u) { u.Append(u.PopToMark()); }},             // APPENDS
    {'}', [](Unpickler& u) { u.Push(Object{.kind = kDict}); }},       // EMPTY_DICT
    {'s', [](Unpickler& u) { u.SetItems(u.PopSome(2)); }},            // SETITEM
    {'u', [](Unpickler& u) { u.SetItems(u.PopToMark()); }},           // SETITEMS
    {'p', [](Unpickler& u) { u.Remember(u.Index()); }},               // PUT
    {'g', [](Unpickler& u) { u.Recall(u.Index()); }},                 // GET
    {'q', [](Unpickler& u) { u.Remember(u.Unsigned(1)); }},           // BINPUT
    {'r', [](Unpickler& u) { u.Remember(u.Unsigned(4)); }},           // LONG_BINPUT
    {0x94, [](Unpickler& u) { u.Remember(u.memo_.size()); }},         // MEMOIZE
    {'h', [](Unpickler& u) { u.Recall(u.Unsigned(1)); }},             // BINGET
    {'j', [](Unpickler& u) { u.Recall(u.Unsigned(4)); }},             // LONG_BINGET
    {'c',
     [](Unpickler& u) {
       const std::string_view module = u.Line();
       u.PushGlobal(module, u.Line());
     }},  // GLOBAL
    {0x93,
     [](Unpickler& u) {
       const Ref of_it = u.Pop(kText);
       u.PushGlobal(u.Pop(kText)->text, of_it->text);
     }},  // STACK_GLOBAL
    {'R', [](Unpickler& u) { u.Reduce(); }},                          // REDUCE
    {'b', [](Unpickler& u) { u.Build(); }},                           // BUILD
};

}  // namespace

NpzArchive ParsePickledArrays(std::string_view bytes, const std::string& name) {
  NpzArchive dict = Unpickler(name, bytes).Run(kDict)->dict;
  dict.SetName(name);
  return dict;
}

NpyArray ParsePickledArray(std::string_view bytes, const std::string& name) {
  const Ref number = Unpickler(name, bytes).Run(kNumber);
  return *number->array;
}

}  // namespace choreo
