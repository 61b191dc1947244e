# SPDX-License-Identifier: MIT
"""Programs that tests of an installed polhode start."""

import subprocess


def sh(*arguments, cwd=None, status=0):
    """What a program says, on both of its streams; it must end with this status."""
    done = subprocess.run(list(map(str, arguments)), cwd=cwd, text=True, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert done.returncode == status, f"{arguments}\n{done.stdout}"
    return done.stdout
