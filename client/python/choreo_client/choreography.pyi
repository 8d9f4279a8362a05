from ._types.choreography_pb2 import *
from ._types.motion_pb2 import *
