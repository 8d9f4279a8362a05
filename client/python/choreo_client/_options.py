"""Checks a client's options, and converts them for gRPC."""

import contextlib
import dataclasses
import ipaddress
import json
import numbers
import os
import re
import ssl
import typing

import grpc

from ._errors import invalid
from ._pem import content_of, file_of, name_of, read
from ._numbers import finite
from ._words import hint, quoted

LEAST_SILENCE = 2  # seconds
MOST_PORT = 65535
_LONGEST = 1e6  # seconds: gRPC counts milliseconds in 32 bits
MOST_TOKEN_BYTES = 4096  # gRPC's headers have 8 KiB in all

Path = typing.Union[str, "os.PathLike[str]"]


@dataclasses.dataclass(frozen=True)
class Options:
    """The options of Client; None: not given. Certificates and keys are PEM files or their texts.

    ca_certificate      the certificate of the authority to trust, with tls; None: the authorities that gRPC trusts
    client_certificate, client_key      the client's certificate and its key, with tls, if the server requires one
    server_name         the name in the server's certificate, with tls; None: the host name in its address
    token               sent with each call; requires tls, unless all addresses are on this machine
    token_file          a file with the token, instead of token; read again for each call, so that the token can be renewed
    connect_timeout_s   the time limit for one attempt to connect to one address; above 0
    silence_s           a server that sends nothing for so long, not even answers to pings, counts as lost; at least 2; 0: never
    retry_s             how long to keep retrying since a call last made progress; 0: no retries, so no resumption either. If a server asks
                        for a longer wait than is left, the call fails at once with an error that has the server's retry_after
    first_backoff_s     between the first attempts; doubled each time, up to 2 s
    even_draining       also call servers that accept no new dances, to inspect them
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
        """Raises ChoreoError, naming the option, for unusable options."""
        self._check_kinds()
        for name in ("connect_timeout_s", "silence_s", "retry_s", "first_backoff_s"):
            value = getattr(self, name)
            if finite(value) is None or value < 0:
                raise invalid(name, f"{quoted(value)} is not a finite number >= 0")
        if self.connect_timeout_s == 0:
            raise invalid("connect_timeout_s", "0 s leave no time to connect")
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
                raise invalid(name, f"a {type(value).__name__} is not a {what}")  # the value may be a secret

    def _check_token(self, addresses):
        if self.token is None and self.token_file is None:
            return
        if self.token is not None and self.token_file is not None:
            raise invalid("token", "given beside token_file; one of them is sent")
        name = "token_file" if self.token is None else "token"
        far = [address for address in addresses if not _is_of_this_machine(address)]
        if far and not self.tls:
            raise invalid(name, f"a token is sent to {far[0]} only over TLS")
        if self.token is not None:
            _require_token("token", "it", self.token)

    def credentials(self):
        """Makes gRPC's credentials; None without TLS."""
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
        """The metadata of each call."""
        token = self.token
        if self.token_file is not None:
            token = read("token_file", self.token_file).decode("latin-1").rstrip()
            _require_token("token_file", self.token_file, token)
        return [] if token is None else [("authorization", f"Bearer {token}")]

    def channel_options(self):
        """Options for gRPC's channels. Calls are distributed in turn over the addresses of a name. Addresses whose health is not serving are
        skipped, unless even_draining."""
        service = {"loadBalancingConfig": [{"round_robin": {}}]}
        if not self.even_draining:
            service["healthCheckConfig"] = {"serviceName": "choreo.v1.Choreography"}
        options = {
            "grpc.service_config": json.dumps(service),
            "grpc.max_receive_message_length": -1,
            # Despite its name, gRPC also uses this as the time limit for one attempt to connect.
            "grpc.min_reconnect_backoff_ms": round(1000 * min(self.connect_timeout_s, _LONGEST)),
            "grpc.initial_reconnect_backoff_ms": 100,
            "grpc.max_reconnect_backoff_ms": 1000,
        }
        if self.server_name is not None:
            options["grpc.ssl_target_name_override"] = self.server_name
        if self.silence_s > 0:
            # Half of the time passes before a ping, the other half is for its answer.
            half = round(500 * min(self.silence_s, _LONGEST))
            options |= {"grpc.keepalive_time_ms": half, "grpc.keepalive_timeout_ms": half, "grpc.http2.max_pings_without_data": 0}
        return list(options.items())


def options_of(given):
    """Makes Options from {name: value}. Raises ChoreoError for unknown names."""
    names = [field.name for field in dataclasses.fields(Options)]
    for name in given:
        if name not in names:
            raise invalid(name, f"no option; {hint(name, names)}")
    return Options(**given)


_PATH = ((str, os.PathLike), "path")
_KINDS = {
    **dict.fromkeys(("tls", "even_draining"), (bool, "bool")),
    **dict.fromkeys(("ca_certificate", "client_certificate", "client_key", "token_file"), _PATH),
    **dict.fromkeys(("server_name", "token"), (str, "str")),
    **dict.fromkeys(("connect_timeout_s", "silence_s", "retry_s", "first_backoff_s"), (numbers.Real, "number")),
}


def _check_address(address):
    """Refuses addresses that gRPC would misread as a host name, or with another port."""
    if not isinstance(address, str) or not address:
        raise invalid("addresses", f"{address!r} is not a HOST:PORT")
    if re.match("(?i)https?:", address):
        raise invalid("addresses", f"{address} is a URL; use HOST:PORT, and the option tls for TLS")
    if re.match("(unix|unix-abstract|xds):", address):
        return
    port = re.search(r":([0-9]+)$", address)
    if port is None:
        raise invalid("addresses", f"{address} has no port; use HOST:PORT")
    if not 1 <= int(port[1]) <= MOST_PORT:
        raise invalid("addresses", f"{address}: port {port[1]} is not in [1, {MOST_PORT}]")


def _is_of_this_machine(address):
    """Whether traffic to this address stays on this machine. A host name that merely begins like an IP address is a name."""
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
    """Checks a token. Errors never quote it."""
    if len(token) > MOST_TOKEN_BYTES:
        raise invalid(field, f"{what} has {len(token)} bytes, of at most {MOST_TOKEN_BYTES}")
    if token != token.strip():
        raise invalid(field, f"{what} begins or ends with spaces or a newline; strip it")
    if not re.fullmatch(r"[!-~]+", token):
        raise invalid(field, f"{what} is not one line of visible ASCII characters")


def _require_certificate(field, pem):
    with _naming(field, f"{name_of(pem)} holds no certificate in PEM"), file_of(pem) as path:
        ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT).load_verify_locations(path)


@contextlib.contextmanager
def _naming(field, what):
    """Adds the field's name to errors of OpenSSL."""
    try:
        yield
    except (ssl.SSLError, ValueError) as error:
        raise invalid(field, f"{what}: {error}") from None
