"""Errors, and when to retry."""

import collections
import types

from ._as_sent import as_sent
from ._compile import ERRORS
from ._protos import contents

_rpc = types.SimpleNamespace(**contents(*ERRORS))


class Violation(collections.namedtuple("Violation", "field description")):
    """An invalid field. `field` is a path in the message that was sent, such as 'keyframe.pose.rotations[48]', and `description` states what is
    wrong. For a rotation, the field is its first number, and `joint` is its joint. `keyframe_id`: the id of the affected key. `request`: the
    index of the affected request, from 0, if it is known. Attributes that do not apply are None."""

    def __new__(cls, field, description, keyframe_id=None, joint=None, request=None):
        violation = super().__new__(cls, field, description)
        violation.keyframe_id, violation.joint, violation.request = keyframe_id, joint, request
        return violation



class ChoreoError(Exception):
    """A failed call, or an unusable option. `code` is the name of a gRPC status code, such as "INVALID_ARGUMENT". The message is the server's,
    and `violations` has the fields that it names. A retry may succeed after `retry_after` seconds (None: it would not, or it is unknown).
    `reason` is for programs, such as "DRAINING", "SERVER_FULL" or, of this package's own refusals too, "INVALID_VALUE" (None: unknown)."""

    def __init__(self, code, message, violations=(), retry_after=None):
        super().__init__(message)
        self.code = code
        self.violations = list(violations)
        self.retry_after = retry_after
        self.reason = None
        self.is_of_the_caller = False  # options do not fit the server
        self.is_away = False  # whether no server was reached, or only its health
        self.is_leaving = False  # whether the server drains, so that another one should be tried at once

    @classmethod
    def of(cls, failure, find=lambda violation: (None, None)):
        """Converts a grpc.RpcError. `find(violation)` returns the sent message that a violation is about and, if it is one of several and known,
        its index."""
        error = cls(failure.code().name, failure.details() or "the server failed without saying why")
        for key, value in failure.trailing_metadata() or ():
            if key == "grpc-status-details-bin":
                error._read(value)
        return error.located(find)

    def located(self, find, name=as_sent):
        """Translates fields to those that the caller sent, and returns self. `name(field, message)` returns the translated field, and the joint
        or None."""
        self.violations = [self._located(violation, request, *name(violation.field, message)) for violation in self.violations for message, request in [find(violation)]]
        return self

    def _located(self, violation, request, field, joint):
        place = "" if request is None or field.startswith("requests[") else f"requests[{request}]."
        if str(self).endswith(f": {violation.description}"):  # the server's message names fields in its own numbering
            self.args = (f"{place}{field}: {violation.description}",)
        return Violation(field, violation.description, violation.keyframe_id, violation.joint if joint is None else joint, request)

    def _read(self, value):
        key = None
        for detail in _rpc.Status.FromString(value).details:
            name = detail.type_url.rpartition("/")[2]
            if name == "google.rpc.ErrorInfo":
                info = _rpc.ErrorInfo.FromString(detail.value)
                self.reason = info.reason
                self.is_leaving = info.reason == "DRAINING"
                key = dict(info.metadata).get("keyframe_id")
            elif name == "google.rpc.BadRequest":
                fields = _rpc.BadRequest.FromString(detail.value).field_violations
                self.violations += [Violation(wrong.field, wrong.description, key) for wrong in fields]
            elif name == "google.rpc.RetryInfo":
                delay = _rpc.RetryInfo.FromString(detail.value).retry_delay
                self.retry_after = delay.seconds + 1e-9 * delay.nanos


def unavailable(message):
    return ChoreoError("UNAVAILABLE", message)


def wrong_field(code, field, what):
    """Makes an error about a field, in the form of the server's errors."""
    return ChoreoError(code, f"{field}: {what}", [Violation(field, what)])


def invalid(field, what):
    error = wrong_field("INVALID_ARGUMENT", field, what)
    error.reason = "INVALID_VALUE"  # as servers say
    return error


# Fields that another replica may accept, because it was started with other models.
_OF_THE_REPLICA = ("config.model", "config.continuation.fingerprint", "config.continuation.skeleton")

Advice = collections.namedtuple("Advice", "here elsewhere wait_s")


def advice_for(error):
    """Returns how to retry a failed call: `here`, on the same server; `elsewhere`, on another one; after at least `wait_s`. An unreachable or
    full server may be tried again. A server that broke, does not fit the options, has another fingerprint or lacks the model would fail again,
    but another one may succeed. Any other failure would recur everywhere."""
    here = error.retry_after is not None or (error.code == "UNAVAILABLE" and not error.is_of_the_caller)
    broken = error.code in ("INTERNAL", "UNKNOWN")
    of_the_replica = bool(error.violations) and error.violations[0].field in _OF_THE_REPLICA
    return Advice(here, here or broken or of_the_replica or error.is_of_the_caller, error.retry_after or 0)
