"""The API's messages. They are made from descriptors, because generated code would require one version of protobuf. They are in a descriptor
pool of their own, because programs may have google.rpc, or stubs of this API, from elsewhere."""

import pathlib
import tempfile

from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from google.protobuf.internal import enum_type_wrapper  # as generated code does

from . import _compile

_PACKED = pathlib.Path(__file__).with_name("protos.binpb")


def _descriptors():
    if _PACKED.exists():
        return _PACKED.read_bytes()
    with tempfile.TemporaryDirectory() as folder:  # a checkout
        compiled = pathlib.Path(folder, "protos.binpb")
        _compile.compile_protos(pathlib.Path(__file__).resolve().parents[3] / "proto", compiled)
        return compiled.read_bytes()


_pool = descriptor_pool.DescriptorPool()
for _file in descriptor_pb2.FileDescriptorSet.FromString(_descriptors()).file:
    _pool.AddSerializedFile(_file.SerializeToString())


def _class(descriptor):
    if hasattr(message_factory, "GetMessageClass"):
        return message_factory.GetMessageClass(descriptor)
    return message_factory.MessageFactory(_pool).GetPrototype(descriptor)  # before protobuf 4.22


def contents(*files):
    """Returns {name: message, enum or enum value} of .proto files."""
    found = {}
    for file in map(_pool.FindFileByName, files):
        found.update((name, _class(message)) for name, message in file.message_types_by_name.items())
        for name, enum in file.enum_types_by_name.items():
            found[name] = enum_type_wrapper.EnumTypeWrapper(enum)
            found.update((value.name, value.number) for value in enum.values)
    return found
