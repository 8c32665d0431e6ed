# SPDX-License-Identifier: BSD-3-Clause
"""What TestTorture.py throws at the plugin: `inputs` makes data sets, `files` makes spoilt files, `targets` tells what each filter takes,
`cases` runs one case, `answers` judges what came of it, `pool` runs many in other processes."""
