# SPDX-License-Identifier: MIT
"""The build under test, installed."""

import pytest
from shell import sh


@pytest.fixture(scope="session")
def prefix(build, tmp_path_factory):
    path = tmp_path_factory.mktemp("prefix")
    sh("cmake", "--install", build, "--prefix", path)
    return path
