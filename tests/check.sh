#!/bin/sh
# The whole suite, on a bare Debian machine too: installs missing packages (as root or with sudo), builds, runs the unit tests and every bats
# file, and ends with `N passed, N failed, N skipped`. PM_LONG=1 adds the long physics. Arguments: only these bats files, directories, or `unit`:
# sh tests/check.sh tests/tool/p2m.bats
# SPDX-License-Identifier: GPL-3.0-or-later
set -u
cd "$(dirname "$0")/.." || exit 1
. pipelines/set-up.sh
set_up gcc libc6-dev make libfftw3-dev libgsl-dev libjansson-dev libpng-dev libhdf5-dev hdf5-tools pkg-config bats parallel python3 mandoc bsdutils jq netpbm
exec bash tests/run.sh "$@"
