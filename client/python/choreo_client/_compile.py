"""Compiles the API's protos with protoc or, where there is none, grpcio-tools. For building, and for a checkout that nobody built."""

import pathlib
import re
import shutil
import subprocess
import sys

MESSAGES = ["choreo/v1/choreography.proto", "choreo/v1/motion.proto"]
ERRORS = ["google/rpc/status.proto", "google/rpc/error_details.proto"]


def _protoc(proto, *arguments):
    installed = shutil.which("protoc")
    compiler = [installed] if installed else [sys.executable, "-m", "grpc_tools.protoc"]
    subprocess.run([*compiler, f"--proto_path={proto}", *arguments], check=True)


def compile_protos(proto, out):
    """Writes a FileDescriptorSet of all that the client needs of the folder `proto`."""
    _protoc(proto, "--include_imports", f"--descriptor_set_out={out}", *MESSAGES, *ERRORS)


def write_types(proto, folder):
    """Writes the messages' types into `folder`, a package."""
    _protoc(proto, f"--pyi_out={folder}", *MESSAGES)
    for file in sorted(pathlib.Path(folder, "choreo", "v1").glob("*.pyi")):
        text = re.sub(r"^from choreo\.v1 import ", "from . import ", file.read_text(encoding="utf-8"), flags=re.MULTILINE)
        # The messages of motion.proto are imported by name, from where they lie no more.
        text = re.sub(r"^from choreo\.v1\.(\w+) import ", r"from .\1 import ", text, flags=re.MULTILINE)
        pathlib.Path(folder, file.name).write_text(text, encoding="utf-8")
    shutil.rmtree(pathlib.Path(folder, "choreo"))
