# SPDX-License-Identifier: MIT
"""The environment in which tests start mpirun."""

import os

# For a container with root only, two processors, no ssh and no network. Open MPI 5 reads some
# settings as PRTE_MCA_*.
ENVIRONMENT = {
    **os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_hwloc_base_binding_policy": "none",
    "OMPI_MCA_plm": "isolated", "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
    "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe",
    "PRTE_MCA_hwloc_default_binding_policy": "none", "OMPI_MCA_btl": "^tcp",
    "TMPDIR": "/tmp",  # sockets have short names
}
