"""Formats values for errors, and suggests names for misspelt ones."""

import difflib
import re
import reprlib


def quoted(value):
    """Formats a value briefly."""
    return reprlib.repr(value)


def _plain(name):
    return re.sub("[^a-z0-9]", "", name.lower())


def hint(name, names):
    """Returns `did you mean ...?` or, if no name is near, a list of `names`."""
    asked, known = _plain(str(name)), {_plain(one): one for one in names}
    ends = [one for one in known if len(asked) > 2 and one.endswith(asked)]
    swapped = [one for one in known if sorted(one) == sorted(asked)]
    close = [asked] if asked in known else ends or swapped or difflib.get_close_matches(asked, known, 1, 0.75)
    return f"did you mean {known[close[0]]}?" if close else f"there are {', '.join(names)}"
