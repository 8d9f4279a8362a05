"""What the studio is asked, over HTTP in JSON."""

import base64
import json
import os
import urllib.error
import urllib.request

PATIENCE = 600  # seconds: a long song takes a while
MOST_BYTES = 40 * 2**20  # of a song


def ask(address, path, body=None):
    """What the studio answers; RuntimeError in its words where it refuses."""
    data = None if body is None else json.dumps(body).encode()
    request = urllib.request.Request(address.rstrip("/") + path, data, {"Content-Type": "application/json"})
    # The studio is on this machine: no proxy stands between.
    opener = urllib.request.build_opener(urllib.request.ProxyHandler({}))
    try:
        with opener.open(request, timeout=PATIENCE) as answer:
            return json.load(answer)
    except urllib.error.HTTPError as error:
        text = error.read().decode(errors="replace")
        try:
            text = json.loads(text)["error"]
        except (ValueError, KeyError, TypeError):
            pass
        raise RuntimeError(text.strip() or str(error)) from error
    except (OSError, ValueError) as error:
        raise RuntimeError(f"No studio answers at {address} ({error}): start one with `choreo studio`") from error


def song(path):
    """What a project says of its song: name and bytes."""
    try:
        if not os.path.isfile(path):
            raise RuntimeError(f"{path} is not a file")
        if os.path.getsize(path) > MOST_BYTES:
            raise RuntimeError(f"{path} is larger than {MOST_BYTES // 2**20} MiB")
        with open(path, "rb") as file:
            return {"song": os.path.basename(path), "song_data": base64.b64encode(file.read(MOST_BYTES)).decode()}
    except OSError as error:
        raise RuntimeError(f"{path}: {error.strerror}") from error
