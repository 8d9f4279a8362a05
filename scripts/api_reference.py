#!/usr/bin/python3
"""Writes docs/api.md, the reference of the API, from the comments of proto/choreo/v1.

    scripts/api_reference.py            writes
    scripts/api_reference.py --check    changes nothing; fails if the page is outdated
"""
import pathlib
import re
import subprocess
import sys
import tempfile

from google.protobuf import descriptor_pb2

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/api.md"
FILES = ("choreo/v1/choreography.proto", "choreo/v1/motion.proto")
Field = descriptor_pb2.FieldDescriptorProto
HEAD = """# API

Written by `scripts/api_reference.py` from the comments of [proto/choreo/v1](../proto/choreo/v1); do not edit. It lists every call, message,
field and value. For time, sizes and statuses see the top of
[choreography.proto](../proto/choreo/v1/choreography.proto), for promises the [contract](contract.md), for clients [examples](../examples).
"""


def described():
    with tempfile.NamedTemporaryFile() as out:
        subprocess.run(["protoc", f"--proto_path={ROOT / 'proto'}", "--include_source_info", f"--descriptor_set_out={out.name}", *FILES],
                       check=True)
        return descriptor_pb2.FileDescriptorSet.FromString(pathlib.Path(out.name).read_bytes()).file


class Comments:
    """A file's comments by path, with the paths of descriptor.proto."""

    def __init__(self, file):
        self.said = {tuple(at.path): at.leading_comments.strip() for at in file.source_code_info.location}

    def paragraphs(self, path):
        return [" ".join(paragraph.split()) for paragraph in self.said[path].split("\n\n") if paragraph.strip()]

    def cell(self, path):
        return " ".join(self.said[path].split()).replace("|", "\\|")


def link(type_name):
    name = type_name.rsplit(".", 1)[-1]
    return f"[{name}](#{name.lower()})"


def type_of(field):
    kind = link(field.type_name) if field.type_name else Field.Type.Name(field.type)[len("TYPE_"):].lower()
    if field.label == Field.LABEL_REPEATED:
        return f"repeated {kind}"
    return f"optional {kind}" if field.proto3_optional else kind


def service_lines(service, path, comments):
    lines = [f"## {service.name}", "", "| call | asks | answers |", "|---|---|---|"]
    for method in service.method:
        asks, answers = (f"{'stream of ' * streams}{link(name)}" for streams, name in (
            (method.client_streaming, method.input_type), (method.server_streaming, method.output_type)))
        lines.append(f"| [{method.name}](#{method.name.lower()}) | {asks} | {answers} |")
    for i, method in enumerate(service.method):
        lines += ["", f"### {method.name}"]
        for paragraph in comments.paragraphs(path + (2, i)):
            lines += ["", re.sub(r"^(\w+(?: [\w-]+){1,3}\.) ", r"**\1** ", paragraph)]
    return lines + [""]


def message_lines(message, path, comments):
    choices = [field.HasField("oneof_index") and not field.proto3_optional for field in message.field]
    lines = [f"### {message.name}", "", comments.cell(path) + " One of:" * (all(choices) and any(choices)), ""]
    if message.field:
        lines += ["| field | meaning |", "|---|---|"]
    for i, field in enumerate(message.field):
        one_of = f" (one of `{message.oneof_decl[field.oneof_index].name}`)" if choices[i] and not all(choices) else ""
        lines.append(f"| `{field.name}`: {type_of(field)} | {comments.cell(path + (2, i))}{one_of} |")
    lines.append("")
    for i, nested in enumerate(message.nested_type):
        lines += message_lines(nested, path + (3, i), comments)
    for i, enum in enumerate(message.enum_type):
        lines += enum_lines(enum, path + (4, i), comments)
    return lines


def enum_lines(enum, path, comments):
    lines = [f"### {enum.name}", "", comments.cell(path), "", "| value | meaning |", "|---|---|"]
    lines += [f"| `{value.name}` | {comments.cell(path + (2, i))} |" for i, value in enumerate(enum.value)]
    return lines + [""]


def page():
    lines = [HEAD]
    for file in sorted(described(), key=lambda file: not file.service):  # calls first
        comments = Comments(file)
        for i, service in enumerate(file.service):
            lines += service_lines(service, (6, i), comments)
        lines += [f"## Messages of {file.name.rsplit('/', 1)[-1]}", ""]
        for i, message in enumerate(file.message_type):
            lines += message_lines(message, (4, i), comments)
        for i, enum in enumerate(file.enum_type):
            lines += enum_lines(enum, (5, i), comments)
    return "\n".join(lines).replace("\n\n\n", "\n\n").rstrip() + "\n"


if __name__ == "__main__":
    text = page()
    if "--check" not in sys.argv[1:]:
        PAGE.write_text(text)
    elif PAGE.read_text() != text:
        sys.exit("docs/api.md is not what proto/ says: run scripts/api_reference.py")
