"""How to reach the servers, and how patiently: what the caller said, checked, as gRPC wants it."""

import contextlib
import dataclasses
import ipaddress
import json
import math
import numbers
import os
import re
import ssl
import typing

import grpc

from ._errors import invalid
from ._pem import content_of, file_of, name_of, read

LEAST_SILENCE = 2  # seconds
MOST_PORT = 65535
MOST_TOKEN_BYTES = 4096  # gRPC's headers have 8 KiB in all

Path = typing.Union[str, "os.PathLike[str]"]


@dataclasses.dataclass(frozen=True)
class Options:
    """What Client takes beside addresses; None: not given. Certificates and keys are PEM files, or their texts.

    ca_certificate      of the authority to trust, with tls; None: those that gRPC trusts
    client_certificate, client_key      with tls, where the server wants to see a certificate
    server_name         whose certificate the server must have, with tls; None: the one of its address
    token               sent with each call; needs tls, unless all addresses are of this machine
    token_file          the file of it instead, read again for each call, so that it can be renewed
    connect_timeout_s   for one attempt at one address
    silence_s           a server of which nothing is heard for so long, not even the answer to a ping, is lost; at least 2, or 0: never
    retry_s             how long to try again since a call last made progress; 0: not at all, so nothing goes on elsewhere. A server that
                        asks to wait longer than is left is not waited for: the error has its retry_after
    first_backoff_s     between tries; doubled with each, up to 2 s
    even_draining       ask servers, too, that take no new dances: for who looks at them
    """

    tls: bool = False
    ca_certificate: typing.Optional[Path] = None
    client_certificate: typing.Optional[Path] = None
    client_key: typing.Optional[Path] = None
    server_name: typing.Optional[str] = None
    token: typing.Optional[str] = None
    token_file: typing.Optional[Path] = None
    connect_timeout_s: float = 5
    silence_s: float = 5
    retry_s: float = 10
    first_backoff_s: float = 0.1
    even_draining: bool = False

    def check(self, addresses):
        """Raises ChoreoError, naming the option, for those that cannot be used."""
        self._check_kinds()
        for name in ("connect_timeout_s", "silence_s", "retry_s", "first_backoff_s"):
            value = getattr(self, name)
            if not 0 <= value < math.inf:
                raise invalid(name, f"{value} is not a finite number >= 0")
        if 0 < self.silence_s < LEAST_SILENCE:
            raise invalid("silence_s", f"{self.silence_s} s is neither 0 nor at least {LEAST_SILENCE} s")
        if not addresses:
            raise invalid("addresses", "none is given")
        for address in addresses:
            _check_address(address)
        self._check_token(addresses)

    def _check_kinds(self):
        for name, (kinds, what) in _KINDS.items():
            value, unset = getattr(self, name), getattr(Options, name)
            if not isinstance(value, kinds) and not (value is None and unset is None):
                raise invalid(name, f"a {type(value).__name__} is no {what}")  # the value may be a secret

    def _check_token(self, addresses):
        if self.token is None and self.token_file is None:
            return
        if self.token is not None and self.token_file is not None:
            raise invalid("token", "given beside token_file; one of them is sent")
        name = "token_file" if self.token is None else "token"
        far = [address for address in addresses if not _is_of_this_machine(address)]
        if far and not self.tls:
            raise invalid(name, f"a token goes to {far[0]} over TLS alone")
        if self.token is not None:
            _require_token("token", "it", self.token)

    def credentials(self):
        """gRPC's, or None without TLS."""
        if (self.client_certificate is None) != (self.client_key is None):
            missing = "client_key" if self.client_key is None else "client_certificate"
            raise invalid(missing, "missing; a certificate and its key go together")
        if not self.tls:
            for name in ("ca_certificate", "client_certificate", "server_name"):
                if getattr(self, name) is not None:
                    raise invalid(name, f'"{name_of(getattr(self, name))}" needs TLS, which is off')
            return None
        roots = cert = key = None
        if self.ca_certificate is not None:
            roots = content_of("ca_certificate", self.ca_certificate)
            _require_certificate("ca_certificate", self.ca_certificate)
        if self.client_key is not None:
            cert, key = content_of("client_certificate", self.client_certificate), content_of("client_key", self.client_key)
            _require_certificate("client_certificate", self.client_certificate)
            fault = f"{name_of(self.client_key)} is not the key of {name_of(self.client_certificate)}, in PEM without a passphrase"
            with _naming("client_key", fault), file_of(self.client_certificate) as own, file_of(self.client_key) as own_key:
                # OpenSSL would ask for a passphrase on the terminal.
                ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT).load_cert_chain(own, own_key, password=lambda: "")
        return grpc.ssl_channel_credentials(roots, key, cert)

    def metadata(self):
        """What each call carries."""
        token = self.token
        if self.token_file is not None:
            token = read("token_file", self.token_file).decode("latin-1").rstrip()
            _require_token("token_file", self.token_file, token)
        return [] if token is None else [("authorization", f"Bearer {token}")]

    def channel_options(self):
        """Calls take turns at all addresses of a name, but for those that say that they do not serve, or at all."""
        service = {"loadBalancingConfig": [{"round_robin": {}}]}
        if not self.even_draining:
            service["healthCheckConfig"] = {"serviceName": "choreo.v1.Choreography"}
        options = {
            "grpc.service_config": json.dumps(service),
            "grpc.max_receive_message_length": -1,
            # gRPC's name for the time that one attempt to connect may take.
            "grpc.min_reconnect_backoff_ms": round(1000 * self.connect_timeout_s),
            "grpc.initial_reconnect_backoff_ms": 100,
            "grpc.max_reconnect_backoff_ms": 1000,
        }
        if self.server_name is not None:
            options["grpc.ssl_target_name_override"] = self.server_name
        if self.silence_s > 0:
            # Half of the time until a ping, half for its answer.
            half = round(500 * min(self.silence_s, 1e6))
            options |= {"grpc.keepalive_time_ms": half, "grpc.keepalive_timeout_ms": half, "grpc.http2.max_pings_without_data": 0}
        return list(options.items())


_PATH = ((str, os.PathLike), "path")
_KINDS = {
    **dict.fromkeys(("tls", "even_draining"), (bool, "bool")),
    **dict.fromkeys(("ca_certificate", "client_certificate", "client_key", "token_file"), _PATH),
    **dict.fromkeys(("server_name", "token"), (str, "str")),
    **dict.fromkeys(("connect_timeout_s", "silence_s", "retry_s", "first_backoff_s"), (numbers.Real, "number")),
}


def _check_address(address):
    """Refuses what gRPC would take for a name, or for another port."""
    if not isinstance(address, str) or not address:
        raise invalid("addresses", f"{address!r} is no HOST:PORT")
    if re.match("(?i)https?:", address):
        raise invalid("addresses", f"{address} is a URL; HOST:PORT is wanted, and the option tls for TLS")
    if re.match("(unix|unix-abstract|xds):", address):
        return
    port = re.search(r":([0-9]+)$", address)
    if port is None:
        raise invalid("addresses", f"{address} has no port; HOST:PORT is wanted")
    if not 1 <= int(port[1]) <= MOST_PORT:
        raise invalid("addresses", f"{address}: port {port[1]} is not in [1, {MOST_PORT}]")


def _is_of_this_machine(address):
    """Nobody else hears what is said to it. A name that only begins like an address is a name."""
    if address.startswith("unix:"):
        return True
    for host in re.sub(r"^ipv[46]:", "", address).split(","):
        name = re.sub(r":[0-9]+$", "", host)
        try:
            loopback = ipaddress.IPv4Address(name).is_loopback
        except ValueError:
            loopback = name in ("localhost", "[::1]")
        if not loopback:
            return False
    return True


def _require_token(field, what, token):
    """The value itself is never quoted."""
    if len(token) > MOST_TOKEN_BYTES:
        raise invalid(field, f"{what} has {len(token)} bytes, of at most {MOST_TOKEN_BYTES}")
    if token != token.strip():
        raise invalid(field, f"{what} begins or ends with spaces or a newline; strip it")
    if not re.fullmatch(r"[!-~]+", token):
        raise invalid(field, f"{what} is no line of visible ASCII characters")


def _require_certificate(field, pem):
    with _naming(field, f"{name_of(pem)} holds no certificate in PEM"), file_of(pem) as path:
        ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT).load_verify_locations(path)


@contextlib.contextmanager
def _naming(field, what):
    """Names the field of what OpenSSL does not take."""
    try:
        yield
    except (ssl.SSLError, ValueError) as error:
        raise invalid(field, f"{what}: {error}") from None
