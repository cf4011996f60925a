# A fresh small system, to try there what users get. Sourced by
# scripts/check-package and scripts/check-portable; needs root and debootstrap.

folder=$(mktemp -d)

say() { echo "$(basename "$0"): $*"; }
fail() { say "$*" >&2; exit 1; }

# Never through a mount that could not be undone.
remove_system() {
  local mount
  for mount in dev/pts dev proc; do
    if mountpoint -q "$folder/root/$mount"; then
      umount -l "$folder/root/$mount"
    fi
  done
  rm -rf --one-file-system "$folder/root"
}

clean_up() {
  remove_system
  rm -rf --one-file-system "$folder"
}
trap clean_up EXIT

# quietly <command>…: shows what it said only if it fails.
quietly() {
  "$@" >"$folder/log" 2>&1 || fail "$* failed: $(tail -n 40 "$folder/log")"
}

# start_system <folder>: a copy of the system in <folder>, in place of the last.
start_system() {
  remove_system
  cp -a "$1" "$folder/root"
  cp /etc/resolv.conf "$folder/root/etc/resolv.conf"
  local mount
  for mount in proc dev dev/pts; do
    mount --bind "/$mount" "$folder/root/$mount"
  done
}

# start_debian <suite> [<folder>]: <folder> is a system that `debootstrap
# --variant=minbase <suite>` filled. Without it, one is made.
start_debian() {
  local system=${2:-$folder/$1}
  [ $# -gt 1 ] || quietly debootstrap --variant=minbase "$1" "$system"
  start_system "$system"
}

# inside <command>…: in the new system, with nothing of ours around it.
inside() {
  chroot "$folder/root" /usr/bin/env -i HOME=/root LANG=C.UTF-8 \
    PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive "$@"
}

install_inside() {
  quietly inside apt-get install -y --no-install-recommends "$@"
}
