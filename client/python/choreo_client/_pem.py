"""Reads certificates and keys: PEM files or their texts, which may be secrets and are never quoted."""

import contextlib
import tempfile

from ._errors import invalid


def is_text(pem):
    return isinstance(pem, str) and "-----BEGIN" in pem


def name_of(pem):
    return "the text" if is_text(pem) else str(pem)


def content_of(field, pem):
    """Returns the bytes of a PEM file or text. Raises ChoreoError for a file that cannot be read."""
    return pem.encode() if is_text(pem) else read(field, pem)


@contextlib.contextmanager
def file_of(pem):
    """Returns the path of a file with the PEM, because OpenSSL accepts only files. For a text, the file is temporary, and only its owner can
    read it."""
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
