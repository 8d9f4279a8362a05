"""Certificates and keys: PEM files, or their texts, which may be secrets and are quoted nowhere."""

import contextlib
import tempfile

from ._errors import invalid


def is_text(pem):
    return isinstance(pem, str) and "-----BEGIN" in pem


def name_of(pem):
    return "the text" if is_text(pem) else str(pem)


def content_of(field, pem):
    """Its bytes. Raises ChoreoError for a file that cannot be read."""
    return pem.encode() if is_text(pem) else read(field, pem)


@contextlib.contextmanager
def file_of(pem):
    """The path of a file with it, for OpenSSL, which takes nothing else. One of a text only its owner can read, and only meanwhile."""
    if not is_text(pem):
        yield pem
        return
    with tempfile.NamedTemporaryFile("w", suffix=".pem") as file:
        file.write(pem)
        file.flush()
        yield file.name


def read(field, path):
    try:
        with open(path, "rb") as file:
            return file.read()
    except FileNotFoundError:
        raise invalid(field, f"no file {path}") from None
    except OSError as error:
        raise invalid(field, f"cannot read {path}: {error.strerror}") from None
