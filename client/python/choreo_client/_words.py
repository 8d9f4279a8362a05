"""What errors say of what they were given, and what somebody who misspelt a name may have meant."""

import difflib
import re
import reprlib


def quoted(value):
    """A value, in short."""
    return reprlib.repr(value)


def _plain(name):
    return re.sub("[^a-z0-9]", "", name.lower())


def hint(name, names):
    """`did you mean ...?`, or else what `names` there are."""
    asked, known = _plain(str(name)), {_plain(one): one for one in names}
    ends = [one for one in known if len(asked) > 2 and one.endswith(asked)]
    close = [asked] if asked in known else ends or difflib.get_close_matches(asked, known, 1, 0.75)
    return f"did you mean {known[close[0]]}?" if close else f"there are {', '.join(names)}"
