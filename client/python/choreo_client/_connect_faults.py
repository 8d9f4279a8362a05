"""Explains failed connections in terms of the client's options; gRPC reports OpenSSL's messages, or nothing. Failures that only the caller can
fix are not retried."""

import re
import socket
import ssl

from ._errors import ChoreoError
from ._pem import file_of, is_text, name_of

_PROBE_S = 1  # for a connection and its handshake
_HOSTNAME_MISMATCH, _IP_ADDRESS_MISMATCH, _EXPIRED = 62, 64, 10  # OpenSSL's X509_V_ERR_...
_AT = re.compile(r"(?:dns:(?://[^/]*/)?|ipv[46]:)?\[?([^,/]+?)\]?:(\d+)(?:,|$)")


# Matches gRPC's messages for a server that is not reached, and captures the reason.
_AWAY = re.compile(r"(?:failed to connect to all addresses|connections to all backends failing)(?:; last error: (.*))?", re.IGNORECASE | re.DOTALL)


_LEAVING = "the server takes no calls: it drains, or an engine of it fails"


def explained(error, server, options):
    """Rewrites `error` for people. Sets `is_away` if no server was reached, and suggests a fix if the server never was."""
    if error.code != "UNAVAILABLE":
        return error
    at = _AT.match(server.address)
    # If the server was reached before, its name and certificate may work again, too.
    fault = _fault(at[1], int(at[2]), options) if at and not server.was_there else None
    if fault is not None:
        known = ChoreoError("UNAVAILABLE", fault)
        known.is_of_the_caller = True
        return known
    away = _AWAY.match(str(error))
    if not away:
        return error
    reason = re.sub(r".*(?:Failed to connect to remote host|[A-Z]+: \S+): ", "", (away[1] or "").strip(), flags=re.DOTALL)
    # Its health check answers, so it is reached.
    told = ChoreoError("UNAVAILABLE", _LEAVING if reason.endswith("unhealthy") else f"no server can be reached: {reason.lower() or 'nobody answers'}")
    told.is_away = True
    told.is_leaving = reason.endswith("unhealthy")
    return told


def _fault(host, port, options):
    """Returns which option is wrong, and how; None if the server is merely unreachable."""
    try:
        _shake_hands(host, port, options)
    except socket.gaierror as failure:
        return "no host of that name is known (addresses)" if failure.errno == socket.EAI_NONAME else None
    except ssl.SSLCertVerificationError as failure:
        return _fault_of_certificate(failure, options.server_name or host, options.ca_certificate)
    except ssl.SSLError as failure:
        speaks_none = options.tls and failure.reason in ("WRONG_VERSION_NUMBER", "PACKET_LENGTH_TOO_LONG", "RECORD_LAYER_FAILURE")
        return "the server there speaks no TLS: leave out tls" if speaks_none else None
    except OSError:
        return None
    return None if options.tls else "the server there wants TLS: set tls"


def _fault_of_certificate(failure, name, authority):
    if failure.verify_code in (_HOSTNAME_MISMATCH, _IP_ADDRESS_MISMATCH):
        return f"the server's certificate is of other names, not of {name}: say of which as server_name"
    if failure.verify_code == _EXPIRED:
        return "the server's certificate has expired"
    given = f"{name_of(authority)} is not that of its authority" if authority else "name the PEM file of its authority"
    return f"the server's certificate is not trusted ({failure.verify_message}): {given} (ca_certificate)"


def _shake_hands(host, port, options):
    """Tries a TLS handshake with a server as `options` require. Raises the error if it fails."""
    pem = options.ca_certificate
    context = ssl.create_default_context(**{"cadata" if is_text(pem) else "cafile": pem})
    context.set_alpn_protocols(["h2"])
    context.verify_flags &= ~ssl.VERIFY_X509_STRICT  # which gRPC does not ask for
    if not options.tls:  # accepts any certificate, because nothing is sent
        context.check_hostname = False
        context.verify_mode = ssl.CERT_NONE
    if options.client_certificate:
        with file_of(options.client_certificate) as own, file_of(options.client_key) as key:
            context.load_cert_chain(own, key)
    with socket.create_connection((host, port), _PROBE_S) as connection:
        with context.wrap_socket(connection, server_hostname=options.server_name or host):
            pass
