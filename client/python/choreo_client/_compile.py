"""Compiles the API's protos with protoc or, without it, grpcio-tools. Used to build the package, and in a checkout that is not built."""

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
    """Writes a FileDescriptorSet of the protos in the folder `proto` that the client needs."""
    _protoc(proto, "--include_imports", f"--descriptor_set_out={out}", *MESSAGES, *ERRORS)


def write_types(proto, folder):
    """Writes the messages' types into `folder`, a package."""
    _protoc(proto, f"--pyi_out={folder}", *MESSAGES)
    for file in sorted(pathlib.Path(folder, "choreo", "v1").glob("*.pyi")):
        text = re.sub(r"^from choreo\.v1 import ", "from . import ", file.read_text(encoding="utf-8"), flags=re.MULTILINE)
        # Makes imports of the messages in motion.proto relative, because the package has no choreo.v1.
        text = re.sub(r"^from choreo\.v1\.(\w+) import ", r"from .\1 import ", text, flags=re.MULTILINE)
        pathlib.Path(folder, file.name).write_text(text, encoding="utf-8")
    shutil.rmtree(pathlib.Path(folder, "choreo"))
