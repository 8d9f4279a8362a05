"""What a web app's back end needs to talk to a choreod: stubs made from proto/, errors that name the field, a body at rest."""

import argparse
import importlib
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import threading

import google
import grpc

PROTO = pathlib.Path(__file__).resolve().parents[2] / "proto"


def _make_stubs():
    """Compiles proto/ with Debian's protoc and imports the result. With pip, `python -m grpc_tools.protoc` makes the same files; a program
    of yours would keep them."""
    with tempfile.TemporaryDirectory() as folder:
        files = sorted(str(file.relative_to(PROTO)) for file in PROTO.rglob("*.proto"))
        plugin = "--plugin=protoc-gen-grpc_python=" + (shutil.which("grpc_python_plugin") or "grpc_python_plugin")
        subprocess.run(
            ["protoc", f"--proto_path={PROTO}", f"--python_out={folder}", f"--grpc_python_out={folder}", plugin, *files],
            check=True,
        )
        sys.path.insert(0, folder)
        google.__path__.append(folder + "/google")  # google.rpc lies beside google.protobuf
        names = ["choreo.v1.choreography_pb2", "choreo.v1.motion_pb2", "choreo.v1.choreography_pb2_grpc"]
        names += ["google.rpc.status_pb2", "google.rpc.error_details_pb2"]
        modules = [importlib.import_module(name) for name in names]
        sys.path.remove(folder)
        return modules


choreography, motion, services, status, error_details = _make_stubs()


def connect(address):
    """The stub: StreamDance, GenerateTransition, GetServerInfo. A call can be cancelled: call.cancel()."""
    return services.ChoreographyStub(grpc.insecure_channel(address))


def field_violations(error):
    """The fields that the server names in a grpc.RpcError: [(field, description)]."""
    found = []
    for key, value in error.trailing_metadata() or ():
        if key != "grpc-status-details-bin":
            continue
        for detail in status.Status.FromString(value).details:
            bad_request = error_details.BadRequest()
            if detail.Unpack(bad_request):
                found += [(violation.field, violation.description) for violation in bad_request.field_violations]
    return found


def pose(skeleton, rotations=None, x=0.0, z=0.0):
    """The body of `skeleton` at rest, but for `rotations`: {joint name: [x, y, z] in radians}."""
    rotations = rotations or {}
    return motion.Pose(
        root_position=motion.Vector3(x=x, y=skeleton.pelvis_height, z=z),
        rotations=[number for joint in skeleton.joint_names for number in rotations.get(joint, [0, 0, 0])],
    )


class Requests:
    """The requests of a dance that may have to be said again, to another server or over another connection. `source` yields them as
    {field: message}, the configuration first; music in 16-bit mono samples."""

    def __init__(self, source):
        self._source, self._said, self._lock = iter(source), [], threading.Lock()

    def all(self):
        """From the beginning."""
        at = 0
        while True:
            with self._lock:  # a call that was cancelled may still wait for the source
                if at == len(self._said):
                    request = next(self._source, None)
                    if request is None:
                        return
                    self._said.append(choreography.StreamDanceRequest(**request))
            yield self._said[at]
            at += 1

    def since(self, continuation):
        """What goes on from there: the same messages in the same order, but for the music before it."""
        for request in self.all():
            again = choreography.StreamDanceRequest()
            again.CopyFrom(request)
            if again.HasField("config"):
                again.config.continuation.CopyFrom(continuation)
                if again.config.HasField("audio_format"):
                    again.config.audio_format.first_sample = continuation.audio_from_sample
            elif again.HasField("audio"):
                early = max(0, continuation.audio_from_sample - again.audio.first_sample)
                again.audio.data = again.audio.data[2 * early :]
                again.audio.first_sample += early
                if not again.audio.data:
                    continue
            yield again


def positive(text):
    """A number above 0 out of a program's options, for argparse."""
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not 0 < number < math.inf:
        raise argparse.ArgumentTypeError(f"{text} is not a number above 0")
    return number


def whole(least, most):
    """A whole number from `least` to `most` out of a program's options, for argparse."""

    def read(text):
        if not (text.isascii() and text.isdigit() and least <= int(text[:40]) <= most):
            raise argparse.ArgumentTypeError(f"{text} is not a whole number from {least} to {most}")
        return int(text)

    return read


seed = whole(0, 2**64 - 1)


def run(main):
    """Runs a program: Ctrl-C cancels, errors are shown with the fields that they name."""
    try:
        main()
    except grpc.RpcError as error:
        print(f"{error.code().name}: {error.details()}", file=sys.stderr)
        for field, _ in field_violations(error):
            print(f"  field: {field}", file=sys.stderr)
        sys.exit(1)
    except OSError as error:
        sys.exit(f"{error.filename}: {error.strerror}")
    except KeyboardInterrupt:
        sys.exit("CANCELLED")
