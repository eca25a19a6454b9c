# The rules of the Debian package; `make deb-check` builds, checks, installs and removes it. SPDX-License-Identifier: GPL-3.0-or-later
load ../helper

@test "the Debian package has the version of the tree, and asks for the libraries that the README's command installs" {
	version=$(sed -n 's/^#define PM_VERSION "\(.*\)"/\1/p' "$top/lib/base/base.h")
	[ "$(sed -n '1s/^pmpipe (\(.*\)) .*/\1/p' "$top/packaging/debian/changelog")" = "$version" ]
	for library in $(grep -ohE 'lib[a-z0-9]+-dev' "$top/pipelines/set-up.sh" "$top/pipelines/demo.sh" | sort -u |
		grep -vxE 'libc6-dev|libomp-dev|libopenmpi-dev'); do
		grep -q "^Build-Depends:.*$library" "$top/packaging/debian/control" || { echo "$library"; return 1; }
	done
}
