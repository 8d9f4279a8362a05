"""Makes messages from callers' arguments, which are messages or their fields. protobuf refuses nearly all invalid fields; here the error is a
ChoreoError that names the field's path, the value and what is allowed."""

import collections.abc
import operator
import re

from google.protobuf.descriptor import FieldDescriptor as Field
from google.protobuf.message import Message

from . import choreography
from ._as_sent import joint_at
from ._errors import ChoreoError, invalid
from ._numbers import LARGEST_FLOAT32, finite
from ._words import has_half, hint, quoted, well_formed

_RANGES = {
    Field.CPPTYPE_INT32: (-(2**31), 2**31 - 1),
    Field.CPPTYPE_UINT32: (0, 2**32 - 1),
    Field.CPPTYPE_INT64: (-(2**63), 2**63 - 1),
    Field.CPPTYPE_UINT64: (0, 2**64 - 1),
}
_MOST_BYTES = 16 << 20  # of a message, as Limits.max_message_bytes has them
# The element type of a buffer of samples whose bytes are in this encoding.
_SAMPLES = {"AUDIO_ENCODING_PCM_F32LE": "f", "AUDIO_ENCODING_PCM_S16LE": "h"}


def checked(kind, value, name, encoding=0):
    """Returns a message of class `kind` from `value`, a message or its fields. `name`: the message's name in errors. `encoding`: that of any
    music in the message."""
    try:
        return _message(kind.DESCRIPTOR, value, "", name, encoding)
    except ChoreoError as error:
        for violation in error.violations:
            violation.joint = joint_at(violation.field, value)
        raise


def require_kind(request, at):
    """Raises ChoreoError for number `at` of a dance's requests if it has no field."""
    if request.WhichOneof("request") is None:
        raise invalid(f"requests[{at}]", f"is empty; there are {', '.join(field.name for field in request.DESCRIPTOR.fields)}")


def require_sendable(request, remedy):
    """Raises ChoreoError for a request whose music makes it too large. `remedy`: the error's advice."""
    if request.HasField("audio") and request.ByteSize() > _MOST_BYTES:
        size, most = (f"{size / 2**20:.{digits}f} MiB" for size, digits in ((len(request.audio.data), 1), (_MOST_BYTES, 0)))
        raise invalid("audio.data", f"{size}; a message has at most {most} in all: {remedy}")


def music_encoding(request):
    """The encoding of the music, from a request's config."""
    for name in ("config", "audio_format", "encoding"):
        request = request.get(name) if isinstance(request, collections.abc.Mapping) else getattr(request, name, None)
    return request


def _message(descriptor, value, path, name, encoding):
    kind = getattr(choreography, descriptor.name)
    if isinstance(value, kind):
        return value
    names = [field.name for field in descriptor.fields]
    if not isinstance(value, collections.abc.Mapping):
        given = f"a {value.DESCRIPTOR.full_name}" if isinstance(value, Message) else quoted(value)
        raise invalid(path or name, f"{given} is not a {descriptor.name}, {{{', '.join(names)}}}")
    fields, chosen = {}, {}
    for key, one in value.items():
        name = well_formed(key) if isinstance(key, str) else quoted(key)
        at = f"{path}.{name}" if path else name
        field = descriptor.fields_by_name.get(name) if isinstance(key, str) else None
        if field is None:
            raise invalid(at, f"no field of {descriptor.name}; {hint(name, names)}")
        if one is None:
            continue
        oneof = field.containing_oneof
        if oneof is not None and chosen.setdefault(oneof.name, key) != key:
            raise invalid(at, f"given beside {chosen[oneof.name]}; there is one of {', '.join(other.name for other in oneof.fields)}")
        fields[key] = (_list if _is_repeated(field) else _single)(field, one, at, encoding)
    return kind(**fields)


def _is_repeated(field):
    # `label` is for protobuf before 6.31.
    return field.is_repeated if hasattr(field, "is_repeated") else field.label == Field.LABEL_REPEATED


def _list(field, value, path, encoding):
    try:
        # Calls iter() because the lists of protobuf's C++ implementation have no __iter__.
        entries = None if isinstance(value, (str, bytes, collections.abc.Mapping)) else iter(value)
    except TypeError:
        entries = None
    if entries is None:
        raise invalid(path, f"{quoted(value)} is not a list")
    entries = list(entries)
    if field.message_type is None and entries and isinstance(entries[0], (list, tuple)):
        raise invalid(f"{path}[0]", f"{quoted(entries[0])} is not a number; {field.name} is one flat list: give [number for one in lists for number in one]")
    return [_single(field, one, f"{path}[{index}]", encoding) for index, one in enumerate(entries)]


def _single(field, value, path, encoding):
    if field.message_type is not None:
        return _message(field.message_type, value, path, path, encoding)
    if field.enum_type is not None:
        return _label(field.enum_type, value, path)
    if field.type == Field.TYPE_BYTES:
        return _bytes(value, path, encoding)
    if field.cpp_type in _RANGES:
        return _whole(value, path, *_RANGES[field.cpp_type])
    if field.type == Field.TYPE_STRING and isinstance(value, str):
        return _text(value, path)
    if field.type == Field.TYPE_BOOL and isinstance(value, int) and value in (0, 1):
        return bool(value)
    if field.type in (Field.TYPE_STRING, Field.TYPE_BOOL):
        raise invalid(path, f"{quoted(value)} is not a {'str' if field.type == Field.TYPE_STRING else 'bool'}")
    number = finite(value)
    if number is None:
        raise invalid(path, f"{quoted(value)} is not a finite number")
    if field.type == Field.TYPE_FLOAT and abs(number) > LARGEST_FLOAT32:
        raise invalid(path, f"{quoted(value)} is beyond the numbers of 32 bits, which end at 3.4e38")
    return number


def _text(value, path):
    if has_half(value):
        raise invalid(path, f"{quoted(value)} has half a character, a surrogate without its pair")
    return value


def _label(kind, value, path):
    try:
        known = well_formed(value) in kind.values_by_name if isinstance(value, str) else value in kind.values_by_number
    except TypeError:  # a list, say
        known = False
    if not known:
        raise invalid(path, f"{quoted(value)} is not a {kind.name}; {hint(value if isinstance(value, str) else '', list(kind.values_by_name))}")
    return value


def _whole(value, path, least, most):
    # MessageToDict writes integers of 64 bits as strings, as JSON requires.
    is_text = most > 2**32 and isinstance(value, str) and re.fullmatch(r"-?\d+", value)
    try:
        number = operator.index(int(value) if is_text else value)
    except (TypeError, ValueError):  # or a text of thousands of digits
        number = None
    if number is None or isinstance(value, bool):
        raise invalid(path, f"{quoted(value)} is not a whole number")
    # The server knows the field's own limits, which are narrower than those of its type.
    if not least <= number <= most:
        raise invalid(path, f"{quoted(value)} is {f'less than {least}' if number < least else f'more than {most}'}")
    return number


def _bytes(value, path, encoding):
    try:
        view = memoryview(value)
    except TypeError:
        raise invalid(path, f"{quoted(value)} is not bytes, and no buffer of the encoding's samples") from None
    known = choreography.AudioEncoding.Name(encoding) if isinstance(encoding, int) and encoding else encoding or "nothing"
    if view.itemsize > 1 and view.format.lstrip("@=<") != _SAMPLES.get(known):
        raise invalid(path, f"samples of format {view.format!r} are not what config.audio_format.encoding says, {known}")
    return view.tobytes()
