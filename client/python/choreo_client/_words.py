"""Formats values for errors, and suggests names for misspelt ones."""

import difflib
import re
import reprlib


_MOST_BITS = 4096  # of an integer to show; Python writes none of more than 4300 digits


class _Brief(reprlib.Repr):
    def repr_int(self, x, level):
        return super().repr_int(x, level) if x.bit_length() <= _MOST_BITS else f"an integer of {x.bit_length()} bits"


_brief = _Brief()


def quoted(value):
    """Formats a value briefly."""
    return _brief.repr(value)


def has_half(text):
    """Whether a text has half a character, a surrogate without its pair, which UTF-8 and so no message can hold."""
    return re.search("[\ud800-\udfff]", text) is not None


def well_formed(text):
    """Returns a text with U+FFFD, as browsers write it, in place of half characters."""
    return re.sub("[\ud800-\udfff]", "\ufffd", text)


def _plain(name):
    return re.sub("[^a-z0-9]", "", name.lower())


def hint(name, names):
    """Returns `did you mean ...?` or, if no name is near, a list of `names`."""
    asked, known = _plain(str(name)), {_plain(one): one for one in names}
    ends = [one for one in known if len(asked) > 2 and one.endswith(asked)]
    swapped = [one for one in known if sorted(one) == sorted(asked)]
    close = [asked] if asked in known else ends or swapped or difflib.get_close_matches(asked, known, 1, 0.75)
    return f"did you mean {known[close[0]]}?" if close else f"there are {', '.join(names)}"
