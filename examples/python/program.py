"""What the programs of this folder have in common: the package, options, Ctrl-C, and errors for people."""

import argparse
import importlib.util
import math
import os
import pathlib
import sys

# Not installed: a checkout's is used as it is. So programs import this module first.
if importlib.util.find_spec("choreo_client") is None:
    sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "client" / "python"))

from choreo_client import ChoreoError, Client


def arguments(description):
    """A parser with the options by which each program finds its server."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--server", action="append", help="HOST:PORT; several are replicas that stand in for each other ($CHOREO_SERVER)")
    parser.add_argument("--ca", default=os.environ.get("CHOREO_CA"), help="PEM file of the authority to trust: encrypts ($CHOREO_CA)")
    parser.add_argument("--token-file", default=os.environ.get("CHOREO_TOKEN_FILE"), help="file of the token to send ($CHOREO_TOKEN_FILE)")
    return parser


def connect(options):
    """The client that the options of `arguments` ask for."""
    servers = options.server or [os.environ.get("CHOREO_SERVER", "127.0.0.1:50051")]
    return Client(servers, tls=options.ca is not None, ca_certificate=options.ca, token_file=options.token_file)


def tell_resume(resumed):
    """For stream_dance: the dance goes on at another server."""
    print(f"\ngoes on at {resumed.address} from frame {resumed.frame}")


def positive(text):
    """A number above 0 out of a program's options, for argparse."""
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not 0 < number < math.inf:
        raise argparse.ArgumentTypeError(f"{text} is not a number above 0")
    return number


def json_file(text):
    """A JSON file's path out of a program's options, for argparse."""
    if not text.endswith(".json"):
        raise argparse.ArgumentTypeError(f"{text} does not end with .json")
    return text


def whole(least, most):
    """A whole number from `least` to `most` out of a program's options, for argparse."""

    def read(text):
        if not (text.isascii() and text.isdigit() and least <= int(text[:40]) <= most):
            raise argparse.ArgumentTypeError(f"{text} is not a whole number from {least} to {most}")
        return int(text)

    return read


seed = whole(0, 2**64 - 1)


def run(main):
    """Runs a program: Ctrl-C cancels, errors are shown with the fields that they name."""
    try:
        main()
    except ChoreoError as error:
        print(f"{error.code}: {error}", file=sys.stderr)
        for violation in error.violations:
            print(f"  field: {violation.field}", file=sys.stderr)
        if error.retry_after:
            print(f"  try again in {error.retry_after:g} s", file=sys.stderr)
        sys.exit(1)
    except OSError as error:
        sys.exit(f"{error.filename}: {error.strerror}")
    except KeyboardInterrupt:
        sys.exit("CANCELLED")
