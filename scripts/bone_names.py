#!/usr/bin/python3
"""Writes client/node/character/bone_names.js, the rigs' names of bones and what fingers do, from model/fit.

    scripts/bone_names.py            writes
    scripts/bone_names.py --check    changes nothing; fails if the file is outdated
"""
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
TABLE = ROOT / "model/fit/bones/human_rigs.h"
NAMES = ROOT / "model/fit/bones/human_bones.h"
FINGERS = ROOT / "model/fit/bones/finger_bones.cpp"
HANDS = ROOT / "model/core/hand_pose.h"
OUT = ROOT / "client/node/character/bone_names.js"
HEAD = f"""// The rigs' names of bones, written by scripts/bone_names.py from {TABLE.relative_to(ROOT)} and others, which explain them; do not edit.

"""


def initializer(text, name):
    """What C++ initializes an array with, as lists of lists of texts."""
    [braces] = re.findall(rf"\b{name}(?:\[\])? =\s+(\{{.*?\}});\n", text, re.S)
    braces = re.sub(r'"\s+"', "", braces)  # texts that follow each other are one
    lists = braces.replace("{", "[").replace("}", "]")
    return json.loads(re.sub(r",(\s*\])", r"\1", lists))


def written():
    text = TABLE.read_text()
    for constant, value in re.findall(r'string_view (k\w+) = ("[^"]*")', NAMES.read_text()):
        text = text.replace(constant, value)
    rigs = [
        {"name": name, "sides": sides, **dict(zip(("pelvis", "spine", "neck", "head"), trunk)), "limbs": limbs}
        for name, sides, trunk, limbs in initializer(text, "kRigs")
    ]
    # std::arrays have braces of their own around those of what they hold.
    [fingers] = initializer(FINGERS.read_text(), "kFingerNames")
    [bends] = initializer(FINGERS.read_text(), "kBends")
    lists = {
        "fingerNames": fingers,
        "handPoses": initializer(HANDS.read_text(), "kHandPoseNames"),
        "handBends": [hand[0] if hand else [] for hand in bends],
    }
    hands = "".join(f"\nexport const {name} = {json.dumps(value, ensure_ascii=False)};\n" for name, value in lists.items())
    rows = "".join(f"  {json.dumps(rig, ensure_ascii=False)},\n" for rig in rigs)
    return f"{HEAD}export const limbBones = {json.dumps(initializer(text, 'kLimbBones'))};\n\nexport const rigs = [\n{rows}];\n{hands}"


def main():
    if sys.argv[1:] == ["--check"]:
        sys.exit(0 if OUT.exists() and OUT.read_text() == written() else f"{OUT.relative_to(ROOT)} is outdated: run scripts/bone_names.py")
    OUT.write_text(written())


main()
