#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Sees to it that every package of apt-packages.txt is installed. With apt-get and as root it installs what is missing;
# otherwise it lists what is missing and exits with 1. Nothing missing: no call of apt-get, a fraction of a second.
set -eu

list="$(dirname "$0")/apt-packages.txt"
wanted="$(sed -e 's/#.*//' -e 's/[[:space:]]//g' -e '/^$/d' "$list")"

missing_packages() {
  if command -v dpkg-query >/dev/null 2>&1; then
    # One call for all: names of installed packages, which are then taken from the list.
    # shellcheck disable=SC2086
    installed="$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' $wanted 2>/dev/null | sed -n 's/^installed //p' || true)"
    for package in $wanted; do
      printf '%s\n' "$installed" | grep -qxF -e "$package" || printf '%s ' "$package"
    done
  else
    # shellcheck disable=SC2086
    printf '%s ' $wanted
  fi
}

complain() {
  echo "whitney-toolkit: $1" >&2
  echo "Needed (Debian 12's names; other systems have the same libraries under similar ones):" >&2
  for package in $missing; do echo "  $package" >&2; done
  echo "On Debian or Ubuntu, as root: apt-get install --no-install-recommends $missing" >&2
  exit 1
}

missing="$(missing_packages)"
[ -n "$missing" ] || exit 0

if ! command -v apt-get >/dev/null 2>&1; then
  # No Debian: what can be probed without dpkg is the least that the build needs.
  if [ "${WHITNEY_SKIP_BOOTSTRAP:-0}" = 1 ]; then exit 0; fi
  complain "apt-get is not here, so install these by hand, then run again with WHITNEY_SKIP_BOOTSTRAP=1."
fi
[ "$(id -u)" -eq 0 ] || complain "packages are missing, and only root can install them."

echo "whitney-toolkit: installing $missing"
export DEBIAN_FRONTEND=noninteractive
# shellcheck disable=SC2086
apt-get install -y -q --no-install-recommends $missing >/dev/null 2>&1 || {
  # Package lists may be old or, on a bare machine, not there at all.
  apt-get update -q || complain "apt-get update failed."
  apt-get install -y -q --no-install-recommends $missing || complain "apt-get could not install everything."
}
