"""client/python as others get it: built, and installed into a folder that knows nothing of this repository. python_test.py runs it;
$CHOREO_SERVER names a choreod."""

import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = """
import sys
from choreo_client import ChoreoError, Client, pose, read_keys
with Client(sys.argv[1]) as client:
    skeleton = client.info().models[0].skeleton
    key = {"id": "a", "frame": 40, "pose": pose(skeleton, {"head": [0, 0.5, 0]})}
    print(sum(answer.frames.count for answer in client.stream_dance([{"config": {"frames": 60}}, {"keyframe": key}, *read_keys({"keyframes": [{"frame": 50, "pose": "dab"}]}, skeleton)])))
    try:
        list(client.stream_dance([{"config": {"frame_rate": 1000}}]))
    except ChoreoError as error:
        print(error.code, error.violations[0].field)
"""


def run(*command, **options):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        raise AssertionError(f"{command}: {done.stdout}{done.stderr}")
    return done.stdout


class PackageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        missing = [name for name in ("pip", "setuptools", "wheel") if importlib.util.find_spec(name) is None]
        missing += [] if shutil.which("protoc") else ["protoc"]
        if missing and os.environ.get("CHOREO_SKIP_CODE") != "1":
            raise unittest.SkipTest(f"there is no {', '.join(missing)} here (scripts/install_packages.sh build test)")
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)
        # Others may be testing the same sources.
        source = cls.folder / "checkout/client/python"
        made = shutil.ignore_patterns("build", "dist", "*.egg-info", "__pycache__")
        shutil.copytree(ROOT / "client/python", source, ignore=made)
        shutil.copytree(ROOT / "proto", cls.folder / "checkout/proto")
        shutil.copytree(ROOT / "client/poses", cls.folder / "checkout/client/poses")
        run(sys.executable, "setup.py", "-q", "sdist", "-d", cls.folder, cwd=source)
        cls.wheel = cls.build(source, "wheels")
        git = ("git", "-C", cls.folder / "checkout", "-c", "user.name=t", "-c", "user.email=t@localhost")
        for words in (("init", "-q"), ("add", "."), ("commit", "-q", "-m", "All")):
            run(*git, *words)
        cls.of_git = cls.build(f"git+file://{cls.folder}/checkout#subdirectory=client/python", "of_git")
        shutil.rmtree(cls.folder / "checkout")

    @classmethod
    def build(cls, source, name):
        """A wheel of `source`, without a registry."""
        out = cls.folder / name
        offline = ["--no-deps", "--no-index", "--no-build-isolation", "--disable-pip-version-check", "-q"]
        run(sys.executable, "-m", "pip", "wheel", *offline, "-w", out, source)
        (wheel,) = out.glob("choreo_client-*-py3-none-any.whl")
        return wheel

    def test_the_installed_wheel_dances(self):
        app = self.folder / "app"
        with zipfile.ZipFile(self.wheel) as files:  # all that pip does with a wheel of Python alone
            files.extractall(app)
        bare = os.environ | {"PYTHONPATH": str(app), "PATH": "/nowhere"}  # no protoc
        said = run(sys.executable, "-B", "-c", PROGRAM, os.environ["CHOREO_SERVER"], cwd=app, env=bare)
        self.assertEqual(said, "60\nINVALID_ARGUMENT config.frame_rate\n")
        metadata = next(app.glob("*.dist-info/METADATA")).read_text()
        self.assertEqual(re.findall(r"Requires-Dist: ([a-z]+)", metadata), ["grpcio", "protobuf"])
        types = (app / "choreo_client/_types/choreography_pb2.pyi").read_text()
        self.assertIn("class StreamDanceRequest", types)
        self.assertNotIn("choreo.v1 import", types)

    def test_a_source_distribution_makes_the_same_wheel(self):
        (archive,) = self.folder.glob("choreo*client-*.tar.gz")
        again = self.build(archive, "again")
        with zipfile.ZipFile(self.wheel) as one, zipfile.ZipFile(again) as other:
            self.assertIn("choreo_client/protos.binpb", one.namelist())
            self.assertEqual(sorted(one.namelist()), sorted(other.namelist()))

    def test_a_git_url_makes_the_same_wheel(self):
        with zipfile.ZipFile(self.wheel) as one, zipfile.ZipFile(self.of_git) as other:
            self.assertEqual(sorted(one.namelist()), sorted(other.namelist()))

    def test_the_package_has_the_version_of_the_server(self):
        (version,) = re.findall(r"project\(choreo VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())
        self.assertIn(f'\nversion = "{version}"\n', (ROOT / "client/python/pyproject.toml").read_text())
