# shellcheck shell=sh
# Shared by demo.sh and tests/check.sh; plain sh, sourced from the top of the tree.
# set_up PACKAGE...: installs the missing ones of these Debian packages, then builds everything with make and prints its progress.
# SPDX-License-Identifier: GPL-3.0-or-later
me=$(basename "$0" .sh)

stop() {
	echo "$me: $*" >&2
	exit 1
}

# Is it installed? Tests the program or header itself, so that it works on machines without dpkg.
there() {
	case $1 in
	libc6-dev) header stdio.h ;;
	libfftw3-dev) header fftw3.h ;;
	libgsl-dev) header gsl/gsl_version.h ;;
	libjansson-dev) header jansson.h ;;
	libpng-dev) header png.h ;;
	libomp-dev) echo 'int main(void) { return 0; }' | clang -fopenmp -x c - -o /dev/null 2>/dev/null ;;
	libhdf5-dev) header hdf5/serial/hdf5.h || header hdf5.h ;;
	hdf5-tools) command -v h5diff >/dev/null 2>&1 ;;
	parallel) parallel --version 2>/dev/null | grep -q 'GNU parallel' ;;
	netpbm) command -v pngtopnm >/dev/null 2>&1 ;;
	bsdutils) command -v script >/dev/null 2>&1 ;;
	openmpi-bin) command -v mpirun >/dev/null 2>&1 ;;
	libopenmpi-dev) command -v mpicc >/dev/null 2>&1 ;;
	gnuplot-nox) command -v gnuplot >/dev/null 2>&1 ;;
	debhelper) command -v dh >/dev/null 2>&1 ;;
	python3-venv) /usr/bin/python3 -c 'import ensurepip' 2>/dev/null ;;
	python3-*) /usr/bin/python3 -c "import ${1#python3-}" 2>/dev/null ;;
	*) command -v "$1" >/dev/null 2>&1 ;;
	esac
}
header() {
	echo "#include <$1>" | gcc -E -x c - >/dev/null 2>&1
}

missing() {
	for package; do
		there "$package" || printf '%s ' "$package"
	done
}

install_packages() {
	command -v apt-get >/dev/null 2>&1 || stop "please install: $* (there is no apt-get here to do it)"
	root=
	if [ "$(id -u)" != 0 ]; then
		command -v sudo >/dev/null 2>&1 || stop "please install as root: apt-get install $*"
		root=sudo
	fi
	echo "$me: installing $*"
	log=$(mktemp)
	$root apt-get -qq -o Acquire::Retries=1 -o Acquire::http::Timeout=30 update >"$log" 2>&1
	# shellcheck disable=SC2086 # no quotes: $root may be empty
	if ! $root env DEBIAN_FRONTEND=noninteractive apt-get -qq -y --no-install-recommends install "$@" >>"$log" 2>&1; then
		[ -z "${SHOW_LOG:-}" ] || cat "$log" >&2
		rm -f "$log"
		stop "could not install $* (no network, or no rights? SHOW_LOG=1 shows why; with these packages installed it runs offline)"
	fi
	rm -f "$log"
}

# install_missing PACKAGE...: installs those that are missing.
install_missing() {
	wanted=$(missing "$@")
	# shellcheck disable=SC2086 # a list of words
	[ -z "$wanted" ] || install_packages $wanted
	wanted=$(missing "$@")
	[ -z "$wanted" ] || stop "still missing after installing: $wanted"
}

# Reads the commands of make and prints every few seconds how many of $1 files are made.
progress() {
	made=0 said=$(date +%s)
	while read -r line; do
		case $line in *' -o '*) made=$((made + 1)) ;; esac
		now=$(date +%s)
		[ $((now - said)) -ge 3 ] && said=$now && echo "$me: building: $made of $1 files"
	done
}

# build: builds everything; silent if nothing is to be done. make's exit status comes through descriptor 3, as plain sh has no pipefail.
build() {
	to_do=$(make -n all unit 2>/dev/null | grep -c ' -o ')
	[ "$to_do" = 0 ] || echo "$me: building $to_do files"
	{ status=$({ { make -j "$(nproc)" all unit; echo $? >&3; } | progress "$to_do" >&4; } 3>&1); } 4>&1
	[ "$status" = 0 ] || stop "the build failed"
}

set_up() {
	install_missing "$@"
	build
}
