#!/bin/sh
# From a bare Debian machine to a first result: installs missing packages (as root or with sudo), builds, runs the first pipeline, a
# Plummer sphere under particle-mesh gravity, and ends with its numbers and the name of a picture.
# SPDX-License-Identifier: GPL-3.0-or-later
set -u
cd "$(dirname "$0")/.." || exit 1
. pipelines/set-up.sh
set_up gcc libc6-dev make libfftw3-dev libgsl-dev libjansson-dev libpng-dev libhdf5-dev
mkdir -p build/demo
cd build/demo || exit 1
PATH=$PWD/../../bin:$PATH bash ../../pipelines/pm-plummer.sh || stop "pm-plummer failed"
# shellcheck disable=SC2012 # our own file names
picture=$(ls -t -- *.png 2>/dev/null | head -n 1)
[ -n "$picture" ] || stop "pm-plummer made no picture"
echo "picture: build/demo/$picture"
