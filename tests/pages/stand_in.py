#!/usr/bin/python3
"""Stands in for every program that pages call (commands_test.py), under its name: runs it where that takes seconds, and otherwise looks
whether what it is told exists. $CHOREO_BIN holds our programs, $CHOREO_ROOT the sources, $CHOREO_STUDIO is the address of a studio."""

import os
import pathlib
import re
import signal
import socket
import subprocess
import sys
import urllib.request

ROOT = pathlib.Path(os.environ["CHOREO_ROOT"])
BIN = pathlib.Path(os.environ["CHOREO_BIN"])

# What doesn't run here, and why. That files, options and targets exist is looked up all the same.
LOOKED_UP = {
    "make": "builds everything; make verify and a fresh machine run it",
    "cmake": "builds; make verify builds examples/client so",
    "docker": "an image takes minutes; make verify builds it and dances with it",
    "choreo-lab": "wants recordings that are not ours to ship",
    "scripts": "want recordings, or a while; make demo, make bench and make verify run what they need",
    "node": "plays music as it sounds; Examples.Node and Examples.Page run these programs",
    "npm": "fetches packages; Examples.TypeScript does",
    "npx": "runs what npm fetched; Examples.TypeScript does",
    "python3": "plays music as it sounds; Examples.Python runs these programs",
    "first_dance": "is built by the command before; ExampleTest runs it",
    "tests": "are programs of make verify",
}
# What makes a film quick.
SMALL = {"--size": "160x120", "--fps": "4"}


def fail(said):
    sys.exit(f"{' '.join(sys.argv)}: {said}")


def must_be_options(arguments, text):
    known = set(re.findall(r"(?<![\w-])--?[A-Za-z][\w-]*", text))
    for option in arguments:
        name = option.partition("=")[0]
        if re.fullmatch(r"--?[A-Za-z][\w-]*", name) and name not in known:
            fail(f"there is no {name}")


def run(program, arguments):
    sys.exit(subprocess.run([BIN / program, *arguments], check=False).returncode)


def serve(program, arguments, says, ends):
    """Until it says that it serves."""
    with subprocess.Popen([BIN / program, *arguments], stdout=subprocess.PIPE, text=True) as server:
        said = ""
        for line in server.stdout:
            said += line
            if says in line:
                server.send_signal(ends)
                break
        said += server.stdout.read()
        code = server.wait()
    if code != 0 or says not in said:
        fail(f"ended with {code} and said {said}")


def help_of(program, arguments):
    """Of its subcommand, where it has one."""
    subcommand = [word for word in arguments[:1] if not word.startswith("-")]
    shown = subprocess.run([BIN / program, *subcommand, "--help"], capture_output=True, text=True, check=False)
    if shown.returncode != 0:
        fail(shown.stderr)
    return shown.stdout


def choreo(arguments):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
        free.bind(("127.0.0.1", 0))
        port = str(free.getsockname()[1])
    instead = {"--server": os.environ["CHOREO_SERVER"], "--osc": port, "--input": "default"}
    for at, word in enumerate(arguments[:-1]):
        arguments[at + 1] = instead.get(word, arguments[at + 1])
    subcommand = arguments[0]
    if subcommand == "studio":
        serve("choreo", [*arguments, "--listen", "127.0.0.1:0"], "The studio is open", signal.SIGINT)
    elif subcommand == "live":
        serve("choreo", arguments, "1 s: ", signal.SIGINT)
    else:
        if "--video" in arguments:
            for name, value in SMALL.items():
                if name in arguments:
                    arguments[arguments.index(name) + 1] = value
                else:
                    arguments += [name, value]
        run("choreo", arguments)


def curl(arguments):
    """-H, --data @FILE and an address of the studio."""
    headers, body, url = {}, None, None
    words = iter(arguments)
    for word in words:
        if word == "-H":
            name, _, value = next(words).partition(": ")
            headers[name] = value
        elif word == "--data":
            name = next(words).removeprefix("@")
            body = sys.stdin.buffer.read() if name == "-" else pathlib.Path(name).read_bytes()
        else:
            url = word.replace("http://127.0.0.1:8765", os.environ["CHOREO_STUDIO"])
    with urllib.request.urlopen(urllib.request.Request(url, body, headers)) as answer:
        print(answer.read().decode()[:200])


def looked_up(name, arguments):
    if name == "make":
        targets = re.findall(r"^([a-z]+):", (ROOT / "Makefile").read_text(), flags=re.M)
        for word in arguments:
            if "=" not in word and word not in targets:
                fail(f"the Makefile has no {word}")
    elif name == "choreo-lab":
        must_be_options(arguments, help_of(name, arguments))
    elif name in ("node", "python3"):
        program = pathlib.Path(arguments[0])
        if not program.exists():
            fail(f"there is no {program}")
        sources = "".join(file.read_text() for file in program.resolve().parent.glob(f"*{program.suffix}"))
        # The examples name their options without dashes in JavaScript: seconds: { type: 'string' }, or 'song-start'.
        for option in arguments[1:]:
            if option.startswith("--") and not re.search(rf"(--|\b){re.escape(option[2:])}\b", sources):
                fail(f"{program} has no {option}")
    for word in arguments:
        if re.match(r"(docker|examples|model|scripts|tests|bench)/", word) and not (ROOT / word).exists():
            fail(f"there is no {word}")


def main():
    called = pathlib.Path(sys.argv[0])
    name, arguments = called.name, sys.argv[1:]
    if name == "choreo":
        choreo(arguments)
    elif name == "choreod":
        os.environ["CHOREO_LISTEN"] = "127.0.0.1:0"
        if "--listen" in arguments:
            arguments[arguments.index("--listen") + 1] = "127.0.0.1:0"
        serve("choreod", arguments, "listens on", signal.SIGTERM)
    elif name == "curl":
        curl(arguments)
    elif name == "python3" and arguments[0] in ("-c", "-m"):
        os.execv("/usr/bin/python3", ["python3", *arguments])
    elif name in LOOKED_UP or called.parent.name in LOOKED_UP or "tests" in called.parts:
        looked_up(name, arguments)
    else:
        fail("nobody knows how to run this: see stand_in.py")


main()
