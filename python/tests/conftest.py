# SPDX-License-Identifier: MIT
"""What the tests of the package share: they can be interrupted."""

import signal

# A shell that starts the tests in the background has them ignore SIGINT, as would every program
# that they start.
signal.signal(signal.SIGINT, signal.default_int_handler)
