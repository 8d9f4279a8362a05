"""A client for choreod, the server that generates dances."""

from . import choreography
from ._client import Answers, Client
from ._dance import KeyRejectedWarning, Resumed
from ._errors import ChoreoError
from ._keys import library_pose, read_keys
from ._options import Options
from ._pose import pose
from ._poses import LibraryPose, poses

__all__ = [
    "Answers",
    "ChoreoError",
    "Client",
    "KeyRejectedWarning",
    "LibraryPose",
    "Options",
    "Resumed",
    "choreography",
    "library_pose",
    "pose",
    "poses",
    "read_keys",
]
