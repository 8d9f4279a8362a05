#!/usr/bin/python3
"""Writes docs/api.md, the reference of the API, from the comments of proto/choreo/v1.

    scripts/api_reference.py            writes
    scripts/api_reference.py --check    changes nothing; fails where the page is not what the proto says
"""
import pathlib
import subprocess
import sys
import tempfile

from google.protobuf import descriptor_pb2

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/api.md"
FILES = ("choreo/v1/choreography.proto", "choreo/v1/motion.proto")
Field = descriptor_pb2.FieldDescriptorProto
HEAD = """# API

Written by `scripts/api_reference.py` from the comments of [proto/choreo/v1](../proto/choreo/v1); do not edit. What a dance is made of,
in the order of messages, stands in [contract](contract.md); clients in [examples](../examples).
"""


def described():
    with tempfile.NamedTemporaryFile() as out:
        subprocess.run(["protoc", f"--proto_path={ROOT / 'proto'}", "--include_source_info", f"--descriptor_set_out={out.name}", *FILES],
                       check=True)
        return descriptor_pb2.FileDescriptorSet.FromString(pathlib.Path(out.name).read_bytes()).file


def comments_of(file):
    """Comments by path, as descriptor.proto has paths."""
    return {tuple(at.path): " ".join(at.leading_comments.split()) for at in file.source_code_info.location if at.leading_comments}


def type_of(field):
    if field.type_name:
        name = field.type_name.rsplit(".", 1)[-1]
        kind = f"[{name}](#{name.lower()})" if ".choreo." in field.type_name else field.type_name.lstrip(".")
    else:
        kind = Field.Type.Name(field.type)[len("TYPE_"):].lower()
    if field.label == Field.LABEL_REPEATED:
        return f"repeated {kind}"
    return f"optional {kind}" if field.proto3_optional else kind


def cell(text):
    return text.replace("|", "\\|")


def message_lines(message, path, comments, above=""):
    name = above + message.name
    lines = [f"### {message.name}", "", comments.get(path, "")] + [""]
    if message.field:
        lines += ["| field | type | meaning |", "|---|---|---|"]
    for i, field in enumerate(message.field):
        alone = field.HasField("oneof_index") and not field.proto3_optional
        one_of = f" (one of `{message.oneof_decl[field.oneof_index].name}`)" if alone else ""
        lines.append(f"| `{field.name}` | {type_of(field)} | {cell(comments.get(path + (2, i), ''))}{one_of} |")
    lines.append("")
    for i, nested in enumerate(message.nested_type):
        lines += message_lines(nested, path + (3, i), comments, name + ".")
    for i, enum in enumerate(message.enum_type):
        lines += enum_lines(enum, path + (4, i), comments)
    return lines


def enum_lines(enum, path, comments):
    lines = [f"### {enum.name}", "", comments.get(path, ""), "", "| value | meaning |", "|---|---|"]
    lines += [f"| `{value.name}` | {cell(comments.get(path + (2, i), ''))} |" for i, value in enumerate(enum.value)]
    return lines + [""]


def page():
    lines = [HEAD]
    for file in sorted(described(), key=lambda file: not file.service):  # calls first
        comments = comments_of(file)
        for i, service in enumerate(file.service):
            lines += [f"## {service.name}", "", comments.get((6, i), ""), ""]
            for j, method in enumerate(service.method):
                asks, answers = (name.rsplit(".", 1)[-1] for name in (method.input_type, method.output_type))
                stream = lambda on, name: f"stream of [{name}](#{name.lower()})" if on else f"[{name}](#{name.lower()})"
                lines += [f"### {method.name}", "", f"{stream(method.client_streaming, asks)} → {stream(method.server_streaming, answers)}", "",
                          comments.get((6, i, 2, j), ""), ""]
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
