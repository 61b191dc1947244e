# SPDX-License-Identifier: MIT
"""The environment in which tests start mpirun."""

import os

# What a container with root alone, two processors and no ssh asks for.
ENVIRONMENT = {
    **os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_hwloc_base_binding_policy": "none",
    "OMPI_MCA_plm": "isolated", "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
    "TMPDIR": "/tmp",  # sockets have short names
}
