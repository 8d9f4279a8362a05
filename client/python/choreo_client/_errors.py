"""What may go wrong, and when it is worth while to try again."""

import collections
import types

from ._as_sent import as_sent
from ._compile import ERRORS
from ._protos import contents

_rpc = types.SimpleNamespace(**contents(*ERRORS))


class Violation(collections.namedtuple("Violation", "field description")):
    """What the server finds wrong: a field's path in the message that was sent, as in 'keyframe.pose.rotations[48]', and what of it. Of a
    rotation the field is its first number, and `joint` its joint. `keyframe_id`: the key that it is of. `request`: which of the requests it is
    in, from 0, where that is known. None where there is none."""

    def __new__(cls, field, description, keyframe_id=None, joint=None, request=None):
        violation = super().__new__(cls, field, description)
        violation.keyframe_id, violation.joint, violation.request = keyframe_id, joint, request
        return violation



class ChoreoError(Exception):
    """A failed call, or an option that cannot be used. `code` as in "INVALID_ARGUMENT"; the message is the server's; `violations` has the
    fields that it names; after `retry_after` seconds trying again may help (None: it will not, or nobody knows)."""

    def __init__(self, code, message, violations=(), retry_after=None):
        super().__init__(message)
        self.code = code
        self.violations = list(violations)
        self.retry_after = retry_after
        self.is_of_the_caller = False  # options do not fit the server
        self.is_away = False  # no server was reached

    @classmethod
    def of(cls, failure, find=lambda violation: (None, None)):
        """A grpc.RpcError. `find(violation)`: the message that was sent and that it is about, and, of several, its number, where it is known."""
        error = cls(failure.code().name, failure.details() or "the server failed without saying why")
        for key, value in failure.trailing_metadata() or ():
            if key == "grpc-status-details-bin":
                error._read(value)
        return error.located(find)

    def located(self, find, name=as_sent):
        """Itself, naming what callers have sent. `name(field, message)`: what to call a field, and the joint or None."""
        self.violations = [self._located(violation, request, *name(violation.field, message)) for violation in self.violations for message, request in [find(violation)]]
        return self

    def _located(self, violation, request, field, joint):
        place = "" if request is None or field.startswith("requests[") else f"requests[{request}]."
        if str(self).endswith(f": {violation.description}"):  # the server's words name its own list of keys
            self.args = (f"{place}{field}: {violation.description}",)
        return Violation(field, violation.description, violation.keyframe_id, joint, request)

    def _read(self, value):
        key = None
        for detail in _rpc.Status.FromString(value).details:
            name = detail.type_url.rpartition("/")[2]
            if name == "google.rpc.ErrorInfo":
                key = dict(_rpc.ErrorInfo.FromString(detail.value).metadata).get("keyframe_id")
            elif name == "google.rpc.BadRequest":
                fields = _rpc.BadRequest.FromString(detail.value).field_violations
                self.violations += [Violation(wrong.field, wrong.description, key) for wrong in fields]
            elif name == "google.rpc.RetryInfo":
                delay = _rpc.RetryInfo.FromString(detail.value).retry_delay
                self.retry_after = delay.seconds + 1e-9 * delay.nanos


def unavailable(message):
    return ChoreoError("UNAVAILABLE", message)


def wrong_field(code, field, what):
    """Named as the server names its fields."""
    return ChoreoError(code, f"{field}: {what}", [Violation(field, what)])


def invalid(field, what):
    return wrong_field("INVALID_ARGUMENT", field, what)


# What another replica may have been started with.
_OF_THE_REPLICA = ("config.model", "config.continuation.fingerprint", "config.continuation.skeleton")

Advice = collections.namedtuple("Advice", "here elsewhere wait_s")


def advice_for(error):
    """How a call that failed may be tried again: `here`, at the same server; `elsewhere`, at another one; after `wait_s` at least. A server
    that is away or full may be asked again. One that broke, that options do not fit, is of another fingerprint or lacks the model would fail
    again, but another one may do better. Anything else fails everywhere."""
    here = error.retry_after is not None or (error.code == "UNAVAILABLE" and not error.is_of_the_caller)
    broken = error.code in ("INTERNAL", "UNKNOWN")
    of_the_replica = bool(error.violations) and error.violations[0].field in _OF_THE_REPLICA
    return Advice(here, here or broken or of_the_replica or error.is_of_the_caller, error.retry_after or 0)
