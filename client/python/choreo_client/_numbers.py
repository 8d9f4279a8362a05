"""Numbers that callers give: of Python, numpy or JSON, whose integers may have any number of digits."""

import math
import numbers

LARGEST_FLOAT32 = 3.4028235e38


def finite(value):
    """Returns a number as a float; None for whatever is no finite number, and for integers beyond all floats."""
    if not isinstance(value, numbers.Real) or isinstance(value, bool):
        return None
    try:
        number = float(value)
    except OverflowError:
        return None
    return number if math.isfinite(number) else None
