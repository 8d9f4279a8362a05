"""Generates a transition. If its server is lost, another one repeats it, and answers that were delivered already are left out."""

import grpc

from . import choreography
from ._check import checked, music_encoding, require_sendable
from ._errors import ChoreoError, unavailable
from ._delivery_filter import DeliveryFilter, require_same_fingerprint


def transition(replicas, request, until):
    """Yields the answers of GenerateTransition to `request`."""
    asked = choreography.GenerateTransitionRequest()
    asked.CopyFrom(checked(choreography.GenerateTransitionRequest, request, "request", music_encoding(request)))
    require_sendable(asked, "send the music of its frames alone, or a compressed file")
    begun = delivery_filter = None  # by the first server

    def attempt(server, patience):
        nonlocal begun, delivery_filter
        call = until.begin(server.generate_transition(asked, timeout=until.remaining(), metadata=replicas.options.metadata()))
        complete = False
        try:
            for answer in call:
                if answer.HasField("header") and begun is not None:
                    require_same_fingerprint(begun.fingerprint, answer.header, server.address)
                    continue
                if answer.HasField("header"):
                    begun, delivery_filter = answer.header, DeliveryFilter(answer.header)
                    asked.config.seed, asked.config.model = begun.seed, begun.model
                elif answer.HasField("frames"):
                    if not delivery_filter.take_frames(answer.frames):
                        continue
                    patience.reset()
                elif answer.HasField("event") and not delivery_filter.take_event(answer.event):
                    continue
                complete |= answer.HasField("summary")
                yield answer
        except grpc.RpcError as failure:
            raise ChoreoError.of(failure, lambda violation: (asked, None)) from None
        finally:
            call.cancel()  # a finished one does not mind
        if not complete:
            raise unavailable("the server ended the transition before its summary")

    return replicas.persist(attempt, until)
