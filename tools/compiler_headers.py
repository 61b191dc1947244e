# SPDX-License-Identifier: MIT
"""Headers of the compiler for libclang, whose Python package brings none."""

import subprocess


def arguments() -> list[str]:
    """g++ has them. Clang cannot parse its vector intrinsics, so code for them is left out."""
    folder = subprocess.run(
        ["g++", "-print-file-name=include"], text=True, check=True, stdout=subprocess.PIPE
    ).stdout.strip()
    return ["-isystem", folder, "-U__SSE2__"]
