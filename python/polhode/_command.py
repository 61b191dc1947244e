# SPDX-License-Identifier: MIT
"""The command `polhode` of an installed package: the program itself is in the module _core."""

import os
import signal
import sys

from polhode._core import _command_line


def main() -> int:
    os.environ.setdefault("POLHODE_PYTHON", sys.executable)  # of `polhode plot`
    # A program of the shell ends at Ctrl-C and when nobody reads what it writes.
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    if hasattr(signal, "SIGPIPE"):
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    return _command_line([os.fsencode(word) for word in sys.argv])
