"""Talks to a choreod, the server that makes people dance."""

from . import choreography
from ._client import Answers, Client
from ._dance import Resumed
from ._errors import ChoreoError
from ._options import Options
from ._pose import pose

__all__ = ["Answers", "ChoreoError", "Client", "Options", "Resumed", "choreography", "pose"]
