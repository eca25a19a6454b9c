#!/usr/bin/env bash
# panels.sh PICTURE...: pictures of splot (ppm) side by side as one PNG on standard output. SPDX-License-Identifier: GPL-3.0-or-later
set -euo pipefail
pnmcat -lr "$@" | pnmquant -quiet 128 | pnmtopng -quiet -compression 9
