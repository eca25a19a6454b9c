#!/bin/sh
# Debian packages: deb.sh build makes them in build/deb from the files that git knows; deb.sh check demands that lintian finds no error, that no path of the
# build is in them, and installs, tries and removes them on a bare machine: a copy of the root in BARE, or of one that debootstrap makes there (default
# /var/tmp/pmpipe-bare; as root). Some minutes, so `make check` leaves it out. SPDX-License-Identifier: GPL-3.0-or-later
set -eu
cd "$(dirname "$0")/.."
version=$(sed -n 's/^#define PM_VERSION "\(.*\)"/\1/p' lib/base/base.h)
out=$PWD/build/deb

stop() { echo "deb: $*" >&2; exit 1; }
needs() { command -v "$1" >/dev/null || stop "no $1 here (apt-get install $2)"; }

build() {
	needs dh debhelper
	needs dpkg-buildpackage dpkg-dev
	[ "$(sed -n '1s/.*(\(.*\)).*/\1/p' packaging/debian/changelog)" = "$version" ] || stop "packaging/debian/changelog has another version than $version"
	rm -rf "$out"
	mkdir -p "$out/pmpipe-$version"
	git ls-files -z | xargs -0 cp --parents -t "$out/pmpipe-$version"
	cp -r packaging/debian "$out/pmpipe-$version/debian"
	(cd "$out/pmpipe-$version" && env -u MAKEFLAGS -u MAKELEVEL dpkg-buildpackage -b -us -uc -j"$(nproc)" >../log 2>&1) ||
		{ tail -n 20 "$out/log"; stop "the build failed"; }
	ls "$out"/*.deb
}

# The machine: a copy that the test may change.
machine() {
	template=${BARE:-/var/tmp/pmpipe-bare}
	root=$(mktemp -d)
	trap 'umount "$root/proc" 2>/dev/null; rm -rf "$root"' EXIT
	if [ ! -e "$template/etc/debian_version" ]; then
		needs debootstrap debootstrap
		debootstrap --variant=minbase bookworm "$template" >/dev/null || stop "debootstrap failed"
	fi
	cp -a "$template/." "$root"
	cp /etc/resolv.conf "$root/etc/" 2>/dev/null || true
	mount -t proc proc "$root/proc" # the programs find each other through /proc/self/exe
}

on_it() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive sh -c "$1"; }

check() {
	needs lintian lintian
	lintian --fail-on error --allow-root "$out"/pmpipe_*.changes || stop "lintian found errors"
	for package in "$out"/*.deb; do
		dpkg-deb --fsys-tarfile "$package" | grep -aq "$PWD" && case $package in *dbgsym*) ;; *) stop "$package holds the path of the build" ;; esac
	done
	machine
	cp "$out"/*.deb "$root/root"
	rm -f "$root"/root/*dbgsym*
	on_it 'apt-get -qq update && apt-get -qq -y --no-install-recommends install /root/*.deb' >"$out/apt" 2>&1 ||
		{ tail -n 5 "$out/apt"; stop "it cannot be installed"; }
	on_it 'cd /tmp && pmpipe pinit two-body | pmpipe cycle -n 10 "push kick/2 drift | pp | push kick/2" -o a.h5 && pmpipe sh5 a.h5 | pmpipe diag' \
		>"$out/said" || stop "the installed programs do not run"
	[ "$(grep -c . "$out/said")" -ge 2 ] || stop "the installed diag printed nothing"
	on_it 'man -w pmpipe >/dev/null 2>&1 || ls /usr/share/man/man1/pmpipe.1.gz >/dev/null' || echo "deb: the machine leaves manual pages out (dpkg.cfg.d)"
	on_it 'ldd /usr/libexec/pmpipe/* /usr/bin/pmpipe 2>&1 | grep "not found"' && stop "libraries are missing"
	on_it 'apt-get -qq -y purge pmpipe libpmpipe0 libpmpipe-dev' >>"$out/apt" 2>&1 || stop "it cannot be removed"
	left=$(on_it 'find / -xdev -name "*pmpipe*" -not -path "/root/*" -not -path "/proc/*" -not -path "/var/*" -not -path "/tmp/*"')
	[ -z "$left" ] || stop "left behind: $left"
	echo "deb: installed, ran and removed"
}

for word; do
	case $word in
	build | check) $word ;;
	*) stop "build or check" ;;
	esac
done
