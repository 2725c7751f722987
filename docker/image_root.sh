#!/usr/bin/env bash
# Collects in a folder the root of an image: programs of the package albtpu and the tools of busybox, the libraries that
# they load, what these read at run time, and the copyright and dpkg's record of each package that a file comes from, as
# scanners of images expect them.
#
# Usage: image_root.sh FOLDER    where albtpu, tini, busybox-static and ca-certificates are installed
set -euo pipefail
root=$1
programs=(/usr/bin/albtpu-query /usr/bin/albtpu-serve /usr/bin/tini)

mapfile -t libraries < <(ldd "${programs[@]}" | grep -o '/[^ :]* (0x' | sed 's/ (0x//' | sort -u)
data=(/usr/share/proj /usr/share/albtpu /etc/ssl/certs/ca-certificates.crt /etc/nsswitch.conf /etc/os-release
      /etc/debian_version /usr/share/doc/albtpu/libraries /usr/share/doc/albtpu/LICENSE /usr/share/common-licenses)

mkdir -p "$root"/{usr/{bin,lib,lib64,sbin},etc,data,tmp,var/lib/dpkg/status.d}
chmod 1777 "$root/tmp"
for folder in bin lib lib64 sbin; do ln -s "usr/$folder" "$root/$folder"; done
declare -A packages=([base-files]=1 [busybox-static]=1 [ca-certificates]=1 [proj-data]=1)
for file in "${programs[@]}" "${libraries[@]}"; do
  true_path=$(readlink -f "$file")
  folder=$root$(readlink -f "${file%/*}")
  mkdir -p "$folder"
  cp "$true_path" "$folder/${file##*/}"
  # Debian 12 knows some files by their path before /usr was merged.
  package=$(dpkg-query --search "$true_path" 2>/dev/null || dpkg-query --search "${true_path#/usr}")
  packages[${package%%:*}]=1
done
for path in "${data[@]}"; do cp -r --parents --dereference "$path" "$root"; done
mv "$root/usr/share/albtpu/tables" "$root/tables"  # Where a volume replaces them.
cp "$(command -v busybox)" "$root/usr/bin/busybox"
chroot "$root" /usr/bin/busybox --install -s /usr/bin

printf '%s\n' 'root:x:0:0:root:/root:/bin/sh' 'albtpu:x:10001:10001::/data:/sbin/nologin' >"$root/etc/passwd"
printf '%s\n' 'root:x:0:' 'albtpu:x:10001:' >"$root/etc/group"
for package in "${!packages[@]}"; do
  mkdir -p "$root/usr/share/doc/$package"
  cp --dereference "/usr/share/doc/$package/copyright" "$root/usr/share/doc/$package/"
  dpkg-query --status "$package" >"$root/var/lib/dpkg/status.d/$package"
done
