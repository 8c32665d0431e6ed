# SPDX-License-Identifier: BSD-3-Clause
"""What TestTorture.py throws at the plugin: `inputs` makes data sets, `cases` runs one case, `pool` runs many in other processes."""
