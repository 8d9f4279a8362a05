"""The messages of choreo/v1/choreography.proto and motion.proto, and their enums."""

from ._compile import MESSAGES
from ._protos import contents

globals().update(contents(*MESSAGES))
