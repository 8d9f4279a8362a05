"""Brings along the API: protos.binpb, from which messages are made, and their types for editors; and the library of poses."""

import pathlib
import runpy
import shutil

from setuptools import setup
from setuptools.command.build_py import build_py
from setuptools.command.sdist import sdist

HERE = pathlib.Path(__file__).resolve().parent
# A source distribution has a copy, a checkout the repository's own.
PROTO = next((folder for folder in (HERE / "proto", HERE.parents[1] / "proto") if folder.is_dir()), None)
POSES = next((folder for folder in (HERE / "poses", HERE.parent / "poses") if folder.is_dir()), None)
compiler = runpy.run_path(str(HERE / "choreo_client" / "_compile.py"))


class BuildWithProtos(build_py):
    def run(self):
        super().run()
        if not getattr(self, "editable_mode", False):  # which reads the checkout's
            package = pathlib.Path(self.build_lib, "choreo_client")
            compiler["compile_protos"](PROTO, package / "protos.binpb")
            compiler["write_types"](PROTO, package / "_types")
            shutil.copytree(POSES, package / "poses", dirs_exist_ok=True)


class SourceWithProtos(sdist):
    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, files)
        for folder in ("choreo", "google"):
            shutil.copytree(PROTO / folder, pathlib.Path(base_dir, "proto", folder))
        shutil.copytree(POSES, pathlib.Path(base_dir, "poses"))


setup(
    cmdclass={"build_py": BuildWithProtos, "sdist": SourceWithProtos},
    # Isolated builds get this; --no-build-isolation wants protoc.
    setup_requires=[] if shutil.which("protoc") else ["grpcio-tools"],
)
